// The surface model of the paper (definitions 1 to 4). Corner 3 t + k is vertex k of triangle t; its side runs from
// there to the next vertex. Triangles are turned over and given their new vertices at the end only, so that corners
// keep their numbers.

#include "mesh/surface_definition.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "mesh/halfedges.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Triangles = std::vector<Triangle>;

// ---------------------------------------------------------------- what can't be mended

bool is_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

void check_vertices(const Surface& s) {
  for (std::size_t v = 0; v < s.position.size(); ++v)
    if (!is_finite(s.position[v]))
      throw InputError(fmt::format("surface: vertex {} has no finite position; remove it and its triangles", v));
  for (const SurfaceAttribute& attribute : s.attributes) {
    const std::size_t n = s.position.size() * static_cast<std::size_t>(attribute.components());
    if (attribute.values.size() != n)
      throw InputError(fmt::format("surface: an attribute has {} values for {} vertices; give it {}",
                                   attribute.values.size(), s.position.size(), n));
    const auto found =
        std::find_if(attribute.values.begin(), attribute.values.end(), [](float x) { return !std::isfinite(x); });
    if (found != attribute.values.end())
      throw InputError(fmt::format("surface: vertex {} has an attribute that is not a finite number; mend it",
                                   (found - attribute.values.begin()) / attribute.components()));
  }
}

/// Vertices and corners are numbered in 32 bits.
void check_counts(const Surface& s) {
  constexpr std::size_t kLargest = std::numeric_limits<std::uint32_t>::max() / 3;
  if (s.position.size() > kLargest || s.triangles.size() > kLargest)
    throw ResourceError(
        fmt::format("surface: {} vertices and {} triangles, where {} of each are the most; cut it in parts",
                    s.position.size(), s.triangles.size(), kLargest));
}

void check_triangles(const Surface& s) {
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (const std::uint32_t v : s.triangles[t])
      if (v >= s.position.size())
        throw InputError(
            fmt::format("surface: triangle {} has vertex {}, but there are {} vertices; mend its numbers", t, v,
                        s.position.size()));
}

// ---------------------------------------------------------------- groups

template <class Key>
struct Entry {
  Key key;
  std::uint32_t item;
};

/// Entries of bucket b from start[b] to start[b + 1], by key and then by item.
template <class Key>
struct Buckets {
  std::vector<std::uint32_t> start;
  std::vector<Entry<Key>> entries;
};

/// Linear but for the sorting within a bucket, which holds a few.
template <class Key, class BucketOf, class KeyOf>
Buckets<Key> sort_into_buckets(std::size_t n_items, std::size_t n_buckets, const BucketOf& bucket_of,
                               const KeyOf& key_of) {
  Buckets<Key> result{std::vector<std::uint32_t>(n_buckets + 1), std::vector<Entry<Key>>(n_items)};
  const auto n = static_cast<std::uint32_t>(n_items);
  for (std::uint32_t i = 0; i < n; ++i) ++result.start[bucket_of(i)];
  std::partial_sum(result.start.begin(), result.start.end(), result.start.begin());
  for (std::uint32_t i = n; i-- > 0;) result.entries[--result.start[bucket_of(i)]] = {key_of(i), i};
  const auto at = [&](std::size_t b) { return result.entries.begin() + result.start[b]; };
  for (std::size_t b = 0; b < n_buckets; ++b)
    std::sort(at(b), at(b + 1), [](const Entry<Key>& one, const Entry<Key>& other) {
      return std::pair(one.key, one.item) < std::pair(other.key, other.item);
    });
  return result;
}

/// Calls visit(entries) for those of the same bucket and key.
template <class Key, class Visit>
void for_each_group(const Buckets<Key>& buckets, const Visit& visit) {
  const std::span<const Entry<Key>> entries(buckets.entries);
  for (std::size_t b = 0; b + 1 < buckets.start.size(); ++b)
    for (std::size_t begin = buckets.start[b], end = begin; begin < buckets.start[b + 1]; begin = end) {
      while (end < buckets.start[b + 1] && entries[end].key == entries[begin].key) ++end;
      visit(entries.subspan(begin, end - begin));
    }
}

