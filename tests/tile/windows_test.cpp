#include "tile/windows.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace tinsmith {
namespace {

struct FieldSize {
  std::int32_t width;
  std::int32_t height;
};

constexpr std::array kSizes{FieldSize{2, 2},   FieldSize{2, 100},   FieldSize{100, 2}, FieldSize{33, 17},
                            FieldSize{65, 65}, FieldSize{64, 66},   FieldSize{1, 1},   FieldSize{1, 40},
                            FieldSize{129, 5}, FieldSize{100, 257}, FieldSize{7, 7}};

// The window that holds the middle of a cell.
std::int64_t window_of_cell(const WindowGrid& windows, std::int32_t x, std::int32_t y) {
  const LatticePoint p{x * kLatticePerCell + kLatticePerCell / 2, y * kLatticePerCell + kLatticePerCell / 2};
  return windows.window_of(p, p, p);
}

TEST(WindowGrid, GivesEveryCellToExactlyOneWindowWhoseSamplesHoldIt) {
  std::int64_t n_windows = 0;
  for (const auto [width, height] : kSizes) {
    for (const std::int32_t side : {4, 5, 16, 64, 300}) {
      for (int round = 0; round < kRounds; ++round) {
        SCOPED_TRACE(testing::Message() << width << " x " << height << ", side " << side << ", round " << round);
        const WindowGrid windows = window_grid(width, height, side, round);
        std::vector<int> times(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0);
        for (std::int64_t w = 0; w < windows.count(); ++w, ++n_windows) {
          const GridRect rect = windows.samples(w, width, height);
          for (std::int32_t y = rect.y0; y < rect.y0 + rect.height - 1; ++y) {
            for (std::int32_t x = rect.x0; x < rect.x0 + rect.width - 1; ++x) {
              ++times[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)];
              ASSERT_EQ(window_of_cell(windows, x, y), w);
            }
          }
        }
        for (std::int32_t y = 0; y + 1 < height; ++y) {
          for (std::int32_t x = 0; x + 1 < width; ++x)
            ASSERT_EQ(
                times[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)],
                1);
        }
      }
    }
  }
  EXPECT_GT(n_windows, 5'000);
}

TEST(WindowGrid, StaysWithinTheField) {
  for (const auto [width, height] : kSizes) {
    for (int round = 0; round < kRounds; ++round) {
      const WindowGrid windows = window_grid(width, height, 16, round);
      ASSERT_GE(windows.count(), 1);
      for (std::int64_t w = 0; w < windows.count(); ++w) {
        const GridRect r = windows.samples(w, width, height);
        EXPECT_GE(r.x0, 0);
        EXPECT_GE(r.y0, 0);
        EXPECT_LE(r.x0 + r.width, width);
        EXPECT_LE(r.y0 + r.height, height);
        EXPECT_LE(r.width, 17);
        EXPECT_LE(r.height, 17);
        // A window of one sample's breadth has no cell; only a field without cells has one.
        EXPECT_TRUE(width == 1 || height == 1 || (r.width > 1 && r.height > 1));
      }
    }
  }
}

// Round 0's seams lie in the middle of round 1's windows, and the places where both rounds' seams cross lie
// inside a window of round 2 or 3.
TEST(WindowGrid, ShiftsSoThatEverySeamLiesInsideSomeLaterWindow) {
  constexpr std::int32_t kSide = 16;
  const auto is_on_seam = [](int round, std::int32_t x, std::int32_t y) {
    const WindowGrid windows = window_grid(200, 200, kSide, round);
    return (x + windows.shift_x) % kSide == 0 || (y + windows.shift_y) % kSide == 0;
  };
  int n_on_two = 0;
  for (std::int32_t y = 0; y < 200; ++y) {
    for (std::int32_t x = 0; x < 200; ++x) {
      if (!is_on_seam(0, x, y) || !is_on_seam(1, x, y)) continue;
      ++n_on_two;
      EXPECT_FALSE(is_on_seam(2, x, y) && is_on_seam(3, x, y)) << x << ", " << y;
    }
  }
  EXPECT_GT(n_on_two, 100);
}

TEST(WindowGrid, PutsATriangleOutsideTheFieldIntoTheNearestWindow) {
  const WindowGrid windows = window_grid(33, 33, 16, 0);
  const LatticePoint before{-20, -20};
  const LatticePoint beyond{33 * kLatticePerCell, 33 * kLatticePerCell};
  EXPECT_EQ(windows.window_of(before, before, before), 0);
  EXPECT_EQ(windows.window_of(beyond, beyond, beyond), windows.count() - 1);
}

}  // namespace
}  // namespace tinsmith
