#pragma once
// glTF 2.0 binary of any writer: the triangles of the default scene in one surface, in the scene's coordinates.

#include <string>

#include "tinsmith/surface.hpp"

namespace tinsmith {

/// As read_surface and write_surface, for this format. The reader leaves indices of triangles in range; what the
/// numbers at the vertices are worth is for its caller to check. Where only some meshes have colours or normals,
/// the others get white, as glTF says, and 0 0 0. Colours are linear in the file, of any component type, and sRGB
/// in the surface; written as normalised 16-bit numbers, from which whole levels of sRGB come back as they were.
Surface read_surface_glb(const std::string& path);
void write_surface_glb(const std::string& path, const Surface& surface);

}  // namespace tinsmith
