#pragma once
// PLY, binary little endian: vertices as doubles, triangles as lists, the CRS as a comment (as MDAL reads it).
//
// Indices are int, which every reader knows, uint from 2^31 vertices, and double beyond 2^32: PLY's eight types
// have no wider integer (the int64 that some programs add stops all others), and a double holds indices to 2^53.

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"

namespace tinsmith {

struct MeshVisitor;

/// As write_mesh and visit_mesh, for this format.
void write_ply(const std::string& path, const TerrainSurface& surface, const GridFrame& frame);
std::string visit_ply(const std::string& path, const MeshVisitor& visitor);

}  // namespace tinsmith
