#pragma once
// PLY of any writer: ascii or binary of either byte order, elements and properties of any type and order.

#include <string>

#include "tinsmith/surface.hpp"

namespace tinsmith {

/// As read_surface and write_surface, for this format. The reader leaves indices of triangles in range; what the
/// numbers at the vertices are worth is for its caller to check.
Surface read_surface_ply(const std::string& path);
void write_surface_ply(const std::string& path, const Surface& surface);

}  // namespace tinsmith
