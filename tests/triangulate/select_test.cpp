#include "triangulate/select.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/random_grid.hpp"

namespace tinsmith {
namespace {

using namespace test;

Selection nothing_selected(const GridRect& window) {
  return {window, std::vector<std::uint8_t>(static_cast<std::size_t>(window.area()), 0)};
}

std::ptrdiff_t n_selected(const Selection& selection) {
  return std::count(selection.is_selected.begin(), selection.is_selected.end(), 1);
}

TEST(SelectSamples, TakesNothingOfAPlane) {
  const HeightGrid grid = grid_of(65, 65, [](int x, int y) { return 3.0 * x - 2.0 * y; });
  Selection selection = nothing_selected(grid.rect);
  select_samples(grid, 0, selection);
  EXPECT_EQ(n_selected(selection), 0);
}

TEST(SelectSamples, TakesValidSamplesOnly) {
  for (const Mask mask : kMasks) {
    const HeightGrid grid = mountains(50, 43, 171, mask);
    Selection selection = nothing_selected(grid.rect);
    select_samples(grid, 5, selection);
    EXPECT_GT(n_selected(selection), 0);
    for (std::int32_t y = 0; y < 43; ++y) {
      for (std::int32_t x = 0; x < 50; ++x) {
        EXPECT_TRUE(!selection.at(x, y) || grid.is_valid(x, y)) << name_of(mask) << " " << x << ", " << y;
      }
    }
  }
}

TEST(SelectSamples, TakesMoreForFinerTolerances) {
  const HeightGrid grid = mountains(129, 129, 172);
  std::ptrdiff_t coarser = 0;
  for (const double tolerance : {500.0, 50.0, 5.0, 0.0}) {
    Selection selection = nothing_selected(grid.rect);
    select_samples(grid, tolerance, selection);
    EXPECT_GT(n_selected(selection), coarser) << tolerance;
    coarser = n_selected(selection);
  }
}

TEST(SelectSamples, TellsOfTheTrianglesItEndsWith) {
  const auto leaves = [](const HeightGrid& grid) {
    Selection selection = nothing_selected(grid.rect);
    return select_samples(grid, 0.4, selection);
  };
  const Leaves of_a_plane = leaves(grid_of(65, 65, [](int x, int y) { return 3.0 * x - 2.0 * y; }));
  EXPECT_EQ(of_a_plane.n, 2);
  EXPECT_EQ(of_a_plane.sum_of_log2_areas, 2 * 11);
  // One sample too high, in the middle of the diagonal: four triangles. Nobody looks beside the square.
  const Leaves of_a_spike = leaves(grid_of(70, 65, [](int x, int y) { return x == 32 && y == 32 ? 1.0 : 0.0; }));
  EXPECT_GT(of_a_spike.n, 4);
  const Leaves of_a_board = leaves(grid_of(65, 65, [](int x, int y) { return (x + y) % 2; }));
  EXPECT_EQ(of_a_board.n, 2 * 64 * 64);
  EXPECT_EQ(of_a_board.sum_of_log2_areas, -2 * 64 * 64);
  EXPECT_EQ(leaves(grid_of(65, 65, [](int, int) { return kVoid; })).n, 0);
}

// A polyline through the marked samples passes all others within the tolerance, seen from either end the same.
TEST(SelectOnLine, LeavesNoSampleOutsideTheTolerance) {
  std::mt19937_64 random(173);
  int n_left_out = 0;
  for (int i = 0; i < 300; ++i) {
    const auto n = static_cast<std::int32_t>(2 + random() % 60);
    const bool is_row = random() % 2 == 0;
    double z = 0;
    const HeightGrid grid = grid_of(is_row ? n : 1, is_row ? 1 : n,
                                    [&](int, int) { return z += static_cast<double>(random() % 21) - 10; });
    const double tolerance = static_cast<double>(random() % 30);
    Selection selection = nothing_selected(grid.rect);
    select_on_line(grid, tolerance, {0, 0}, is_row ? LatticePoint{n - 1, 0} : LatticePoint{0, n - 1}, selection);
    const auto& marks = selection.is_selected;
    ASSERT_TRUE(marks.front() && marks.back());
    for (std::size_t a = 0, b = 1; b < marks.size(); ++b) {
      if (!marks[b]) continue;
      for (std::size_t k = a + 1; k < b; ++k, ++n_left_out) {
        const double chord =
            grid.z[a] + (grid.z[b] - grid.z[a]) * static_cast<double>(k - a) / static_cast<double>(b - a);
        EXPECT_LE(std::abs(grid.z[k] - chord), tolerance + 1e-9) << "seed 173, line " << i;
      }
      a = b;
    }
  }
  EXPECT_GT(n_left_out, 3'000);
}

}  // namespace
}  // namespace tinsmith
