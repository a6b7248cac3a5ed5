#pragma once
// SMS 2DM: text, a mesh layer for QGIS; the CRS in a .prj.

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"

namespace tinsmith {

struct MeshVisitor;

/// As write_mesh and visit_mesh, for this format. Vertices and triangles are numbered from 1 without gaps.
void write_two_dm(const std::string& path, const TerrainSurface& surface, const GridFrame& frame);
std::string visit_two_dm(const std::string& path, const MeshVisitor& visitor);

}  // namespace tinsmith
