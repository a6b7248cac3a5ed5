#include "simplify/star.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

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

// The samples that the height of p bears on: those in the triangle, but for its far side.
std::vector<LatticePoint> samples_under(const Case& c, const HeightGrid& grid) {
  std::vector<LatticePoint> result;
  for (std::int32_t y = 0; y < grid.rect.height; ++y) {
    for (std::int32_t x = 0; x < grid.rect.width; ++x) {
      const LatticePoint s{x * kLatticePerCell, y * kLatticePerCell};
      if (orient(c.p, c.a.position, s) >= 0 && orient(c.a.position, c.b.position, s) > 0 &&
          orient(c.b.position, c.p, s) >= 0)
        result.push_back({x, y});
    }
  }
  return result;
}

// Largest error of the samples in the triangle when p has the height z.
double error_at(const Case& c, const HeightGrid& grid, double z) {
  const Plane plane = plane_through({c.p, z}, c.a, c.b);
  double largest = 0;
  for (const auto [x, y] : samples_under(c, grid))
    largest = std::max(largest, std::abs(plane.at(x, y) - grid.at(x, y)));
  return largest;
}

// A vertex keeps to the heights of the samples around it, give or take the tolerance.
bool is_spike(const Case& c, const HeightGrid& grid, double tolerance, double z) {
  double lowest = std::numeric_limits<double>::max();
  double highest = -lowest;
  for (const auto [x, y] : samples_under(c, grid)) {
    lowest = std::min(lowest, grid.at(x, y));
    highest = std::max(highest, grid.at(x, y));
  }
  return z < lowest - tolerance - 1e-9 || z > highest + tolerance + 1e-9;
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
    const HeightInterval interval = feasible_heights({{c.a, c.b}}, {grid, kTolerance, c.reference}, c.p);
    const auto is_feasible = [&](double dz) {
      return error_at(c, grid, c.reference + dz) <= kTolerance && !is_spike(c, grid, kTolerance, c.reference + dz);
    };
    if (!interval.is_empty()) {
      if (interval.sum_ww == 0) continue;  // no sample inside
      ++n_feasible;
      for (const double share : {0.001, 0.5, 0.999}) {
        const double dz = interval.lowest + share * (interval.highest - interval.lowest);
        EXPECT_LE(error_at(c, grid, c.reference + dz), kTolerance + 1e-6) << "seed 231, case " << i;
      }
      const double beyond = 1e-3 + 1e-3 * (interval.highest - interval.lowest);
      EXPECT_FALSE(is_feasible(interval.highest + beyond)) << "seed 231, case " << i;
      EXPECT_FALSE(is_feasible(interval.lowest - beyond)) << "seed 231, case " << i;
    } else {
      ++n_refused;
      for (double dz = -400; dz <= 400; dz += 5) EXPECT_FALSE(is_feasible(dz)) << "seed 231, case " << i;
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
    const HeightInterval interval = feasible_heights({{c.a, c.b}}, {grid, 1e6, c.reference}, c.p);
    ASSERT_FALSE(interval.is_empty());
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

// The output may not depend on the machine's instruction set.
TEST(ErrorBound, IsTheSameToTheBitWithEveryInstructionSet) {
  const HeightGrid grid = grid_of(20, 20, [](int x, int y) { return 40 * std::sin(0.3 * x) + 3.3 * y; });
  std::mt19937_64 random(233);
  for (int i = 0; i < 4'000; ++i) {
    const Case c = draw(random, grid);
    if (orient(c.p, c.a.position, c.b.position) <= 0) continue;
    const Bound bound{grid, 25, c.reference};
    const Star star{{c.a, c.b}};
    const HeightInterval here = feasible_heights(star, bound, c.p);
    const HeightInterval anywhere = feasible_heights_portable(star, bound, c.p);
    const auto numbers = [](const HeightInterval& h) {
      return std::array{h.lowest, h.highest, h.sum_wr, h.sum_ww};
    };
    EXPECT_EQ(numbers(here), numbers(anywhere)) << "seed 233, case " << i;
    EXPECT_EQ(here.lowest_at, anywhere.lowest_at) << "seed 233, case " << i;
    EXPECT_EQ(here.highest_at, anywhere.highest_at) << "seed 233, case " << i;
    const HeightFit fit = fit_height(star, bound, c.p, 1e6);
    const HeightFit portable = fit_height_portable(star, bound, c.p, 1e6);
    EXPECT_EQ(std::pair(fit.height, fit.squared_error), std::pair(portable.height, portable.squared_error))
        << "seed 233, case " << i;
    PlanSystem system;
    PlanSystem portable_system;
    const HeightFit free = fit_height(star, bound, c.p, system);
    const HeightFit portable_free = fit_height_portable(star, bound, c.p, portable_system);
    EXPECT_EQ(std::pair(free.height, free.squared_error),
              std::pair(portable_free.height, portable_free.squared_error))
        << "seed 233, case " << i;
    const auto equations = [](const PlanSystem& p) { return std::array{p.xx, p.xy, p.yy, p.rx, p.ry}; };
    EXPECT_EQ(equations(system), equations(portable_system)) << "seed 233, case " << i;
  }
}

// With a limit a star is refused exactly when its best height has a larger squared error.
TEST(ErrorBound, RefusesFitsThatExceedTheSquaredLimit) {
  const HeightGrid grid = grid_of(20, 20, [](int x, int y) { return 40 * std::sin(0.3 * x) + 3 * y; });
  std::mt19937_64 random(234);
  int n_refused = 0;
  int n_kept = 0;
  for (int i = 0; i < 4'000; ++i) {
    const Case c = draw(random, grid);
    if (orient(c.p, c.a.position, c.b.position) < 500) continue;
    const Bound bound{grid, 1e6, c.reference};
    const HeightFit all = fit_height({{c.a, c.b}}, bound, c.p, 1e9);
    constexpr double kLimit = 50;
    if (std::abs(all.squared_error - kLimit) < 1e-6) continue;
    const HeightFit limited = fit_height({{c.a, c.b}}, bound, c.p, kLimit);
    EXPECT_EQ(limited.is_feasible, all.squared_error < kLimit) << "seed 234, case " << i;
    ++(limited.is_feasible ? n_kept : n_refused);
  }
  EXPECT_GT(n_refused, 200);
  EXPECT_GT(n_kept, 200);
}

}  // namespace
}  // namespace tinsmith
