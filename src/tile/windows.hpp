#pragma once
// Windows and rounds: how the domain is cut, and again, shifted (DESIGN section 5).

#include <array>
#include <cstdint>

#include "geometry/lattice.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// The windows of one round: squares of `side` cells whose grid starts at (-shift_x, -shift_y).
struct WindowGrid {
  std::int32_t side = 0;
  std::int32_t shift_x = 0;
  std::int32_t shift_y = 0;
  std::int32_t columns = 0;
  std::int32_t rows = 0;

  std::int64_t count() const { return static_cast<std::int64_t>(columns) * rows; }

  /// The window that holds the centroid of a triangle. Every point of the domain is in one window.
  std::int64_t window_of(LatticePoint a, LatticePoint b, LatticePoint c) const;

  /// The samples of a window, its border samples included, clipped to a field of width x height samples.
  GridRect samples(std::int64_t window, std::int32_t width, std::int32_t height) const;
};

inline constexpr int kRounds = 3;

/// The windows of a round for a field of width x height samples: shifted in both directions by 0, by half a side
/// and by a quarter. Round 1 has all seams of round 0 in its inside but for the points where they cross its own
/// borders; those lie at 0 along one axis and half a side along the other, so that one more round, a quarter of a
/// side away from both, has them all inside.
WindowGrid window_grid(std::int32_t width, std::int32_t height, std::int32_t side, int round);

}  // namespace tinsmith
