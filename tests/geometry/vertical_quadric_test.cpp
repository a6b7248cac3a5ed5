#include "geometry/vertical_quadric.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace tinsmith {
namespace {

// A plane through a vertex, with the weight of its area.
struct WeightedPlane {
  double x0, y0, z0, dx, dy, area;
  double weighted_error(double x, double y, double z) const {
    const double off = z - (z0 + dx * (x - x0) + dy * (y - y0));
    return area * off * off;
  }
};

// An edge from the origin to (x, y, z) whose ends have a fan of random planes each.
struct Edge {
  double x, y, z;
  std::vector<WeightedPlane> planes;
  VerticalSum sum0, sum1;

  explicit Edge(std::mt19937_64& random) {
    std::uniform_real_distribution<double> within(-10, 10);
    x = within(random);
    y = within(random);
    z = 5 * within(random);
    add_fan(random, 0, 0, 0, sum0);
    add_fan(random, x, y, z, sum1);
  }

  void add_fan(std::mt19937_64& random, double x0, double y0, double z0, VerticalSum& sum) {
    std::uniform_real_distribution<double> slope(-3, 3);
    for (std::uint64_t i = 0, n = 3 + random() % 5; i < n; ++i) {
      const WeightedPlane plane{x0, y0, z0, slope(random), slope(random), 0.1 + std::abs(slope(random))};
      planes.push_back(plane);
      sum.add(plane.dx, plane.dy, plane.area);
    }
  }

  PlanError error() const { return {sum0.quadric(), sum1.quadric(), x, y, z}; }

  double direct_sum(double px, double py, double pz) const {
    double sum = 0;
    for (const WeightedPlane& plane : planes) sum += plane.weighted_error(px, py, pz);
    return sum;
  }
};

TEST(PlanError, EqualsTheDirectSumOfSquares) {
  std::mt19937_64 random(21);
  std::uniform_real_distribution<double> within(-20, 20);
  for (int i = 0; i < 5'000; ++i) {
    const Edge edge(random);
    const PlanError error = edge.error();
    const double px = within(random);
    const double py = within(random);
    const double pz = 10 * within(random);
    const double direct = edge.direct_sum(px, py, pz);
    EXPECT_NEAR(error.at(px, py, pz), direct, 1e-9 * (1 + direct)) << "seed 21, edge " << i;
    const double at_best = edge.direct_sum(px, py, error.height(px, py));
    EXPECT_NEAR(error.at(px, py), at_best, 1e-9 * (1 + direct)) << "seed 21, edge " << i;
  }
}

// Of an edge to (4, 8) whose ends' triangles all lie in one plane.
PlanError on_one_plane(double slope_x, double slope_y) {
  VerticalSum sum0;
  VerticalSum sum1;
  for (const double area : {1.0, 2.0, 0.5}) {
    sum0.add(slope_x, slope_y, area);
    sum1.add(slope_x, slope_y, 2 * area);
  }
  return {sum0.quadric(), sum1.quadric(), 4, 8, slope_x * 4 + slope_y * 8};
}

TEST(PlanError, IsNearlyZeroOnASteepPlane) { EXPECT_NEAR(on_one_plane(1234.5, -987.25).at(2, 3), 0, 1e-9); }

TEST(PlanError, ItsHeightIsTheLeastOfAllHeights) {
  std::mt19937_64 random(22);
  std::uniform_real_distribution<double> within(-20, 20);
  for (int i = 0; i < 2'000; ++i) {
    const Edge edge(random);
    const PlanError error = edge.error();
    const double px = within(random);
    const double py = within(random);
    const double best = error.height(px, py);
    for (const double off : {-100.0, -1.0, -0.01, 0.01, 1.0, 100.0})
      EXPECT_LT(edge.direct_sum(px, py, best), edge.direct_sum(px, py, best + off)) << "seed 22, edge " << i;
  }
}

TEST(PlanError, IsZeroOnOnePlane) {
  const PlanError error = on_one_plane(0.75, -0.25);
  EXPECT_EQ(error.at(2, 3), 0);
  EXPECT_DOUBLE_EQ(error.height(2, 3), 0.75 * 2 - 0.25 * 3);
  EXPECT_GT(error.at(2, 3, 5), 0);
}

TEST(VerticalQuadric, OfItsOwnVertexIsZero) {
  std::mt19937_64 random(23);
  for (int i = 0; i < 100; ++i) {
    const Edge edge(random);
    const PlanError alone(edge.sum0.quadric(), VerticalQuadric{}, edge.x, edge.y, edge.z);
    EXPECT_NEAR(alone.at(0, 0, 0), 0, 1e-12);
  }
}

}  // namespace
}  // namespace tinsmith
