#pragma once
// Arithmetic of rectangles of samples.

#include <algorithm>

#include "samples/height_grid.hpp"

namespace tinsmith {

/// What lies in both; width or height 0 when nothing does.
inline GridRect intersection(const GridRect& a, const GridRect& b) {
  const auto overlap = [](std::int64_t a0, std::int64_t a_size, std::int64_t b0, std::int64_t b_size) {
    return std::max<std::int64_t>(0, std::min(a0 + a_size, b0 + b_size) - std::max(a0, b0));
  };
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0),
          static_cast<std::int32_t>(overlap(a.x0, a.width, b.x0, b.width)),
          static_cast<std::int32_t>(overlap(a.y0, a.height, b.y0, b.height))};
}

inline bool is_empty(const GridRect& rect) { return rect.width <= 0 || rect.height <= 0; }

/// A grid of voids.
inline HeightGrid void_grid(const GridRect& rect) {
  const auto size = is_empty(rect) ? 0 : static_cast<std::size_t>(rect.area());
  return {rect, std::vector<double>(size, std::numeric_limits<double>::quiet_NaN())};
}

}  // namespace tinsmith