/// Items in sets, each item like or unlike the first of its set, which stands for the set.
class ParitySets {
 public:
  explicit ParitySets(std::size_t n) : parent_(n), is_unlike_(n) {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
  }

  struct Found {
    std::uint32_t first;
    bool is_unlike;  // the item to the first
  };

  Found find(std::uint32_t i) {
    bool is_unlike = false;
    while (parent_[i] != i) {  // halves the path on the way
      is_unlike_[i] ^= is_unlike_[parent_[i]];
      parent_[i] = parent_[parent_[i]];
      is_unlike ^= is_unlike_[i] != 0;
      i = parent_[i];
    }
    return {i, is_unlike};
  }

  /// False, and nothing done, if it contradicts what was said before.
  bool unite(std::uint32_t i, std::uint32_t j, bool are_unlike) {
    Found a = find(i), b = find(j);
    are_unlike ^= a.is_unlike != b.is_unlike;
    if (a.first == b.first) return !are_unlike;
    if (b.first < a.first) std::swap(a, b);
    parent_[b.first] = a.first;
    is_unlike_[b.first] = are_unlike ? 1 : 0;
    return true;
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<std::uint8_t> is_unlike_;  // to the parent
};

// ---------------------------------------------------------------- what is removed

bool has_vertex_twice(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// No area that is larger than the rounding of its cross product.
bool has_no_area(const Surface& s, const Triangle& t) {
  std::array<double, 3> u{}, w{};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = s.position[t[1]][k] - s.position[t[0]][k];
    w[k] = s.position[t[2]][k] - s.position[t[0]][k];
  }
  const double x = u[1] * w[2] - u[2] * w[1], y = u[2] * w[0] - u[0] * w[2], z = u[0] * w[1] - u[1] * w[0];
  const double longest = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) *  //
                         std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
  constexpr double kEpsilon = 4 * std::numeric_limits<double>::epsilon();
  return std::sqrt(x * x + y * y + z * z) <= kEpsilon * longest;
}

Triangles without_degenerate(const Surface& s, SurfaceDefects& defects) {
  Triangles kept;
  kept.reserve(s.triangles.size());
  for (const Triangle& t : s.triangles) {
    const bool is_edge = has_vertex_twice(t);
    if (!is_edge) kept.push_back(t);
    if (is_edge || has_no_area(s, t)) ++defects.degenerate_triangles;
  }
  return kept;
}

/// Keeps the first of those with the same vertices, whatever their order.
Triangles without_duplicated(const Triangles& triangles, std::size_t n_vertices, SurfaceDefects& defects) {
  const auto lowest = [&](std::uint32_t t) {
    return std::min({triangles[t][0], triangles[t][1], triangles[t][2]});
  };
  const auto other_two = [&](std::uint32_t t) {
    Triangle sorted = triangles[t];
    std::sort(sorted.begin(), sorted.end());
    return std::uint64_t{sorted[1]} << 32U | sorted[2];
  };
  const auto buckets = sort_into_buckets<std::uint64_t>(triangles.size(), n_vertices, lowest, other_two);
  std::vector<std::uint8_t> is_duplicated(triangles.size());
  for_each_group(buckets, [&](std::span<const Entry<std::uint64_t>> same) {
    for (const auto& entry : same.subspan(1)) is_duplicated[entry.item] = 1;
    defects.duplicated_triangles += same.size() - 1;
  });
  Triangles kept;
  kept.reserve(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (is_duplicated[t] == 0) kept.push_back(triangles[t]);
  return kept;
}

// ---------------------------------------------------------------- what is a surface already

/// Whether another triangle has the same vertices.
bool is_duplicated(const Halfedges& mesh, std::int32_t h) {
  const auto beyond = [&](std::int32_t side) {
    const std::int32_t g = mesh.twin[static_cast<std::size_t>(side)];
    return g == kNone ? kNone : g / 3;
  };
  return beyond(h) != kNone && beyond(h) == beyond(h + 1) && beyond(h) == beyond(h + 2);
}

/// Whether there is nothing to mend, as in most files: vertices have one fan each, from which no neighbour is met
/// twice, so that no side is there twice, and no two triangles lie on each other.
bool is_surface(const Triangles& triangles, std::size_t n_vertices) {
  constexpr std::size_t kLargest = std::numeric_limits<std::int32_t>::max() / 3;
  if (triangles.size() > kLargest || n_vertices > kLargest) return false;
  Halfedges mesh;
  std::vector<std::array<std::int32_t, 3>> corners;
  corners.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles)
    corners.push_back({static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  if (!connect(mesh, corners, n_vertices).empty()) return false;
  std::vector<std::int32_t> met_from(n_vertices, kNone);
  bool is_met_twice = false;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(n_vertices) && !is_met_twice; ++v) {
    if (!mesh.is_alive(v)) return false;
    for_each_out(mesh, v, [&](std::int32_t h) {
      std::int32_t& from = met_from[static_cast<std::size_t>(mesh.destination(h))];
      is_met_twice = is_met_twice || from == v;
      from = v;
    });
  }
  if (is_met_twice) return false;
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    if (is_duplicated(mesh, h)) return false;
  }
  return true;
}

