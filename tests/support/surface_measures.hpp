#pragma once
// Measures of surfaces: topology, distance, turned normals, self-intersections. Shares plain data types with src,
// and no code. Vertices are told apart by number; welded() makes it by place.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "support/surface_shapes.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith::test {

/// Vertices at the same place made one; attributes are dropped. For surfaces with seams.
inline Surface welded(const Surface& s) {
  Surface result;
  std::map<Point3, std::uint32_t> number_of;
  std::vector<std::uint32_t> welded_number;
  for (const Point3& p : s.position) {
    const auto [it, is_new] = number_of.try_emplace(p, static_cast<std::uint32_t>(result.position.size()));
    if (is_new) result.position.push_back(p);
    welded_number.push_back(it->second);
  }
  for (const auto& [a, b, c] : s.triangles)
    result.triangles.push_back({welded_number[a], welded_number[b], welded_number[c]});
  return result;
}

// ---------------------------------------------------------------- topology

/// Sets that are united until only the connected ones are left.
struct UnionFind {
  explicit UnionFind(std::size_t n) : parent(n) { std::iota(parent.begin(), parent.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) { parent[find(i)] = find(j); }
  std::vector<std::size_t> parent;
};

/// How often an edge (lower vertex first) is run along from low to high and from high to low.
struct EdgeUse {
  std::array<std::uint32_t, 2> edge{};
  int forward = 0, backward = 0;
};

/// All edges, in order.
inline std::vector<EdgeUse> edge_uses(const Surface& s) {
  std::vector<EdgeUse> uses;
  for (const auto& t : s.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      uses.push_back({{std::min(a, b), std::max(a, b)}, a < b ? 1 : 0, a < b ? 0 : 1});
    }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
  std::size_t n = 0;
  for (const EdgeUse& use : uses) {
    if (n > 0 && uses[n - 1].edge == use.edge) {
      uses[n - 1].forward += use.forward;
      uses[n - 1].backward += use.backward;
    } else {
      uses[n++] = use;
    }
  }
  uses.resize(n);
  return uses;
}

/// Loops of edges with one triangle. Loops that touch at a vertex count as one.
inline std::size_t count_borders(const Surface& s) {
  UnionFind loops(s.position.size());
  std::vector<bool> is_on_border(s.position.size());
  for (const EdgeUse& use : edge_uses(s)) {
    if (use.forward + use.backward != 1) continue;
    loops.unite(use.edge[0], use.edge[1]);
    is_on_border[use.edge[0]] = is_on_border[use.edge[1]] = true;
  }
  std::size_t n = 0;
  for (std::size_t v = 0; v < s.position.size(); ++v) n += is_on_border[v] && loops.find(v) == v ? 1 : 0;
  return n;
}

/// Vertices in use - edges + triangles.
inline std::int64_t euler_characteristic(const Surface& s) {
  std::vector<bool> is_used(s.position.size());
  for (const auto& t : s.triangles)
    for (const std::uint32_t v : t) is_used[v] = true;
  return std::count(is_used.begin(), is_used.end(), true) - std::ssize(edge_uses(s)) + std::ssize(s.triangles);
}

/// Pieces that share no vertex; vertices without triangle don't count.
inline std::size_t count_components(const Surface& s) {
  UnionFind pieces(s.position.size());
  for (const auto& [a, b, c] : s.triangles) {
    pieces.unite(a, b);
    pieces.unite(b, c);
  }
  std::vector<bool> is_root(s.position.size());
  for (const auto& t : s.triangles) is_root[pieces.find(t[0])] = true;
  return static_cast<std::size_t>(std::count(is_root.begin(), is_root.end(), true));
}

/// Handles of all pieces together: 0 for a sphere, 1 for a torus. Of an orientable manifold.
inline std::int64_t genus(const Surface& s) {
  const auto n_components = static_cast<std::int64_t>(count_components(s));
  return (2 * n_components - static_cast<std::int64_t>(count_borders(s)) - euler_characteristic(s)) / 2;
}

/// Vertices whose triangles are more than one fan, joined at the edges between them.
inline std::size_t count_pinched_vertices(const Surface& s) {
  // Corners (three for each triangle) are united over the edges at their vertex.
  UnionFind corners(3 * s.triangles.size());
  std::map<std::array<std::uint32_t, 2>, std::size_t> corner_at;  // first seen at (vertex, other end of an edge)
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3}) {
        const std::array<std::uint32_t, 2> key{s.triangles[t][k], s.triangles[t][other]};
        const auto [it, is_new] = corner_at.try_emplace(key, 3 * t + k);
        if (!is_new) corners.unite(it->second, 3 * t + k);
      }
  std::vector<int> n_fans(s.position.size());
  for (std::size_t c = 0; c < 3 * s.triangles.size(); ++c)
    if (corners.find(c) == c) ++n_fans[s.triangles[c / 3][c % 3]];
  return static_cast<std::size_t>(std::count_if(n_fans.begin(), n_fans.end(), [](int n) { return n > 1; }));
}

