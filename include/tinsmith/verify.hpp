#pragma once
// The judge: measures a mesh file against the samples it was made from. Shares no code with the simplifier.

#include <string>
#include <vector>

#include "tinsmith/certificate.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// Measures the mesh in the file `mesh_path` (.ply .obj .glb .2dm) against every sample of the rasters.
/// Throws InputError when one of the files can't be used.
Certificate verify(const std::vector<std::string>& inputs, const std::string& mesh_path,
                   const InputOptions& options = {}, const Progress& progress = {});

}  // namespace tinsmith
