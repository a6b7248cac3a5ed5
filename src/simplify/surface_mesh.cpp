#include "simplify/surface_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "mesh/surface_definition.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Representatives of vertices at bit-identical places: the first of each place.
std::vector<std::uint32_t> first_at_place(const Surface& surface) {
  struct Placed {
    Vec<3> place;
    std::uint32_t vertex;
  };
  std::vector<Placed> order;
  order.reserve(surface.position.size());
  for (std::uint32_t v = 0; v < surface.position.size(); ++v) order.push_back({surface.position[v], v});
  std::sort(order.begin(), order.end(), [](const Placed& a, const Placed& b) {
    return a.place != b.place ? a.place < b.place : a.vertex < b.vertex;
  });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && order[i].place == order[i - 1].place;
    first[order[i].vertex] = is_same ? first[order[i - 1].vertex] : order[i].vertex;
  }
  return first;
}

bool are_all_different(const std::vector<std::uint32_t>& first) {
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] != v) return false;
  }
  return true;
}

// The same triangles over one vertex for each place. None when that is no manifold with the same triangles: two
// sheets that lie on each other, for example.
std::optional<ManifoldSurface> welded(const ManifoldSurface& pieces, const std::vector<std::uint32_t>& first) {
  Surface surface;
  surface.position = pieces.surface.position;
  for (const auto& [a, b, c] : pieces.surface.triangles)
    surface.triangles.push_back({first[a], first[b], first[c]});
  SurfaceDefects defects;
  ManifoldSurface whole = manifold_of(surface, defects);
  const bool has_lost = defects.duplicated_triangles + defects.flipped_triangles > 0 ||
                        whole.surface.triangles.size() != pieces.surface.triangles.size();
  if (has_lost) return std::nullopt;
  for (std::size_t v = 0; v < whole.is_locked.size(); ++v)
    whole.is_locked[v] = whole.is_locked[v] || pieces.is_locked[whole.original_vertex[v]];
  return whole;
}

std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

// Where pieces meet without being welded they must not part. Vertices that edges without length join are of one
// piece, and free to collapse.
void lock_coincident(ManifoldSurface& pieces, const std::vector<std::uint32_t>& first) {
  std::vector<std::uint32_t> parent(first.size());
  std::iota(parent.begin(), parent.end(), 0U);
  for (const auto& t : pieces.surface.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i];
      const std::uint32_t b = t[(i + 1) % 3];
      if (first[a] == first[b]) parent[root_of(parent, a)] = root_of(parent, b);
    }
  }
  std::vector<std::uint8_t> is_shared(first.size(), 0);  // by the first vertex of the place
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (root_of(parent, v) != root_of(parent, first[v])) is_shared[first[v]] = 1;
  }
  for (std::size_t v = 0; v < first.size(); ++v) {
    if (is_shared[first[v]]) pieces.is_locked[v] = 1;
  }
}

void find_scale(SurfaceMesh& mesh, const std::vector<std::array<double, 3>>& positions) {
  if (positions.empty()) return;
  Vec<3> low = positions.front();
  Vec<3> high = low;
  for (const auto& p : positions) {
    for (std::size_t i = 0; i < 3; ++i) {
      low[i] = std::min(low[i], p[i]);
      high[i] = std::max(high[i], p[i]);
    }
  }
  const double extent = std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]});
  mesh.extent = extent > 0 ? extent : 1;
  for (std::size_t i = 0; i < 3; ++i) mesh.middle[i] = low[i] + (high[i] - low[i]) / 2;
}

// Where a place, in the mesh's coordinates, lies along a Z-shaped curve (Morton 1966).
std::uint64_t place_on_curve(const Vec<3>& p) {
  constexpr double kSteps = 65535;
  // Bit i goes to bit 3 i.
  const auto spread = [](std::uint64_t x) {
    x = (x | x << 16U) & 0x0000FF0000FFU;
    x = (x | x << 8U) & 0x00F00F00F00FU;
    x = (x | x << 4U) & 0x0C30C30C30C3U;
    return (x | x << 2U) & 0x249249249249U;
  };
  std::uint64_t place = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double step = std::clamp((p[i] + 0.5) * kSteps, 0.0, kSteps);
    place |= spread(static_cast<std::uint64_t>(step)) << i;
  }
  return place;
}

// Along the curve. Returns the new numbers.
std::vector<std::uint32_t> add_vertices(SurfaceMesh& mesh, const ManifoldSurface& surface) {
  struct Placed {
    std::uint64_t place;
    std::uint32_t vertex;
  };
  std::vector<Placed> order;
  order.reserve(surface.surface.position.size());
  for (std::uint32_t v = 0; v < surface.surface.position.size(); ++v)
    order.push_back({place_on_curve(scaled(mesh, surface.surface.position[v])), v});
  std::sort(order.begin(), order.end(), [](const Placed& a, const Placed& b) {
    return a.place != b.place ? a.place < b.place : a.vertex < b.vertex;
  });
  std::vector<std::uint32_t> number(order.size());
  mesh.position.reserve(order.size());
  mesh.kind.reserve(order.size());
  for (const auto& [place, v] : order) {
    number[v] = static_cast<std::uint32_t>(mesh.position.size());
    mesh.position.push_back(scaled(mesh, surface.surface.position[v]));
    mesh.kind.push_back(surface.is_locked[v] ? SurfaceVertexKind::kLocked : SurfaceVertexKind::kInterior);
  }
  return number;
}

