#pragma once
// Vertices that come to a surface in the middle of a triangle or of an edge.

#include <cstdint>

#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// A vertex that comes, and its only wedge. Both were the input's and are gone; the place and the kind are set.
struct NewVertex {
  std::int32_t vertex;
  std::int32_t wedge;
};

/// The first halfedge of a triangle that is gone, from `from` (another such) on.
std::int32_t find_gone_triangle(const SurfaceMesh& mesh, std::int32_t from);

/// Replaces the triangle of h by three around the vertex; `gone` and another one after it are used.
void split_triangle(SurfaceMesh& mesh, std::int32_t h, const NewVertex& added, std::int32_t gone);

/// Puts the vertex on the edge of h, which is no seam: two triangles become four, at a border one becomes two. A
/// line goes on through it.
void split_edge(SurfaceMesh& mesh, std::int32_t h, const NewVertex& added, std::int32_t gone);

}  // namespace tinsmith