/// The original with these triangles and the same vertices.
ManifoldSurface unchanged(const Surface& original, Triangles&& triangles) {
  const std::size_t n_vertices = original.position.size();
  ManifoldSurface result;
  result.surface = {original.position, std::move(triangles), original.attributes};
  result.is_locked.assign(n_vertices, 0);
  result.original_vertex.resize(n_vertices);
  std::iota(result.original_vertex.begin(), result.original_vertex.end(), 0U);
  return result;
}

// ---------------------------------------------------------------- orientation

using Side = Entry<std::uint32_t>;  // key: the edge's higher vertex; item: the corner where the side begins

std::uint32_t next_corner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::uint32_t vertex_at(const Triangles& triangles, std::uint32_t corner) {
  return triangles[corner / 3][corner % 3];
}

bool runs_upwards(const Triangles& triangles, std::uint32_t corner) {
  return vertex_at(triangles, corner) < vertex_at(triangles, next_corner(corner));
}

/// The sides of all triangles, those of one edge in a group.
Buckets<std::uint32_t> find_edges(const Triangles& triangles, std::size_t n_vertices) {
  const auto ends = [&](std::uint32_t corner) {
    return std::minmax({vertex_at(triangles, corner), vertex_at(triangles, next_corner(corner))});
  };
  return sort_into_buckets<std::uint32_t>(
      3 * triangles.size(), n_vertices, [&](std::uint32_t corner) { return ends(corner).first; },
      [&](std::uint32_t corner) { return ends(corner).second; });
}

/// Which triangles to turn over: in each part that hangs together over edges with two triangles the fewer, and of
/// as many those unlike its first triangle. Where two triangles agree is settled first, so that on a surface that
/// can't be oriented only the disagreement that was there is left.
std::vector<std::uint8_t> find_flipped(const Triangles& triangles, const Buckets<std::uint32_t>& edges) {
  std::vector<std::array<std::uint32_t, 2>> disagreeing;
  ParitySets parts(triangles.size());
  for_each_group(edges, [&](std::span<const Side> sides) {
    if (sides.size() != 2) return;
    const std::uint32_t a = sides[0].item, b = sides[1].item;
    if (runs_upwards(triangles, a) == runs_upwards(triangles, b))
      disagreeing.push_back({a / 3, b / 3});
    else
      parts.unite(a / 3, b / 3, false);
  });
  std::vector<std::uint8_t> is_flipped(triangles.size());
  if (disagreeing.empty()) return is_flipped;
  for (const auto& [t, u] : disagreeing) parts.unite(t, u, true);
  std::vector<std::int64_t> majority(triangles.size());  // of a part, at its first: triangles like it minus unlike
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [first, is_unlike] = parts.find(t);
    majority[first] += is_unlike ? -1 : 1;
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto [first, is_unlike] = parts.find(t);
    is_flipped[t] = is_unlike == (majority[first] >= 0) ? 1 : 0;
  }
  return is_flipped;
}

