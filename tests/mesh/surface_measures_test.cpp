// The measures that judge surfaces, on shapes of which the answers are known, and against brute force.

#include "support/surface_measures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "support/surface_shapes.hpp"

namespace tinsmith::test {
namespace {

Surface moved(Surface s, const Point3& by) {
  for (Point3& p : s.position) p = plus(p, by);
  return s;
}

Surface scaled(Surface s, double factor) {
  for (Point3& p : s.position) p = times(p, factor);
  return s;
}

Surface together(Surface a, const Surface& b) {
  const auto n = static_cast<std::uint32_t>(a.position.size());
  a.position.insert(a.position.end(), b.position.begin(), b.position.end());
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({i + n, j + n, k + n});
  return a;
}

double enclosed_volume(const Surface& s) {
  double sum = 0;
  for (const auto& [a, b, c] : s.triangles) sum += dot(s.position[a], cross(s.position[b], s.position[c])) / 6;
  return sum;
}

TEST(SurfaceMeasures, TopologyOfKnownShapes) {
  struct Known {
    Surface surface;
    std::int64_t euler, genus;
    std::size_t n_borders;
  };
  for (const auto& [s, euler, handles, n_borders] :
       {Known{sphere(6), 2, 0, 0}, Known{torus(14, 9), 0, 1, 0}, Known{cube_with_creases(4), 2, 0, 0},
        Known{scan(6), 2, 0, 0}, Known{open_sheet(6), 1, 0, 1},
        Known{together(torus(5, 4), moved(torus(6, 3), {5, 0, 0})), 0, 2, 0},
        Known{together(sphere(2), moved(open_sheet(3), {5, 0, 0})), 3, 0, 1}}) {
    EXPECT_EQ(euler_characteristic(s), euler);
    EXPECT_EQ(genus(s), handles);
    EXPECT_EQ(count_borders(s), n_borders);
    EXPECT_TRUE(is_manifold(s));
    EXPECT_EQ(is_closed_manifold(s), n_borders == 0);
    EXPECT_EQ(count_self_intersections(s), 0U);
  }
  EXPECT_EQ(count_borders(moebius(9)), 1U);
  EXPECT_EQ(euler_characteristic(moebius(9)), 0);
  EXPECT_FALSE(is_manifold(moebius(9)));
}

TEST(SurfaceMeasures, HolesAndPinchesAreSeen) {
  Surface s = sphere(5);
  s.triangles.erase(s.triangles.begin() + 70);
  s.triangles.erase(s.triangles.begin());
  EXPECT_EQ(count_borders(s), 2U);
  EXPECT_EQ(genus(s), 0);
  EXPECT_EQ(count_pinched_vertices(s), 0U);
  const Surface tie{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}, {}};
  EXPECT_EQ(count_pinched_vertices(tie), 1U);
  EXPECT_FALSE(is_manifold(tie));
}

TEST(SurfaceMeasures, WeldingMakesSeamsWhole) {
  const Surface s = sphere(4);
  Surface soup;
  for (const auto& t : s.triangles) {
    const auto n = static_cast<std::uint32_t>(soup.position.size());
    for (const std::uint32_t v : t) soup.position.push_back(s.position[v]);
    soup.triangles.push_back({n, n + 1, n + 2});
  }
  EXPECT_EQ(count_components(soup), s.triangles.size());
  EXPECT_TRUE(is_closed_manifold(welded(soup)));
}

TEST(SurfaceMeasures, ClosedShapesAreWoundOutwards) {
  EXPECT_NEAR(enclosed_volume(sphere(30)), 4 * std::numbers::pi / 3, 0.01);
  EXPECT_NEAR(enclosed_volume(cube_with_creases(3)), 8, 1e-12);
  EXPECT_NEAR(enclosed_volume(torus(90, 60)), 2 * std::numbers::pi * std::numbers::pi * 0.16, 0.02);
  EXPECT_GT(enclosed_volume(scan(20)), 3);
}

TEST(SurfaceMeasures, DistanceIsTheKnownOne) {
  const double diagonal = std::sqrt(12.0);
  for (const Surface& s : {sphere(12), torus(20, 9), open_sheet(12), scan(12)}) {
    EXPECT_LT(distance(s, s, 3000).max(), 1e-15);
    EXPECT_EQ(normal_turn(s, s).n_flipped, 0U);
  }
  const Surface cube = cube_with_creases(5);
  EXPECT_NEAR(distance(moved(cube, {0.3, 0, 0}), cube, 3000).max(), 0.3 / diagonal, 1e-12);
  const SurfaceDistance grown = distance(scaled(sphere(40), 1.1), sphere(40), 3000);
  EXPECT_NEAR(grown.max(), 0.1 / diagonal, 1e-4);
  EXPECT_NEAR(grown.rms(), 0.1 / diagonal, 1e-4);
  // A part lies on the whole, but not the other way round.
  Surface half = cube;
  half.triangles.resize(half.triangles.size() / 2);
  EXPECT_LT(distance(half, cube, 3000).forth.max, 1e-15);
  EXPECT_GT(distance(half, cube, 3000).back.max, 0.2);
}

TEST(SurfaceMeasures, NearestPointIsThatOfBruteForce) {
  const Surface s = scan(7);
  const TriangleTree tree(s);
  std::mt19937_64 generator(7);
  for (int i = 0; i < 300; ++i) {
    const Point3 p{3 * unit_random(generator) - 1.5, 3 * unit_random(generator) - 1.5,
                   3 * unit_random(generator) - 1.5};
    double least = 1e9;
    for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
      const auto corners = tree.corners(t);
      // Weights on a fine lattice are never nearer than the nearest, and near to it.
      for (int a = 0; a <= 8; ++a)
        for (int b = 0; a + b <= 8; ++b) {
          const Point3 q = plus(times(corners[0], a / 8.0),
                                plus(times(corners[1], b / 8.0), times(corners[2], (8 - a - b) / 8.0)));
          least = std::min(least, norm(minus(p, q)));
        }
    }
    EXPECT_LE(tree.nearest(p).distance, least + 1e-12);
    EXPECT_GE(tree.nearest(p).distance, least - 0.03);
  }
}

TEST(SurfaceMeasures, TurnedTrianglesAreCounted) {
  Surface s = scan(10);
  for (const std::size_t t : {3, 500, 901}) std::swap(s.triangles[t][1], s.triangles[t][2]);
  EXPECT_EQ(normal_turn(s, scan(10)).n_flipped, 3U);
  EXPECT_NEAR(normal_turn(s, scan(10)).largest_deg, 180, 1e-6);
  EXPECT_NEAR(largest_dihedral_deg(cube_with_creases(3)), 90, 1e-9);
  EXPECT_LT(largest_dihedral_deg(sphere(20)), 10);
}

TEST(SurfaceMeasures, SelfIntersectionsAreThoseOfBruteForce) {
  const Surface s = together(cube_with_creases(3), scaled(moved(scan(4), {0.31, 0.17, 0.11}), 1.3));
  const TriangleTree tree(s);
  std::size_t n = 0;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t)
    for (std::uint32_t u = 0; u < t; ++u) {
      const auto a = tree.corners(t), b = tree.corners(u);
      bool is_cut = false;
      for (std::size_t k = 0; k < 3; ++k)
        is_cut = is_cut || pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a);
      n += is_cut ? 1 : 0;
    }
  EXPECT_GT(n, 50U);
  EXPECT_EQ(count_self_intersections(s), n);
}

}  // namespace
}  // namespace tinsmith::test
