#pragma once
// The judge: measures a mesh file against the samples it was made from. Shares no code with the simplifier.

#include <cstdint>
#include <string>
#include <vector>

#include "tinsmith/certificate.hpp"
#include "tinsmith/options.hpp"
#include "tinsmith/progress.hpp"

namespace tinsmith {

/// How a mesh is verified. None of it changes the certificate.
struct VerifyOptions {
  int threads = 0;           // 0: as many as the machine has
  std::uint64_t memory = 0;  // bytes for the whole program; 0: a quarter of what there is, for it or the machine
  std::string tmp;           // folder of scratch files, which have no names; empty: the folder of the mesh
  Progress progress;         // empty: silent
  std::string color;         // raster that the colours of the mesh are measured against; empty: they are not
};

/// Measures the mesh in the file `mesh_path` (.ply .obj .glb .2dm) against every sample of the rasters. What does
/// not fit into the memory goes to scratch files; the most that is held at once are the triangles of a block of
/// 512 x 512 samples for each thread, and of one block whatever the memory. An eighth of the memory is left to the
/// raster cache of GDAL, which its caller limits (GDAL_CACHEMAX). Levels of sRGB are
/// interpolated linearly in the mesh, and compared at the samples with those of the raster `color`, warped as
/// compress() does; viewers of .glb mix light instead, which between vertices is a little brighter. Throws
/// InputError when one of the files can't be used or the mesh lacks colours, OutputError or ResourceError when
/// scratch files can't, Interrupted.
Certificate verify(const std::vector<std::string>& inputs, const std::string& mesh_path,
                   const InputOptions& input_options = {}, const VerifyOptions& options = {});

}  // namespace tinsmith
