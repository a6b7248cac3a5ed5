#include "triangulate/outline.hpp"

#include <cmath>

namespace tinsmith {

namespace {

// One line of the grid, row or column: position `along` it, `across` it; the cells on its two sides.
class Line {
 public:
  Line(const HeightGrid& samples, const GridRect& window, bool is_row, std::int32_t across)
      : samples_(samples), is_row_(is_row), across_(across) {
    const std::int32_t first = is_row ? window.y0 : window.x0;
    const std::int32_t count = is_row ? window.height : window.width;
    before_inside_ = across > first;
    after_inside_ = across < first + count - 1;
  }

  // What lies on the two sides of the unit edge at `along`: two bits for each side, valid and in the window;
  // 0 when the edge is no part of the outline.
  int status(std::int32_t along) const {
    const bool before = is_valid_cell(along, across_ - 1);
    const bool after = is_valid_cell(along, across_);
    if ((before && before_inside_) == (after && after_inside_)) return 0;
    return 1 + (before ? 2 : 0) + (after ? 4 : 0);
  }

  LatticePoint point(std::int32_t along) const {
    return is_row_ ? LatticePoint{along, across_} : LatticePoint{across_, along};
  }

 private:
  bool is_valid_cell(std::int32_t along, std::int32_t across) const {
    return is_row_ ? samples_.is_valid_cell(along, across) : samples_.is_valid_cell(across, along);
  }

  const HeightGrid& samples_;
  bool is_row_;
  std::int32_t across_;
  bool before_inside_ = false;
  bool after_inside_ = false;
};

void add_pieces(const Line& line, std::int32_t first, std::int32_t last, std::vector<OutlinePiece>& pieces) {
  std::int32_t start = first;
  int status = 0;
  for (std::int32_t i = first; i <= last; ++i) {
    const int now = i < last ? line.status(i) : 0;
    if (now == status) continue;
    if (status != 0) pieces.push_back({line.point(start), line.point(i)});
    start = i;
    status = now;
  }
}

}  // namespace

bool is_full(const HeightGrid& samples, const GridRect& window) {
  for (std::int32_t y = window.y0; y < window.y0 + window.height; ++y) {
    for (std::int32_t x = window.x0; x < window.x0 + window.width; ++x) {
      if (!samples.is_valid(x, y)) return false;
    }
  }
  return true;
}

std::vector<OutlinePiece> outline_of(const HeightGrid& samples, const GridRect& window) {
  std::vector<OutlinePiece> pieces;
  const bool only_frame = is_full(samples, window);
  const std::int32_t right = window.x0 + window.width - 1;
  const std::int32_t bottom = window.y0 + window.height - 1;
  const auto is_wanted = [&](std::int32_t i, std::int32_t first, std::int32_t last) {
    return !only_frame || i == first || i == last;
  };
  for (std::int32_t y = window.y0; y <= bottom; ++y) {
    if (is_wanted(y, window.y0, bottom)) add_pieces(Line(samples, window, true, y), window.x0, right, pieces);
  }
  for (std::int32_t x = window.x0; x <= right; ++x) {
    if (is_wanted(x, window.x0, right)) add_pieces(Line(samples, window, false, x), window.y0, bottom, pieces);
  }
  return pieces;
}

}  // namespace tinsmith