/// Every edge has at most two triangles, in opposite directions, and every vertex one fan.
inline bool is_manifold(const Surface& s) {
  for (const EdgeUse& use : edge_uses(s))
    if (use.forward > 1 || use.backward > 1) return false;
  return std::none_of(s.triangles.begin(), s.triangles.end(),
                      [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }) &&
         count_pinched_vertices(s) == 0;
}

inline bool is_closed_manifold(const Surface& s) { return is_manifold(s) && count_borders(s) == 0; }

// ---------------------------------------------------------------- nearest point and boxes

using Box = std::pair<Point3, Point3>;  // lowest and highest corner

inline double squared_distance(const Box& box, const Point3& p) {
  double sum = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double out = std::max({box.first[k] - p[k], p[k] - box.second[k], 0.0});
    sum += out * out;
  }
  return sum;
}

inline bool overlap(const Box& a, const Box& b) {
  for (std::size_t k = 0; k < 3; ++k)
    if (a.first[k] > b.second[k] || b.first[k] > a.second[k]) return false;
  return true;
}

inline Point3 nearest_on_segment(const Point3& p, const Point3& a, const Point3& b) {
  const Point3 ab = minus(b, a);
  const double length = dot(ab, ab);
  return length > 0 ? plus(a, times(ab, std::clamp(dot(minus(p, a), ab) / length, 0.0, 1.0))) : a;
}

/// The foot of p if it lies in the triangle, else the nearest point of its sides.
inline Point3 nearest_on_triangle(const Point3& p, const std::array<Point3, 3>& t) {
  const Point3 n = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool is_inside = dot(n, n) > 0;
  for (std::size_t k = 0; is_inside && k < 3; ++k)
    is_inside = dot(cross(n, minus(t[(k + 1) % 3], t[k])), minus(p, t[k])) >= 0;
  if (is_inside) return minus(p, times(n, dot(n, minus(p, t[0])) / dot(n, n)));
  Point3 best = nearest_on_segment(p, t[0], t[1]);
  for (std::size_t k = 1; k < 3; ++k) {
    const Point3 q = nearest_on_segment(p, t[k], t[(k + 1) % 3]);
    if (norm(minus(q, p)) < norm(minus(best, p))) best = q;
  }
  return best;
}

/// The triangles of a surface in a tree of boxes, halved along the longest axis. The surface must outlive it.
class TriangleTree {
 public:
  explicit TriangleTree(const Surface& surface) : surface_(&surface), order_(surface.triangles.size()) {
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    if (!order_.empty()) build(0, order_.size());
  }

  std::array<Point3, 3> corners(std::uint32_t t) const {
    const auto& [a, b, c] = surface_->triangles[t];
    return {surface_->position[a], surface_->position[b], surface_->position[c]};
  }

  Box box_of(std::uint32_t t) const {
    const auto [a, b, c] = corners(t);
    Box box;
    for (std::size_t k = 0; k < 3; ++k) {
      box.first[k] = std::min({a[k], b[k], c[k]});
      box.second[k] = std::max({a[k], b[k], c[k]});
    }
    return box;
  }

  /// Calls visit(triangle) for the triangles whose leaf's box may_hold(box), asked again at each box.
  template <class MayHold, class Visit>
  void visit(const MayHold& may_hold, const Visit& visit_one) const {
    if (!nodes_.empty()) visit_node(0, may_hold, visit_one);
  }

  struct Nearest {
    double distance = std::numeric_limits<double>::infinity();
    std::uint32_t triangle = 0;
    Point3 point{};
  };

  Nearest nearest(const Point3& p) const {
    Nearest best;
    if (!nodes_.empty()) search_nearest(0, p, best);
    return best;
  }

 private:
  struct Node {
    Box box;
    std::size_t begin = 0, end = 0;
    std::size_t right = 0;  // the left child follows at once; 0 in a leaf
  };

  double middle(std::uint32_t t, std::size_t axis) const {
    const auto [a, b, c] = corners(t);
    return a[axis] + b[axis] + c[axis];
  }

  std::size_t build(std::size_t begin, std::size_t end) {
    const std::size_t number = nodes_.size();
    Node node{box_of(order_[begin]), begin, end, 0};
    for (std::size_t i = begin; i < end; ++i) {
      const Box box = box_of(order_[i]);
      for (std::size_t k = 0; k < 3; ++k) {
        node.box.first[k] = std::min(node.box.first[k], box.first[k]);
        node.box.second[k] = std::max(node.box.second[k], box.second[k]);
      }
    }
    nodes_.push_back(node);
    if (end - begin <= 4) return number;
    const Point3 extent = minus(node.box.second, node.box.first);
    const auto axis = static_cast<std::size_t>(std::max_element(extent.begin(), extent.end()) - extent.begin());
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t half = (begin + end) / 2;
    std::nth_element(at(begin), at(half), at(end),
                     [&](std::uint32_t a, std::uint32_t b) { return middle(a, axis) < middle(b, axis); });
    build(begin, half);
    const std::size_t right = build(half, end);
    nodes_[number].right = right;
    return number;
  }

