#pragma once
// Wavefront OBJ: text with the shortest decimals that read back as the same doubles; the CRS in a .prj.

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// As write_mesh and read_mesh, for this format. Reads plain `v x y z` and `f a b c` only.
void write_obj(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame);
Tin read_obj(const std::string& path);

}  // namespace tinsmith
