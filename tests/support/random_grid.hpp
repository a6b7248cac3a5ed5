#pragma once
// Terrain and voids from a seed, for random tests; and the turns and mirrors of a grid.

#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string_view>
#include <vector>

#include "samples/height_grid.hpp"
#include "terrain.hpp"

namespace tinsmith::test {

inline constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

/// Which samples are void.
enum class Mask {
  kNone,
  kSparse,     // one sample in 50
  kDense,      // one sample in 3: scraps, islands and pinches
  kChecker,    // squares of 4 x 4 cells as on a board: pinched at every corner
  kRing,       // a round moat with an island inside
  kDiagonals,  // diagonals of single samples, with pinches between
  kOnSeams,    // lines along the rows and columns that are multiples of 8: voids exactly on borders of windows
  kHalf,       // all but the left half: the outline runs along one column
};
inline constexpr std::array kMasks{Mask::kNone, Mask::kSparse,    Mask::kDense,   Mask::kChecker,
                                   Mask::kRing, Mask::kDiagonals, Mask::kOnSeams, Mask::kHalf};

constexpr std::string_view name_of(Mask mask) {
  constexpr std::array<std::string_view, 8> kNames{"none", "sparse",    "dense",    "checker",
                                                   "ring", "diagonals", "on seams", "half"};
  return kNames[static_cast<std::size_t>(mask)];
}

inline void cut(HeightGrid& grid, Mask mask, std::uint64_t seed) {
  const std::int32_t w = grid.rect.width;
  const std::int32_t h = grid.rect.height;
  const auto is_void = [&](std::int32_t x, std::int32_t y) {
    const std::int64_t dx = 2 * x - w;
    const std::int64_t dy = 2 * y - h;
    const std::int64_t side = std::min(w, h);
    std::mt19937_64 random(seed * 1'000'003 + static_cast<std::uint64_t>(y) * 100'019 +
                           static_cast<std::uint64_t>(x));
    switch (mask) {
      case Mask::kNone:
        return false;
      case Mask::kSparse:
        return random() % 50 == 0;
      case Mask::kDense:
        return random() % 3 == 0;
      case Mask::kChecker:
        return x % 4 != 0 && y % 4 != 0 && (x / 4 + y / 4) % 2 == 1;
      case Mask::kRing:
        return 4 * (dx * dx + dy * dy) > side * side && 9 * (dx * dx + dy * dy) < 4 * side * side;
      case Mask::kDiagonals:
        return (x + y) % 7 == 3 && x % 2 == 0;
      case Mask::kOnSeams:
        return (x % 8 == 0 && y % 5 > 2) || (y % 8 == 0 && x % 7 > 4);
      case Mask::kHalf:
        return x > w / 2;
    }
    return false;
  };
  for (std::int32_t y = 0; y < h; ++y) {
    for (std::int32_t x = 0; x < w; ++x) {
      if (is_void(x, y)) grid.z[static_cast<std::size_t>(std::int64_t{y} * w + x)] = kVoid;
    }
  }
}

/// Mountains that are rough for so small a grid; heights 0 to 2000.
inline HeightGrid mountains(std::int32_t width, std::int32_t height, std::uint64_t seed, Mask mask = Mask::kNone) {
  Terrain terrain;
  terrain.seed = seed;
  terrain.width = width;
  terrain.height = height;
  terrain.cell = 200;
  HeightGrid grid = heights_of(terrain, {0, 0, width, height});
  cut(grid, mask, seed);
  return grid;
}

/// A grid of z = f(column, row).
template <class F>
HeightGrid grid_of(std::int32_t width, std::int32_t height, F&& f) {
  HeightGrid grid{{0, 0, width, height}, {}};
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) grid.z.push_back(f(x, y));
  }
  return grid;
}

/// A grid as a field that gives copies of its parts; outside it is void.
class GridField : public HeightField {
 public:
  explicit GridField(HeightGrid grid) : grid_(std::move(grid)) {}
  std::int32_t width() const override { return grid_.rect.width; }
  std::int32_t height() const override { return grid_.rect.height; }
  const HeightGrid& grid() const { return grid_; }
  HeightGrid read(const GridRect& rect) const override {
    HeightGrid part{rect, {}};
    for (std::int32_t y = rect.y0; y < rect.y0 + rect.height; ++y) {
      for (std::int32_t x = rect.x0; x < rect.x0 + rect.width; ++x) part.z.push_back(grid_.at(x, y));
    }
    return part;
  }

 private:
  HeightGrid grid_;
};

/// The part of a grid that a window task reads: one sample beyond the window on each side.
inline HeightGrid around(const HeightGrid& grid, const GridRect& window) {
  return GridField(grid).read({window.x0 - 1, window.y0 - 1, window.width + 2, window.height + 2});
}

/// Columns in reverse.
inline HeightGrid mirrored(const HeightGrid& grid) {
  return grid_of(grid.rect.width, grid.rect.height,
                 [&](std::int32_t x, std::int32_t y) { return grid.at(grid.rect.width - 1 - x, y); });
}

/// By 90 degrees.
inline HeightGrid turned(const HeightGrid& grid) {
  return grid_of(grid.rect.height, grid.rect.width,
                 [&](std::int32_t x, std::int32_t y) { return grid.at(y, grid.rect.height - 1 - x); });
}

}  // namespace tinsmith::test