  template <class MayHold, class Visit>
  void visit_node(std::size_t number, const MayHold& may_hold, const Visit& visit_one) const {
    const Node& node = nodes_[number];
    if (!may_hold(node.box)) return;
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) visit_one(order_[i]);
    } else {
      visit_node(number + 1, may_hold, visit_one);
      visit_node(node.right, may_hold, visit_one);
    }
  }

  void search_nearest(std::size_t number, const Point3& p, Nearest& best) const {
    const Node& node = nodes_[number];
    if (node.right == 0) {
      for (std::size_t i = node.begin; i < node.end; ++i) {
        const Point3 q = nearest_on_triangle(p, corners(order_[i]));
        const double distance = norm(minus(q, p));
        if (distance < best.distance) best = {distance, order_[i], q};
      }
      return;
    }
    std::array<std::size_t, 2> child{number + 1, node.right};
    std::array<double, 2> away{squared_distance(nodes_[child[0]].box, p),
                               squared_distance(nodes_[child[1]].box, p)};
    if (away[1] < away[0]) {
      std::swap(child[0], child[1]);
      std::swap(away[0], away[1]);
    }
    for (std::size_t k = 0; k < 2; ++k)
      if (away[k] < best.distance * best.distance) search_nearest(child[k], p, best);
  }

  const Surface* surface_;
  std::vector<std::uint32_t> order_;
  std::vector<Node> nodes_;
};

// ---------------------------------------------------------------- distance

/// n points over the triangles, evenly by area, from a fixed seed; none without area.
inline std::vector<Point3> sample_points(const Surface& s, std::size_t n) {
  std::vector<double> area_up_to;
  double sum = 0;
  for (const auto& t : s.triangles) area_up_to.push_back(sum += norm(doubled_area_normal(s, t)));
  std::vector<Point3> points;
  std::mt19937_64 generator(20240229);
  for (std::size_t i = 0; sum > 0 && i < n; ++i) {
    // One point in each of n equal shares of the area.
    const double at = sum * (static_cast<double>(i) + unit_random(generator)) / static_cast<double>(n);
    const auto found = std::upper_bound(area_up_to.begin(), area_up_to.end(), at) - area_up_to.begin();
    const auto& [a, b, c] = s.triangles[std::min(static_cast<std::size_t>(found), s.triangles.size() - 1)];
    const double r = std::sqrt(unit_random(generator)), u = unit_random(generator);
    points.push_back(
        plus(times(s.position[a], 1 - r), plus(times(s.position[b], r * (1 - u)), times(s.position[c], r * u))));
  }
  return points;
}

/// Relative to the diagonal of a bounding box.
struct Distance {
  double max = 0, rms = 0;
};

/// From n sampled points of one surface, for the maximum from its vertices in use too, to the nearest points of
/// the other, as a share of the latter's diagonal.
inline Distance distance_one_way(const Surface& from, const TriangleTree& tree, double diagonal, std::size_t n) {
  Distance d;
  const std::vector<Point3> points = sample_points(from, n);
  for (const Point3& p : points) {
    const double distance = tree.nearest(p).distance;
    d.max = std::max(d.max, distance);
    d.rms += distance * distance / static_cast<double>(points.size());
  }
  std::vector<bool> is_done(from.position.size());
  for (const auto& t : from.triangles)
    for (const std::uint32_t v : t) {
      if (!is_done[v]) d.max = std::max(d.max, tree.nearest(from.position[v]).distance);
      is_done[v] = true;
    }
  return {d.max / diagonal, std::sqrt(d.rms) / diagonal};
}

struct SurfaceDistance {
  Distance forth, back;  // from the surface to the reference, and from the reference to it

  double max() const { return std::max(forth.max, back.max); }
  double rms() const { return std::max(forth.rms, back.rms); }
};

/// Both ways, as a share of the diagonal of the reference's bounding box.
inline SurfaceDistance distance(const Surface& s, const Surface& reference, std::size_t n = 20000) {
  const auto [low, high] = bounding_box(reference);
  const double diagonal = norm(minus(high, low));
  return {distance_one_way(s, TriangleTree(reference), diagonal, n),
          distance_one_way(reference, TriangleTree(s), diagonal, n)};
}

// ---------------------------------------------------------------- normals

