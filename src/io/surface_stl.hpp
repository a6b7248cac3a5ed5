#pragma once
// STL: triangles and nothing else. Corners at the same place become one vertex.

#include <string>

#include "tinsmith/surface.hpp"

namespace tinsmith {

/// As read_surface and write_surface, for this format. The reader leaves indices of triangles in range; what the
/// numbers at the vertices are worth is for its caller to check.
Surface read_surface_stl(const std::string& path);
void write_surface_stl(const std::string& path, const Surface& surface);

}  // namespace tinsmith