// ---------------------------------------------------------------- fans

enum class EdgeState { kManifold, kNonManifold, kUnorientable };

EdgeState state_of(const Triangles& triangles, const std::vector<std::uint8_t>& is_flipped,
                   std::span<const Side> sides) {
  if (sides.size() > 2) return EdgeState::kNonManifold;
  if (sides.size() < 2) return EdgeState::kManifold;
  const auto is_upward = [&](std::uint32_t corner) {
    return runs_upwards(triangles, corner) != (is_flipped[corner / 3] != 0);
  };
  return is_upward(sides[0].item) == is_upward(sides[1].item) ? EdgeState::kUnorientable : EdgeState::kManifold;
}

/// The corners of the triangles at an edge belong to the same fans.
void join_fans(const Triangles& triangles, std::span<const Side> sides, ParitySets& fans) {
  const auto corners = [&](std::uint32_t corner) {
    const std::uint32_t next = next_corner(corner);
    return runs_upwards(triangles, corner) ? std::pair(corner, next) : std::pair(next, corner);
  };
  const auto [low, high] = corners(sides[0].item);
  for (const Side& side : sides.subspan(1)) {
    const auto [other_low, other_high] = corners(side.item);
    fans.unite(low, other_low, false);
    fans.unite(high, other_high, false);
  }
}

/// Fans at each vertex.
std::vector<std::uint32_t> count_fans(const Triangles& triangles, std::size_t n_vertices, ParitySets& fans) {
  std::vector<std::uint32_t> n_fans(n_vertices);
  for (std::uint32_t corner = 0; corner < 3 * triangles.size(); ++corner)
    if (fans.find(corner).first == corner) ++n_fans[vertex_at(triangles, corner)];
  return n_fans;
}

/// Triangles by new vertices, and where these come from.
struct Renumbering {
  Triangles triangles;
  std::vector<std::uint32_t> original_vertex;
};

/// Vertices with a triangle keep their order and their first fan; those for more fans follow.
Renumbering renumber(const Triangles& triangles, const std::vector<std::uint32_t>& n_fans, ParitySets& fans) {
  Renumbering result{triangles, {}};
  constexpr std::uint32_t kTaken = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> number(n_fans.size(), kTaken);
  for (std::uint32_t v = 0; v < n_fans.size(); ++v) {
    if (n_fans[v] == 0) continue;
    number[v] = static_cast<std::uint32_t>(result.original_vertex.size());
    result.original_vertex.push_back(v);
  }
  for (std::uint32_t corner = 0; corner < 3 * triangles.size(); ++corner) {
    const std::uint32_t v = vertex_at(triangles, corner), first = fans.find(corner).first;
    std::uint32_t& mine = result.triangles[corner / 3][corner % 3];
    if (first != corner) {
      mine = vertex_at(result.triangles, first);
    } else if (number[v] != kTaken) {
      mine = std::exchange(number[v], kTaken);
    } else {
      mine = static_cast<std::uint32_t>(result.original_vertex.size());
      result.original_vertex.push_back(v);
    }
  }
  return result;
}

/// The fans of the triangles, cut apart at bad edges, which are counted.
ParitySets cut_at_bad_edges(const Triangles& triangles, const Buckets<std::uint32_t>& edges,
                            const std::vector<std::uint8_t>& is_flipped, SurfaceDefects& defects) {
  ParitySets fans(3 * triangles.size());
  for_each_group(edges, [&](std::span<const Side> sides) {
    switch (state_of(triangles, is_flipped, sides)) {
      case EdgeState::kManifold:
        join_fans(triangles, sides, fans);
        break;
      case EdgeState::kNonManifold:
        ++defects.non_manifold_edges;
        break;
      case EdgeState::kUnorientable:
        ++defects.unorientable_edges;
        break;
    }
  });
  return fans;
}

