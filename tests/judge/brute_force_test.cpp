// The judge against the same measurements made the slow and obvious way, in whole numbers.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "geometry/lattice.hpp"
#include "judge/scene.hpp"

namespace tinsmith {
namespace {

using Corners = std::array<std::uint32_t, 3>;

LatticePoint place(const Scene& scene, std::uint32_t v) {
  return {static_cast<std::int32_t>(std::lround(16 * scene.vertices[v][0])),
          static_cast<std::int32_t>(std::lround(16 * scene.vertices[v][1]))};
}

/// A full mesh over random heights and voids, shaken on the lattice, with triangles lost, doubled, turned over,
/// and vertices led astray.
Scene damaged(std::mt19937_64& random) {
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const int width = 6 + below(6);
  const int height = 6 + below(6);
  Scene scene = full_plane(width, height);
  for (double& z : scene.z) z = below(5) == 0 ? kVoid : below(1000) / 8.0;
  if (below(2) == 0)
    for (double& z : scene.z)
      if (std::isnan(z)) z = 7;
  mesh_fully(scene);
  for (auto& v : scene.vertices)
    if (below(3) == 0) v = {v[0] + (below(17) - 8) / 16.0, v[1] + (below(17) - 8) / 16.0, v[2] + below(9)};
  for (int n = below(4); n > 0 && scene.triangles.size() > 3; --n) {
    const auto t = static_cast<std::size_t>(below(static_cast<int>(scene.triangles.size())));
    const Corners triangle = scene.triangles[t];
    switch (below(4)) {
      case 0:
        scene.triangles.erase(scene.triangles.begin() + static_cast<std::ptrdiff_t>(t));
        break;
      case 1:
        scene.triangles.push_back(triangle);
        break;
      case 2:
        std::swap(scene.triangles[t][0], scene.triangles[t][1]);
        break;
      default:
        scene.triangles[t][2] = static_cast<std::uint32_t>(random() % scene.vertices.size());
    }
  }
  return scene;
}

bool is_coverable(Scene& scene, int x, int y) {
  for (int j = y - 1; j <= y; ++j)
    for (int i = x - 1; i <= x; ++i)
      if (i >= 0 && j >= 0 && i + 1 < scene.width && j + 1 < scene.height &&
          !std::isnan(scene.at(i, j) + scene.at(i + 1, j) + scene.at(i, j + 1) + scene.at(i + 1, j + 1)))
        return true;
  return false;
}

Certificate slow_coverage(Scene& scene) {
  Certificate c;
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const LatticePoint p{16 * x, 16 * y};
      int n_in = 0, n_inside = 0;
      double largest = 0;
      for (const Corners& t : scene.triangles) {
        const auto [a, b, d] = t;
        const std::int64_t area = orient(place(scene, a), place(scene, b), place(scene, d));
        if (area == 0) continue;
        const std::int64_t sign = area > 0 ? 1 : -1;
        const std::int64_t wa = sign * orient(p, place(scene, b), place(scene, d));
        const std::int64_t wb = sign * orient(place(scene, a), p, place(scene, d));
        const std::int64_t wd = sign * orient(place(scene, a), place(scene, b), p);
        if (wa < 0 || wb < 0 || wd < 0) continue;
        ++n_in;
        if (wa > 0 && wb > 0 && wd > 0) ++n_inside;
        const double z = (wa * scene.vertices[a][2] + wb * scene.vertices[b][2] + wd * scene.vertices[d][2]) /
                         static_cast<double>(sign * area);
        largest = std::max(largest, std::abs(z - scene.at(x, y)));
      }
      if (std::isnan(scene.at(x, y))) {
        c.voids_covered += n_inside > 0;
        continue;
      }
      ++c.samples;
      c.overlapped += n_inside > 1;
      if (is_coverable(scene, x, y)) ++(n_in > 0 ? c.covered : c.uncovered);
      if (n_in > 0) c.max_error = std::max(c.max_error, largest);
    }
  return c;
}

/// Groups what is connected, by repeated sweeps.
template <class AreConnected>
std::size_t count_groups(std::size_t n, AreConnected are_connected) {
  std::vector<std::size_t> group(n);
  for (std::size_t i = 0; i < n; ++i) group[i] = i;
  for (bool changed = true; changed;) {
    changed = false;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (group[i] != group[j] && are_connected(i, j)) {
          group[i] = group[j] = std::min(group[i], group[j]);
          changed = true;
        }
  }
  return std::set<std::size_t>(group.begin(), group.end()).size();
}

using Edge = std::pair<std::uint32_t, std::uint32_t>;

std::set<Edge> edges_of(const Corners& t) {
  std::set<Edge> edges;
  for (std::size_t k = 0; k < 3; ++k)
    if (t[k] != t[(k + 1) % 3]) edges.insert(std::minmax(t[k], t[(k + 1) % 3]));
  return edges;
}

bool share_edge(const Corners& s, const Corners& t, std::int64_t vertex) {
  for (const Edge& e : edges_of(s))
    if (edges_of(t).count(e) && (vertex < 0 || e.first == vertex || e.second == vertex)) return true;
  return false;
}

void slow_topology(const Scene& scene, Certificate& c) {
  std::map<Edge, std::vector<std::pair<bool, std::size_t>>> uses;
  for (std::size_t t = 0; t < scene.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t u = scene.triangles[t][k], v = scene.triangles[t][(k + 1) % 3];
      if (u != v) uses[std::minmax(u, v)].push_back({u < v, t});
    }
  for (const auto& [edge, by] : uses)
    if (by.size() > 2 || (by.size() == 2 && by[0].first == by[1].first)) ++c.non_manifold_edges;
  c.components = count_groups(scene.triangles.size(), [&](std::size_t i, std::size_t j) {
    return share_edge(scene.triangles[i], scene.triangles[j], -1);
  });
  std::set<std::uint32_t> on_border;
  for (const auto& [edge, by] : uses)
    if (by.size() == 1) on_border.insert({edge.first, edge.second});
  for (std::uint32_t v = 0; v < scene.vertices.size(); ++v) {
    std::vector<Corners> star;
    for (const Corners& t : scene.triangles)
      if (std::count(t.begin(), t.end(), v)) star.push_back(t);
    if (count_groups(star.size(), [&](std::size_t i, std::size_t j) { return share_edge(star[i], star[j], v); }) >
        1)
      ++c.non_manifold_vertices;
    bool is_junction = false;
    for (const auto& [edge, by] : uses) {
      const Corners& own = scene.triangles[by[0].second];
      if (by.size() != 1 || !on_border.count(v) || std::count(own.begin(), own.end(), v)) continue;
      const LatticePoint p = place(scene, v), a = place(scene, edge.first), b = place(scene, edge.second);
      const std::int64_t dot = (std::int64_t{a.x} - p.x) * (b.x - p.x) + (std::int64_t{a.y} - p.y) * (b.y - p.y);
      if (orient(a, b, p) == 0 && dot < 0) is_junction = true;
    }
    c.t_junctions += is_junction;
  }
}

TEST(Judge, AgreesWithBruteForce) {
  std::mt19937_64 random(77);
  int n_holes = 0, n_overlaps = 0, n_junctions = 0, n_pinches = 0, n_bad_edges = 0, n_sound = 0;
  for (int trial = 0; trial < 800; ++trial) {
    Scene scene = damaged(random);
    Certificate slow = slow_coverage(scene);
    slow_topology(scene, slow);
    const Certificate c = scene.judged();
    SCOPED_TRACE(trial);
    ASSERT_EQ(c.samples, slow.samples);
    ASSERT_EQ(c.covered, slow.covered);
    ASSERT_EQ(c.uncovered, slow.uncovered);
    ASSERT_EQ(c.overlapped, slow.overlapped);
    ASSERT_EQ(c.voids_covered, slow.voids_covered);
    ASSERT_NEAR(c.max_error, slow.max_error, 1e-9);
    ASSERT_EQ(c.non_manifold_edges, slow.non_manifold_edges);
    ASSERT_EQ(c.non_manifold_vertices, slow.non_manifold_vertices);
    ASSERT_EQ(c.components, slow.components);
    ASSERT_EQ(c.t_junctions, slow.t_junctions);
    n_holes += c.uncovered > 0;
    n_overlaps += c.overlapped > 0;
    n_junctions += c.t_junctions > 0;
    n_pinches += c.non_manifold_vertices > 0;
    n_bad_edges += c.non_manifold_edges > 0;
    n_sound += c.non_manifold_edges + c.folded + c.non_manifold_vertices + c.t_junctions == 0;
  }
  for (const int n : {n_holes, n_overlaps, n_junctions, n_pinches, n_bad_edges, n_sound}) EXPECT_GE(n, 30);
}

TEST(Judge, FindsTheSameInBandsOfAnyHeight) {
  std::mt19937_64 random(78);
  for (int trial = 0; trial < 50; ++trial) {
    const Scene scene = damaged(random);
    const Certificate whole = scene.judged();
    for (const int rows : {1, 2, 3, 5}) {
      const Certificate c = scene.judged({512, rows});
      ASSERT_EQ(c.covered, whole.covered);
      ASSERT_EQ(c.uncovered, whole.uncovered);
      ASSERT_EQ(c.overlapped, whole.overlapped);
      ASSERT_EQ(c.max_error, whole.max_error);
      ASSERT_EQ(c.max_error_row, whole.max_error_row);
      ASSERT_EQ(c.rmse, whole.rmse);
      ASSERT_EQ(c.mean_error, whole.mean_error);
      ASSERT_EQ(c.p99_error, whole.p99_error);
      ASSERT_EQ(c.cells_valid, whole.cells_valid);
    }
  }
}

}  // namespace
}  // namespace tinsmith
