// Errors of triangles against a sweep over all samples with exact tests of its own.

#include "samples/triangle_error.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "support/random_grid.hpp"

namespace tinsmith {
namespace {

using namespace test;

bool is_in(const Corner& a, const Corner& b, const Corner& c, LatticePoint s) {
  return orient(a.position, b.position, s) >= 0 && orient(b.position, c.position, s) >= 0 &&
         orient(c.position, a.position, s) >= 0;
}

TEST(TriangleError, IsThatOfEverySampleInOrOnTheTriangle) {
  const HeightGrid grid = grid_of(24, 24, [](int x, int y) { return 30 * std::sin(0.4 * x) + 2.5 * y; });
  std::mt19937_64 random(411);
  const auto corner = [&] {
    const auto draw = [&] { return static_cast<std::int32_t>(random() % (23 * kLatticePerCell + 1)); };
    return Corner{{draw(), draw()}, static_cast<double>(random() % 100)};
  };
  int n_tested = 0;
  for (int i = 0; i < 5'000; ++i) {
    const Corner a = corner();
    Corner b = corner();
    Corner c = corner();
    if (orient(a.position, b.position, c.position) < 0) std::swap(b, c);
    if (orient(a.position, b.position, c.position) < 64) continue;
    ++n_tested;
    const Plane plane = plane_through(a, b, c);
    double largest = 0;
    double squares = 0;
    for (std::int32_t y = 0; y < 24; ++y) {
      for (std::int32_t x = 0; x < 24; ++x) {
        if (!is_in(a, b, c, {x * kLatticePerCell, y * kLatticePerCell})) continue;
        const double error = std::abs(plane.at(x, y) - grid.at(x, y));
        largest = std::max(largest, error);
        squares += error * error;
      }
    }
    const TriangleError found = triangle_error(grid, a, b, c);
    EXPECT_NEAR(found.largest, largest, 1e-8) << "seed 411, case " << i;
    EXPECT_NEAR(found.sum_of_squares, squares, 1e-8 * (1 + squares)) << "seed 411, case " << i;
    if (largest > 0) {
      EXPECT_TRUE(is_in(a, b, c, {found.worst.x * kLatticePerCell, found.worst.y * kLatticePerCell}));
      const double there = std::abs(plane.at(found.worst.x, found.worst.y) - grid.at(found.worst.x, found.worst.y));
      EXPECT_NEAR(there, largest, 1e-8) << "seed 411, case " << i;
    }
    const TriangleError portable = triangle_error_portable(grid, a, b, c);
    EXPECT_EQ(found.largest, portable.largest) << "seed 411, case " << i;
    EXPECT_EQ(found.worst, portable.worst) << "seed 411, case " << i;
    EXPECT_EQ(found.sum_of_squares, portable.sum_of_squares) << "seed 411, case " << i;
  }
  EXPECT_GT(n_tested, 4'000);
}

}  // namespace
}  // namespace tinsmith
