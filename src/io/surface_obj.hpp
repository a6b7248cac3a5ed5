#pragma once
// Wavefront OBJ: v with or without colours, vn, f; the shortest decimals that read back as the same numbers.

#include <string>

#include "tinsmith/surface.hpp"

namespace tinsmith {

/// As read_surface and write_surface, for this format. The reader leaves indices of triangles in range; what the
/// numbers at the vertices are worth is for its caller to check.
Surface read_surface_obj(const std::string& path);
void write_surface_obj(const std::string& path, const Surface& surface);

}  // namespace tinsmith
