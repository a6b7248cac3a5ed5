#pragma once
// Triangle meshes in space, as plain data: 3-D scans, models, terrain with colour. And their files.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tinsmith {

/// What the values at the vertices mean.
enum class AttributeKind {
  kColour,  // r g b in [0, 1], sRGB as in images; linear in .glb, converted on reading and writing
  kNormal,  // x y z of unit length; 0 0 0 where a file has none
  kScalar,  // one number of any range
};

/// Values at every vertex.
struct SurfaceAttribute {
  AttributeKind kind = AttributeKind::kScalar;
  std::string name;           // of a scalar, as the file calls it; else empty
  std::vector<float> values;  // components() for each vertex, vertex by vertex

  int components() const { return kind == AttributeKind::kScalar ? 1 : 3; }
};

/// An indexed triangle mesh; triangles are counter-clockwise seen from outside. A vertex with two colours or
/// normals (a seam of the attributes) is there once for each, at the same position.
struct Surface {
  std::vector<std::array<double, 3>> position;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<SurfaceAttribute> attributes;  // at most one colour and one normal

  /// Null when there is none.
  const SurfaceAttribute* find(AttributeKind kind) const {
    for (const SurfaceAttribute& attribute : attributes) {
      if (attribute.kind == kind) return &attribute;
    }
    return nullptr;
  }
};

/// Reads .ply (ascii or binary, any property types; red green blue as bytes or floats, nx ny nz, other vertex
/// properties as scalars), .obj (v with or without colours, vn; a v with two vn is split), .stl (ascii or binary:
/// corners at the same place become one vertex) and .glb (POSITION, NORMAL, COLOR_0; node transforms applied).
/// Polygons are cut into fans of triangles, normals brought to unit length. Throws InputError, with the place of
/// the damage, for anything that is not a whole, valid file.
Surface read_surface(const std::string& path);

/// Writes .ply (binary little endian, doubles), .obj, .stl (binary) or .glb, aside and renamed when whole. The
/// bytes depend on the surface only. Throws UsageError for other extensions, OutputError, and ResourceError when
/// the format can't hold the mesh. STL holds no attributes, OBJ and GLB no scalars.
void write_surface(const std::string& path, const Surface& surface);

}  // namespace tinsmith
