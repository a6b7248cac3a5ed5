#pragma once
// glTF 2.0 binary, Y up: float32 positions that are exact in plan, about a local origin that the node carries
// in double precision.
//
// World coordinates are glTF metres: X east, Y up, Z = -north, each the CRS coordinate times metres_per_unit (of
// a geographic CRS: metres per degree at the middle of the mesh). The node's extras say how to undo that:
//   crs_wkt, origin [x, y, z in CRS units], metres_per_unit [of x, y, z],
//   geotransform [GDAL's six], origin_column, origin_row [the sample at the local origin].
// Colours are COLOR_0, linear as glTF asks, so that viewers show them as the ortho: whole levels of sRGB as
// normalised 16-bit numbers, which tell all levels apart. Alpha is linear anyway.

#include <cstdint>
#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"

namespace tinsmith {

struct MeshVisitor;

/// As height_rounding, for this format.
double glb_height_rounding(double lowest, double highest);

/// As require_format_holds, for this format.
void require_glb_holds(const std::string& path, std::uint64_t n_vertices, std::uint64_t n_triangles);

/// As write_mesh and visit_mesh, for this format.
void write_glb(const std::string& path, const TerrainSurface& surface, const GridFrame& frame);
std::string visit_glb(const std::string& path, const MeshVisitor& visitor);

}  // namespace tinsmith
