#include "tile/windows.hpp"

#include <algorithm>

namespace tinsmith {

namespace {

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((b - 1 - a) / b); }

std::int32_t count_along(std::int32_t samples, std::int32_t side, std::int32_t shift) {
  const std::int64_t cells = std::max(samples - 1, 1);
  return static_cast<std::int32_t>((cells + shift + side - 1) / side);
}

}  // namespace

std::int64_t WindowGrid::window_of(LatticePoint a, LatticePoint b, LatticePoint c) const {
  constexpr std::int64_t kThirds = 3 * kLatticePerCell;
  const std::int64_t sum_x = std::int64_t{a.x} + b.x + c.x + kThirds * shift_x;
  const std::int64_t sum_y = std::int64_t{a.y} + b.y + c.y + kThirds * shift_y;
  const std::int64_t column = std::clamp<std::int64_t>(floor_div(sum_x, kThirds * side), 0, columns - 1);
  const std::int64_t row = std::clamp<std::int64_t>(floor_div(sum_y, kThirds * side), 0, rows - 1);
  return row * columns + column;
}

GridRect WindowGrid::samples(std::int64_t window, std::int32_t width, std::int32_t height) const {
  const auto along = [this](std::int64_t i, std::int32_t shift, std::int32_t n) {
    const std::int64_t start = i * side - shift;
    const std::int64_t first = std::max<std::int64_t>(start, 0);
    const std::int64_t last = std::min<std::int64_t>(start + side, n - 1);
    return std::array<std::int32_t, 2>{static_cast<std::int32_t>(first),
                                       static_cast<std::int32_t>(last - first + 1)};
  };
  const auto [x0, w] = along(window % columns, shift_x, width);
  const auto [y0, h] = along(window / columns, shift_y, height);
  return {x0, y0, w, h};
}

WindowGrid window_grid(std::int32_t width, std::int32_t height, std::int32_t side, int round) {
  const std::int32_t shift = round == 0 ? 0 : side / (round == 1 ? 2 : 4);
  return {side, shift, shift, count_along(width, side, shift), count_along(height, side, shift)};
}

}  // namespace tinsmith