// In the order of their first vertices.
void add_triangles(SurfaceMesh& mesh, const ManifoldSurface& surface, const std::vector<std::uint32_t>& number) {
  const auto& originals = surface.surface.triangles;
  const auto first_vertex = [&](std::uint32_t t) {
    const auto& [a, b, c] = originals[t];
    return std::min({number[a], number[b], number[c]});
  };
  std::vector<std::uint32_t> next(number.size() + 1, 0);
  for (std::uint32_t t = 0; t < originals.size(); ++t) ++next[first_vertex(t) + 1];
  std::partial_sum(next.begin(), next.end(), next.begin());
  mesh.original_triangle.resize(originals.size());
  for (std::uint32_t t = 0; t < originals.size(); ++t) mesh.original_triangle[next[first_vertex(t)]++] = t;
  std::vector<std::array<std::int32_t, 3>> triangles;
  triangles.reserve(originals.size());
  for (const std::uint32_t t : mesh.original_triangle) {
    const auto& [a, b, c] = originals[t];
    triangles.push_back({static_cast<std::int32_t>(number[a]), static_cast<std::int32_t>(number[b]),
                         static_cast<std::int32_t>(number[c])});
  }
  connect(mesh, triangles, mesh.position.size());
}

// In the order of their vertices. The pieces have the same triangles in the same order.
void add_wedges(SurfaceMesh& mesh, const ManifoldSurface& pieces) {
  std::vector<std::int32_t> number(pieces.original_vertex.size(), kNone);
  mesh.wedge.resize(mesh.origin.size());
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.position.size()); ++v) {
    for_each_out(mesh, v, [&](std::int32_t h) {
      const std::uint32_t corner = pieces.surface.triangles[mesh.original_triangle[at(h / 3)]][at(h % 3)];
      if (number[corner] == kNone) {
        number[corner] = static_cast<std::int32_t>(mesh.original_vertex.size());
        mesh.original_vertex.push_back(pieces.original_vertex[corner]);
      }
      mesh.wedge[at(h)] = number[corner];
    });
  }
}

// Every vertex keeps one of its wedges.
void unite_wedges(SurfaceMesh& mesh) {
  for (std::size_t h = 0; h < mesh.wedge.size(); ++h) mesh.wedge[h] = mesh.wedge[at(mesh.out[at(mesh.origin[h])])];
}

Vec<3> normal_of(const SurfaceMesh& mesh, std::int32_t h) {
  const Vec<3>& a = mesh.position[at(mesh.origin[at(h)])];
  const Vec<3> ab = mesh.position[at(mesh.destination(h))] - a;
  return cross(ab, mesh.position[at(mesh.origin[at(Halfedges::previous(h))])] - a);
}

double mean_area(const SurfaceMesh& mesh) {
  double sum = 0;
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) sum += triangle_area(mesh, h);
  return mesh.n_halfedges() > 0 ? 3 * sum / mesh.n_halfedges() : 0;
}

bool is_crease(const SurfaceMesh& mesh, std::int32_t h, double least_cosine) {
  const Vec<3> n0 = normal_of(mesh, h);
  const Vec<3> n1 = normal_of(mesh, mesh.twin[at(h)]);
  return dot(n0, n1) < least_cosine * std::sqrt(dot(n0, n0) * dot(n1, n1));
}

using VertexPair = std::array<std::uint32_t, 2>;
VertexPair ordered(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

bool is_listed(const SurfaceMesh& mesh, std::int32_t h, const std::vector<VertexPair>& list) {
  const auto original = [&](std::int32_t e) { return mesh.original_vertex[at(mesh.wedge[at(e)])]; };
  const std::int32_t g = mesh.twin[at(h)];
  return std::binary_search(list.begin(), list.end(), ordered(original(h), original(Halfedges::next(h)))) ||
         std::binary_search(list.begin(), list.end(), ordered(original(g), original(Halfedges::next(g))));
}

// Two features that go on in nearly one direction are a line; a sharper turn is a corner.
constexpr double kStraightCosine = 0.5;  // 60 degrees

SurfaceVertexKind kind_of(const SurfaceMesh& mesh, std::int32_t v, const std::vector<std::int32_t>& ends) {
  if (ends.empty()) return SurfaceVertexKind::kInterior;
  if (ends.size() != 2) return SurfaceVertexKind::kCorner;
  const Vec<3> in = mesh.position[at(v)] - mesh.position[at(ends[0])];
  const Vec<3> out = mesh.position[at(ends[1])] - mesh.position[at(v)];
  const bool is_straight = dot(in, out) > kStraightCosine * std::sqrt(dot(in, in) * dot(out, out));
  return is_straight ? SurfaceVertexKind::kFeature : SurfaceVertexKind::kCorner;
}

}  // namespace