/// Vertices whose triangles don't hang together over any edges, bad ones included.
std::uint64_t count_pinched(const Triangles& triangles, const Buckets<std::uint32_t>& edges, std::size_t n_vertices,
                            ParitySets& fans) {
  for_each_group(edges, [&](std::span<const Side> sides) { join_fans(triangles, sides, fans); });
  const std::vector<std::uint32_t> n_fans = count_fans(triangles, n_vertices, fans);
  return static_cast<std::uint64_t>(
      std::count_if(n_fans.begin(), n_fans.end(), [](std::uint32_t n) { return n > 1; }));
}

/// The vertices of the original, in the new order.
Surface gather(const Surface& original, Renumbering& renumbering) {
  Surface result{{}, std::move(renumbering.triangles), {}};
  result.position.reserve(renumbering.original_vertex.size());
  for (const std::uint32_t v : renumbering.original_vertex) result.position.push_back(original.position[v]);
  for (const SurfaceAttribute& attribute : original.attributes) {
    result.attributes.push_back({attribute.kind, attribute.name, {}});
    std::vector<float>& mine = result.attributes.back().values;
    const std::ptrdiff_t n = attribute.components();
    mine.reserve(renumbering.original_vertex.size() * static_cast<std::size_t>(n));
    for (const std::uint32_t v : renumbering.original_vertex) {
      const auto values = attribute.values.begin() + v * n;
      mine.insert(mine.end(), values, values + n);
    }
  }
  return result;
}

}  // namespace

// Cutting at an edge takes its triangles out of each other's fans, no more. Two of them may still be the ends of
// one fan at both of its vertices (a sphere with a fin); then they run along the edge in opposite directions, as a
// fan is wound one way, and stay joined. More than two can't, as a fan has two ends. The triangles at an edge that
// can't be oriented always part, as they run in the same direction. So both ends of every bad edge have more than
// one fan, and the vertices to lock are those that have.
ManifoldSurface manifold_of(const Surface& surface, SurfaceDefects& defects) {
  check_counts(surface);
  check_vertices(surface);
  check_triangles(surface);
  defects = {};
  const std::size_t n_vertices = surface.position.size();
  Triangles proper = without_degenerate(surface, defects);
  if (is_surface(proper, n_vertices)) return unchanged(surface, std::move(proper));
  const Triangles triangles = without_duplicated(proper, n_vertices, defects);
  const Buckets<std::uint32_t> edges = find_edges(triangles, n_vertices);
  const std::vector<std::uint8_t> is_flipped = find_flipped(triangles, edges);
  defects.flipped_triangles = static_cast<std::uint64_t>(std::count(is_flipped.begin(), is_flipped.end(), 1));

  ParitySets fans = cut_at_bad_edges(triangles, edges, is_flipped, defects);
  const std::vector<std::uint32_t> n_fans = count_fans(triangles, n_vertices, fans);
  defects.unreferenced_vertices = static_cast<std::uint64_t>(std::count(n_fans.begin(), n_fans.end(), 0U));
  Renumbering renumbering = renumber(triangles, n_fans, fans);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (is_flipped[t] != 0) std::swap(renumbering.triangles[t][1], renumbering.triangles[t][2]);
  const bool is_any_cut = renumbering.original_vertex.size() > n_vertices - defects.unreferenced_vertices;
  if (is_any_cut) defects.non_manifold_vertices = count_pinched(triangles, edges, n_vertices, fans);

  ManifoldSurface result;
  result.surface = gather(surface, renumbering);
  for (const std::uint32_t v : renumbering.original_vertex) result.is_locked.push_back(n_fans[v] > 1 ? 1 : 0);
  result.original_vertex = std::move(renumbering.original_vertex);
  return result;
}

}  // namespace tinsmith
