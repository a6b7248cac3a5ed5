#include "simplify/surface_splits.hpp"

#include <array>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A halfedge with what goes with it.
struct Corner {
  std::int32_t origin;
  std::int32_t wedge;
  std::uint8_t is_feature = 0;
};

Corner corner_of(const SurfaceMesh& mesh, std::int32_t h) {
  return {mesh.origin[at(h)], mesh.wedge[at(h)], mesh.is_feature[at(h)]};
}

void set(SurfaceMesh& mesh, std::int32_t h, const Corner& corner) {
  mesh.origin[at(h)] = corner.origin;
  mesh.wedge[at(h)] = corner.wedge;
  mesh.is_feature[at(h)] = corner.is_feature;
}

Corner without_line(Corner corner) {
  corner.is_feature = 0;
  return corner;
}

void pair(SurfaceMesh& mesh, std::int32_t h, std::int32_t g) {
  mesh.twin[at(h)] = g;
  if (g != kNone) mesh.twin[at(g)] = h;
}

// The edge of `from` is that of `to` now.
void hand_on(SurfaceMesh& mesh, std::int32_t from, std::int32_t to) {
  const std::int32_t v = mesh.origin[at(from)];
  set(mesh, to, corner_of(mesh, from));
  pair(mesh, to, mesh.twin[at(from)]);
  if (mesh.out[at(v)] == from) mesh.out[at(v)] = to;
}

// Takes the half after the vertex off the triangle of h: of (a, b, c), with h from a to b, what is left is
// (a, v, c), and the new triangle, whose first halfedge is `gone`, is (v, b, c).
void halve(SurfaceMesh& mesh, std::int32_t h, const NewVertex& added, std::int32_t gone) {
  const std::int32_t next = Halfedges::next(h);
  const Corner v{added.vertex, added.wedge};
  set(mesh, gone, {added.vertex, added.wedge, mesh.is_feature[at(h)]});
  hand_on(mesh, next, gone + 1);
  set(mesh, gone + 2, without_line(corner_of(mesh, Halfedges::previous(h))));
  set(mesh, next, v);
  pair(mesh, next, gone + 2);
}

}  // namespace

std::int32_t find_gone_triangle(const SurfaceMesh& mesh, std::int32_t from) {
  while (mesh.origin[at(from)] != kNone) from += 3;
  return from;
}

void split_triangle(SurfaceMesh& mesh, std::int32_t h, const NewVertex& added, std::int32_t gone) {
  const std::int32_t next = Halfedges::next(h);
  const std::int32_t previous = Halfedges::previous(h);
  const Corner v{added.vertex, added.wedge};
  const Corner a = corner_of(mesh, h);
  const Corner b = corner_of(mesh, next);
  const Corner c = corner_of(mesh, previous);
  const std::int32_t over_bc = gone;
  hand_on(mesh, next, over_bc);
  set(mesh, over_bc + 1, without_line(c));
  set(mesh, over_bc + 2, v);
  const std::int32_t over_ca = find_gone_triangle(mesh, gone);
  hand_on(mesh, previous, over_ca);
  set(mesh, over_ca + 1, without_line(a));
  set(mesh, over_ca + 2, v);
  set(mesh, next, without_line(b));
  set(mesh, previous, v);
  pair(mesh, next, over_bc + 2);
  pair(mesh, over_bc + 1, over_ca + 2);
  pair(mesh, over_ca + 1, previous);
  mesh.out[at(added.vertex)] = previous;
}

void split_edge(SurfaceMesh& mesh, std::int32_t h, const NewVertex& added, std::int32_t gone) {
  const std::int32_t g = mesh.twin[at(h)];
  const std::int32_t beyond = gone;
  halve(mesh, h, added, beyond);
  mesh.out[at(added.vertex)] = beyond;
  mesh.twin[at(beyond)] = kNone;
  if (g == kNone) return;
  // Of (b, a, d), with g from b to a, the half at b is left.
  const std::int32_t across = find_gone_triangle(mesh, gone);
  halve(mesh, g, added, across);
  pair(mesh, h, across);
  pair(mesh, g, beyond);
}

}  // namespace tinsmith