Vec<3> scaled(const SurfaceMesh& mesh, const Vec<3>& p) {
  Vec<3> q = p - mesh.middle;
  for (double& x : q) x /= mesh.extent;
  return q;
}

std::array<Vec<3>, 3> corners_of(const SurfaceMesh& mesh, std::int32_t h) {
  const auto place = [&](std::int32_t side) { return mesh.position[at(mesh.origin[at(side)])]; };
  return {place(h), place(Halfedges::next(h)), place(Halfedges::previous(h))};
}

void carry_feature(SurfaceMesh& mesh, std::int32_t h) {
  const std::uint8_t is_feature =
      mesh.is_feature[at(Halfedges::next(h))] | mesh.is_feature[at(Halfedges::previous(h))];
  for (const std::int32_t side : {Halfedges::next(h), Halfedges::previous(h)}) {
    if (mesh.twin[at(side)] != kNone) mesh.is_feature[at(mesh.twin[at(side)])] = is_feature;
  }
}

bool is_seam(const SurfaceMesh& mesh, std::int32_t h) {
  const std::int32_t g = mesh.twin[at(h)];
  return mesh.wedge[at(h)] != mesh.wedge[at(Halfedges::next(g))] ||
         mesh.wedge[at(Halfedges::next(h))] != mesh.wedge[at(g)];
}

double triangle_area(const SurfaceMesh& mesh, std::int32_t h) {
  const Vec<3> n = normal_of(mesh, h);
  return std::sqrt(dot(n, n)) / 2;
}

SurfaceMesh surface_mesh_of(const Surface& surface, SurfaceDefects& defects) {
  ManifoldSurface pieces = manifold_of(surface, defects);
  const std::vector<std::uint32_t> first = first_at_place(pieces.surface);
  std::optional<ManifoldSurface> whole;
  if (!are_all_different(first)) {
    whole = welded(pieces, first);
    if (!whole) lock_coincident(pieces, first);
  }
  const ManifoldSurface& places = whole ? *whole : pieces;
  SurfaceMesh mesh;
  find_scale(mesh, places.surface.position);
  add_triangles(mesh, places, add_vertices(mesh, places));
  mesh.mean_area = mean_area(mesh);
  add_wedges(mesh, pieces);
  return mesh;
}

std::uint64_t count_components(const SurfaceMesh& mesh) {
  std::vector<std::uint32_t> parent(mesh.position.size());
  std::iota(parent.begin(), parent.end(), 0U);
  // Every vertex has triangles, and one fan of them: parts share no vertex.
  std::uint64_t n = parent.size();
  for (std::size_t h = 0; h < mesh.origin.size(); ++h) {
    const std::uint32_t a = root_of(parent, static_cast<std::uint32_t>(mesh.origin[h]));
    const std::uint32_t b =
        root_of(parent, static_cast<std::uint32_t>(mesh.destination(static_cast<std::int32_t>(h))));
    if (a == b) continue;
    parent[a] = b;
    --n;
  }
  return n;
}

void mark_features(SurfaceMesh& mesh, const SimplifySurfaceOptions& options, SimplifySurfaceReport& report) {
  constexpr double kDegree = 3.14159265358979323846 / 180;
  std::optional<double> least_cosine;  // none: no edge is a crease
  if (options.crease) least_cosine = std::cos(*options.crease * kDegree);
  std::vector<VertexPair> list;
  for (const auto& [a, b] : options.feature_edges) list.push_back(ordered(a, b));
  std::sort(list.begin(), list.end());
  if (!options.keep_seams) unite_wedges(mesh);
  mesh.is_feature.assign(mesh.origin.size(), 0);
  std::vector<std::vector<std::int32_t>> ends(mesh.position.size());
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    const std::int32_t g = mesh.twin[at(h)];
    if (g != kNone && g < h) continue;
    if (g == kNone) {
      ++report.border_edges;
    } else {
      if (!is_seam(mesh, h) && !(least_cosine && is_crease(mesh, h, *least_cosine)) &&
          (list.empty() || !is_listed(mesh, h, list)))
        continue;
      ++report.feature_edges;
      mesh.is_feature[at(g)] = 1;
    }
    mesh.is_feature[at(h)] = 1;
    ends[at(mesh.origin[at(h)])].push_back(mesh.destination(h));
    ends[at(mesh.destination(h))].push_back(mesh.origin[at(h)]);
  }
  for (std::size_t v = 0; v < ends.size(); ++v) {
    if (mesh.kind[v] != SurfaceVertexKind::kLocked)
      mesh.kind[v] = kind_of(mesh, static_cast<std::int32_t>(v), ends[v]);
  }
}

}  // namespace tinsmith
