#include "simplify/star.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "geometry/triangle_rows.hpp"
#include "support/random_grid.hpp"

namespace tinsmith {
namespace {

using namespace test;

struct Case {
  LatticePoint p;
  Corner a, b;
  double reference = 0;
};

// Largest error of the samples in the triangle when p has the height z.
double error_at(const Case& c, const HeightGrid& grid, double z) {
  const Plane plane = plane_through({c.p, z}, c.a, c.b);
  double largest = 0;
  for (std::int32_t y = 0; y < grid.rect.height; ++y) {
    for (std::int32_t x = 0; x < grid.rect.width; ++x) {
      const LatticePoint s{x * kLatticePerCell, y * kLatticePerCell};
      const bool is_in = orient(c.p, c.a.position, s) >= 0 && orient(c.a.position, c.b.position, s) > 0 &&
                         orient(c.b.position, c.p, s) >= 0;  // the far side is not the new vertex's to mend
      if (is_in) largest = std::max(largest, std::abs(plane.at(x, y) - grid.at(x, y)));
    }
  }
  return largest;
}

Case draw(std::mt19937_64& random, const HeightGrid& grid) {
  const auto point = [&] {
    return LatticePoint{static_cast<std::int32_t>(random() % 300), static_cast<std::int32_t>(random() % 300)};
  };
  const auto corner = [&] {
    const LatticePoint p = point();
    return Corner{p, grid.at(p.x / kLatticePerCell, p.y / kLatticePerCell)};
  };
  Case c{point(), corner(), corner(), 0};
  if (orient(c.p, c.a.position, c.b.position) < 0) std::swap(c.a, c.b);
  c.reference = grid.at(c.p.x / kLatticePerCell, c.p.y / kLatticePerCell);
  return c;
}

// Inside the interval every height holds the tolerance, outside none does.
TEST(ErrorBound, ItsIntervalIsExactlyTheHeightsWithinTheTolerance) {
  const HeightGrid grid = grid_of(20, 20, [](int x, int y) { return 40 * std::sin(0.3 * x) + 3 * y; });
  constexpr double kTolerance = 25;
  std::mt19937_64 random(231);
  int n_feasible = 0;
  int n_refused = 0;
  for (int i = 0; i < 4'000; ++i) {
    const Case c = draw(random, grid);
    if (orient(c.p, c.a.position, c.b.position) < 500) continue;
    HeightInterval interval;
    if (narrow(interval, {grid, kTolerance, c.reference}, c.p, {c.a, c.b})) {
      if (interval.sum_ww == 0) continue;  // no sample inside
      ++n_feasible;
      EXPECT_FALSE(interval.is_empty());
      for (const double share : {0.001, 0.5, 0.999}) {
        const double dz = interval.lowest + share * (interval.highest - interval.lowest);
        EXPECT_LE(error_at(c, grid, c.reference + dz), kTolerance + 1e-6) << "seed 231, case " << i;
      }
      const double beyond = 1e-3 + 1e-3 * (interval.highest - interval.lowest);
      EXPECT_GT(error_at(c, grid, c.reference + interval.highest + beyond), kTolerance) << "seed 231, case " << i;
      EXPECT_GT(error_at(c, grid, c.reference + interval.lowest - beyond), kTolerance) << "seed 231, case " << i;
    } else {
      ++n_refused;
      for (double dz = -400; dz <= 400; dz += 5)
        EXPECT_GT(error_at(c, grid, c.reference + dz), kTolerance) << "seed 231, case " << i;
    }
  }
  EXPECT_GT(n_feasible, 500);
  EXPECT_GT(n_refused, 500);
}

// The quotient of the sums is where the squared error over the samples is least.
TEST(ErrorBound, ItsSumsGiveTheLeastSquaresHeight) {
  const HeightGrid grid = grid_of(20, 20, [](int x, int y) { return 5 * std::cos(0.4 * x) * std::sin(0.5 * y); });
  std::mt19937_64 random(232);
  int tested = 0;
  for (int i = 0; i < 500; ++i) {
    const Case c = draw(random, grid);
    if (orient(c.p, c.a.position, c.b.position) < 2000) continue;
    HeightInterval interval;
    ASSERT_TRUE(narrow(interval, {grid, 1e6, c.reference}, c.p, {c.a, c.b}));
    if (interval.sum_ww == 0) continue;
    ++tested;
    const auto squares = [&](double z) {
      const Plane plane = plane_through({c.p, z}, c.a, c.b);
      const TriangleRows rows(c.p, c.a.position, c.b.position);
      double sum = 0;
      for (std::int32_t y = rows.first_row; y <= rows.last_row; ++y) {
        for (auto [x, last] = rows.columns(y); x <= last; ++x) {
          const double off = plane.at(x, y) - grid.at(x, y);
          sum += off * off;
        }
      }
      return sum;
    };
    const double best = c.reference + interval.sum_wr / interval.sum_ww;
    EXPECT_LE(squares(best), squares(best + 0.05)) << "seed 232, case " << i;
    EXPECT_LE(squares(best), squares(best - 0.05)) << "seed 232, case " << i;
  }
  EXPECT_GT(tested, 200);
}

}  // namespace
}  // namespace tinsmith
