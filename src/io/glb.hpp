#pragma once
// glTF 2.0 binary, Y up: float32 positions that are exact in plan, about a local origin that the node carries
// in double precision.

#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// As height_rounding, for this format.
double glb_height_rounding(double lowest, double highest);

/// As write_mesh and read_mesh, for this format.
void write_glb(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame);
Tin read_glb(const std::string& path);

}  // namespace tinsmith
