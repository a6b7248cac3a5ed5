#pragma once
// PLY, binary little endian: vertices as doubles, triangles as lists, the CRS as a comment (as MDAL reads it).

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// As write_mesh and read_mesh, for this format.
void write_ply(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame);
Tin read_ply(const std::string& path);

}  // namespace tinsmith
