# Installs the build into a fresh prefix, builds the example against it alone and runs it.
# cmake -DBUILD=... -DEXAMPLE=... -DSCRATCH=... -DGENERATOR=... -DCOMPILER=... -DFLAGS=... -P check_package.cmake
file(REMOVE_RECURSE ${SCRATCH})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/prefix
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${EXAMPLE} -B ${SCRATCH}/build -G ${GENERATOR}
  -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_EXE_LINKER_FLAGS=${FLAGS} -DCMAKE_PREFIX_PATH=${SCRATCH}/prefix
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${SCRATCH}/build COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${SCRATCH}/build/example COMMAND_ERROR_IS_FATAL ANY)
