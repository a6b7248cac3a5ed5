#pragma once
// Wavefront OBJ: text with the shortest decimals that read back as the same doubles; the CRS in a .prj.

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"

namespace tinsmith {

struct MeshVisitor;

/// As write_mesh and visit_mesh, for this format. Reads plain `v x y z` and `f a b c` only.
void write_obj(const std::string& path, const TerrainSurface& surface, const GridFrame& frame);
std::string visit_obj(const std::string& path, const MeshVisitor& visitor);

}  // namespace tinsmith
