#include "simplify/surface_wedges.hpp"

#include <algorithm>
#include <utility>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Whether the collapse of h removes the triangle of g.
bool goes(const SurfaceMesh& mesh, std::int32_t h, std::int32_t g) {
  const std::int32_t twin = mesh.twin[at(h)];
  return g / 3 == h / 3 || (twin != kNone && g / 3 == twin / 3);
}

void note_moved(const SurfaceMesh& mesh, std::int32_t h, int kept_end, SurfaceCollapse& collapse) {
  for (const WedgePair& pair : wedge_pairs(mesh, h)) {
    SurfaceCollapse::Moved moved{kept_of(pair, kept_end), gone_of(pair, kept_end), {}};
    const bool is_noted = std::any_of(collapse.moved.begin(), collapse.moved.end(),
                                      [&](const SurfaceCollapse::Moved& m) { return m.gone == moved.gone; });
    if (moved.gone == moved.kept || is_noted) continue;
    for_each_out(mesh, gone_vertex(mesh, h, kept_end), [&](std::int32_t g) {
      if (!goes(mesh, h, g) && mesh.wedge[at(g)] == moved.gone) moved.triangles.push_back(g / 3);
    });
    collapse.moved.push_back(std::move(moved));
  }
}

}  // namespace

WedgePairs wedge_pairs(const SurfaceMesh& mesh, std::int32_t h) {
  const WedgePair left{mesh.wedge[at(h)], mesh.wedge[at(Halfedges::next(h))]};
  const std::int32_t g = mesh.twin[at(h)];
  if (g == kNone) return {{left, {}}, 1};
  const WedgePair right{mesh.wedge[at(Halfedges::next(g))], mesh.wedge[at(g)]};
  const bool is_same = left.w0 == right.w0 && left.w1 == right.w1;
  return {{left, right}, is_same ? std::size_t{1} : std::size_t{2}};
}

std::int32_t gone_vertex(const SurfaceMesh& mesh, std::int32_t h, int kept_end) {
  return kept_end == 0 ? mesh.destination(h) : mesh.origin[at(h)];
}

bool has_partners(const SurfaceMesh& mesh, std::int32_t h, int kept_end) {
  const WedgePairs pairs = wedge_pairs(mesh, h);
  bool all = true;
  for_each_out(mesh, gone_vertex(mesh, h, kept_end), [&](std::int32_t g) {
    const std::int32_t w = mesh.wedge[at(g)];
    all = all &&
          std::any_of(pairs.begin(), pairs.end(), [&](const WedgePair& p) { return gone_of(p, kept_end) == w; });
  });
  return all;
}

SurfaceCollapse noted_collapse(const SurfaceMesh& mesh, std::int32_t h, int kept_end) {
  SurfaceCollapse collapse;
  for (const std::int32_t side : {h, mesh.twin[at(h)]}) {
    if (side == kNone) continue;
    const std::int32_t first = side / 3 * 3;
    collapse.removed.push_back(
        {first / 3, {mesh.wedge[at(first)], mesh.wedge[at(first + 1)], mesh.wedge[at(first + 2)]}});
  }
  note_moved(mesh, h, kept_end, collapse);
  return collapse;
}

void hand_over(SurfaceMesh& mesh, std::int32_t vertex, std::int32_t from, std::int32_t to) {
  for_each_out(mesh, vertex, [&](std::int32_t g) {
    if (mesh.wedge[at(g)] == from) mesh.wedge[at(g)] = to;
  });
}

}  // namespace tinsmith