inline double angle_deg(const Point3& a, const Point3& b) {
  return std::atan2(norm(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi;
}

struct NormalTurn {
  double largest_deg = 0;
  std::size_t n_flipped = 0;  // triangles turned by more than 90 degrees
};

/// How far triangles are turned against the reference where it is nearest to their middle; of several places that
/// are as near (at its edges and vertices), or nearer than `reaches` times that, the one that is turned least.
/// Triangles without area are left out.
inline NormalTurn normal_turn(const Surface& s, const Surface& reference, double reaches = 1) {
  const TriangleTree tree(reference);
  const auto [low, high] = bounding_box(reference);
  const double epsilon = 1e-9 * norm(minus(high, low));
  NormalTurn turn;
  for (const auto& t : s.triangles) {
    const Point3 n = doubled_area_normal(s, t);
    if (norm(n) == 0) continue;
    const Point3 middle = times(plus(s.position[t[0]], plus(s.position[t[1]], s.position[t[2]])), 1.0 / 3);
    const double reach = reaches * tree.nearest(middle).distance + epsilon;
    double least = 180;
    tree.visit(
        [&](const Box& box) { return squared_distance(box, middle) <= reach * reach; },
        [&](std::uint32_t other) {
          const Point3 there = doubled_area_normal(reference, reference.triangles[other]);
          if (norm(there) > 0 && norm(minus(nearest_on_triangle(middle, tree.corners(other)), middle)) <= reach)
            least = std::min(least, angle_deg(n, there));
        });
    turn.largest_deg = std::max(turn.largest_deg, least);
    turn.n_flipped += least > 90 ? 1 : 0;
  }
  return turn;
}

/// Largest angle between the normals of two triangles at an edge with opposite directions, in degrees: 90 for a
/// cube, 180 where the surface is folded back on itself. Triangles without area are left out.
inline double largest_dihedral_deg(const Surface& s) {
  std::map<std::array<std::uint32_t, 2>, std::size_t> triangle_along;
  for (std::size_t t = 0; t < s.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) triangle_along[{s.triangles[t][k], s.triangles[t][(k + 1) % 3]}] = t;
  double largest = 0;
  for (const auto& [edge, t] : triangle_along) {
    const auto twin = triangle_along.find({edge[1], edge[0]});
    if (twin == triangle_along.end() || edge[0] > edge[1]) continue;
    const Point3 a = doubled_area_normal(s, s.triangles[t]), b = doubled_area_normal(s, s.triangles[twin->second]);
    if (norm(a) > 0 && norm(b) > 0) largest = std::max(largest, angle_deg(a, b));
  }
  return largest;
}

// ---------------------------------------------------------------- self-intersections

/// Six times the volume of abcd. Exact in sign but for the rounding of long double.
inline long double volume(const Point3& a, const Point3& b, const Point3& c, const Point3& d) {
  const auto from_d = [&](const Point3& p, std::size_t k) { return static_cast<long double>(p[k]) - d[k]; };
  const auto minor = [&](std::size_t i, std::size_t j) {
    return from_d(b, i) * from_d(c, j) - from_d(b, j) * from_d(c, i);
  };
  return from_d(a, 0) * minor(1, 2) - from_d(a, 1) * minor(0, 2) + from_d(a, 2) * minor(0, 1);
}

/// The segment goes through the inside of the triangle, from one side to the other.
inline bool pierces(const Point3& p, const Point3& q, const std::array<Point3, 3>& t) {
  const long double above = volume(t[0], t[1], t[2], p), below = volume(t[0], t[1], t[2], q);
  if (!((above > 0 && below < 0) || (above < 0 && below > 0))) return false;
  const long double a = volume(p, q, t[0], t[1]), b = volume(p, q, t[1], t[2]), c = volume(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

/// Pairs of triangles without a place of a corner in common, one with a side that goes through the other. What
/// only touches, or overlaps in one plane, does not count.
inline std::size_t count_self_intersections(const Surface& s) {
  const TriangleTree tree(s);
  std::size_t n = 0;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    const Box box = tree.box_of(t);
    const auto mine = tree.corners(t);
    tree.visit([&](const Box& other) { return overlap(box, other); },
               [&](std::uint32_t u) {
                 if (u <= t || !overlap(box, tree.box_of(u))) return;
                 const auto theirs = tree.corners(u);
                 for (const Point3& p : mine)
                   if (std::find(theirs.begin(), theirs.end(), p) != theirs.end()) return;
                 bool is_cut = false;
                 for (std::size_t k = 0; k < 3 && !is_cut; ++k)
                   is_cut =
                       pierces(mine[k], mine[(k + 1) % 3], theirs) || pierces(theirs[k], theirs[(k + 1) % 3], mine);
                 n += is_cut ? 1 : 0;
               });
  }
  return n;
}

}  // namespace tinsmith::test
