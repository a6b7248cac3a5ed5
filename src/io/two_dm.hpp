#pragma once
// SMS 2DM: text, a mesh layer for QGIS; the CRS in a .prj.

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// As write_mesh and read_mesh, for this format. Vertices and triangles are numbered from 1 without gaps.
void write_two_dm(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame);
Tin read_two_dm(const std::string& path);

}  // namespace tinsmith
