#include "simplify/surface_link.hpp"

namespace tinsmith {

namespace {

constexpr std::size_t kMaxStar = 128;  // triangles around one vertex; more are slow to walk

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// So that the sides of a closed star follow each other: those of v0 from vl to vr, then those of v1 back to vl.
void start_at(SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star) {
  for (const std::int32_t g : {h, mesh.twin[at(h)]}) {
    if (g == kNone) continue;
    add_gone(mesh, g, star);
    if (!mesh.is_border_vertex(mesh.origin[at(g)])) mesh.out[at(mesh.origin[at(g)])] = g;
  }
}

// The other two sides of the triangle become one edge: not both a border or a line, and the apex keeps a triangle.
bool keeps_lines(const SurfaceMesh& mesh, std::int32_t h) {
  return !mesh.is_feature[at(Halfedges::next(h))] || !mesh.is_feature[at(Halfedges::previous(h))];
}

// A tetrahedron would fold flat.
bool keeps_volume(const SurfaceMesh& mesh, std::int32_t h, const SurfaceStar& star) {
  return mesh.is_border_edge(h) || mesh.is_border_vertex(mesh.origin[at(h)]) ||
         mesh.is_border_vertex(mesh.destination(h)) || star.sides.size() > 2;
}

}  // namespace

template <class F>
std::int32_t LinkCondition::add_sides(const SurfaceMesh& mesh, std::int32_t v, std::int32_t other,
                                      SurfaceStar& star, F&& f) {
  std::int32_t last = kNone;
  for_each_out(mesh, v, [&](std::int32_t g) {
    const std::int32_t a = mesh.destination(g);
    last = mesh.origin[at(Halfedges::previous(g))];
    f(a);
    if (a != other && last != other) add_side(mesh, g, star);
  });
  return last;
}

bool LinkCondition::holds(SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star) {
  clear(star);
  ++mark_now_;
  start_at(mesh, h, star);
  const std::int32_t v0 = mesh.origin[at(h)];
  const std::int32_t v1 = mesh.destination(h);
  const auto mark = [&](std::int32_t neighbour) { mark_[at(neighbour)] = mark_now_; };
  mark(add_sides(mesh, v0, v1, star, mark));
  int common = 0;
  const auto count = [&](std::int32_t neighbour) { common += mark_[at(neighbour)] == mark_now_ ? 1 : 0; };
  const std::int32_t last = add_sides(mesh, v1, v0, star, count);
  if (mesh.is_border_vertex(v1)) count(last);
  if (common != (mesh.is_border_edge(h) ? 1 : 2) || star.sides.empty() || star.sides.size() > kMaxStar)
    return false;
  const std::int32_t g = mesh.twin[at(h)];
  return keeps_lines(mesh, h) && (g == kNone || keeps_lines(mesh, g)) && keeps_volume(mesh, h, star);
}

}  // namespace tinsmith
