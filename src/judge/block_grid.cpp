#include "judge/block_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tinsmith {
namespace {

struct Extent {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

/// Far wider than the plan epsilon and than what rounding does to a place on an edge.
double margin_of(const Facet& facet) {
  double farthest = 0;
  for (const PlanPoint& p : facet.position) farthest = std::max({farthest, std::abs(p.x), std::abs(p.y)});
  return 1e-3 + 1e-11 * farthest;
}

Extent columns_of(const Facet& facet) {
  Extent extent;
  for (const PlanPoint& p : facet.position) extent.add(p.x);
  return extent;
}

Extent rows_of(const Facet& facet) {
  Extent extent;
  for (const PlanPoint& p : facet.position) extent.add(p.y);
  return extent;
}

/// Adds the columns of the part of an edge that lies within some rows. The same for both directions of the edge.
void add_columns(PlanPoint from, PlanPoint to, const Extent& rows, Extent& columns) {
  if (from.y > to.y || (from.y == to.y && from.x > to.x)) std::swap(from, to);
  if (to.y < rows.low || from.y > rows.high) return;
  const auto column_at = [&](double y) {
    if (y <= from.y) return from.x;
    if (y >= to.y) return to.x;
    return from.x + (to.x - from.x) * ((y - from.y) / (to.y - from.y));
  };
  columns.add(column_at(rows.low));
  columns.add(column_at(rows.high));
  // A level edge has one row and all its columns.
  if (from.y == to.y) columns.add(to.x);
}

std::int32_t clipped(std::int64_t n_blocks, std::int32_t size, std::int32_t most) {
  return static_cast<std::int32_t>(std::min<std::int64_t>(n_blocks * size, most));
}

}  // namespace

/// Columns [column, column_end) and rows [row, row_end) of blocks.
struct BlockGrid::Range {
  std::int64_t column, row, column_end, row_end;
};

BlockGrid::BlockGrid(const HeightField& field, BlockSize size)
    : width_(field.width()),
      height_(field.height()),
      size_(size),
      n_columns_((std::int64_t{width_} + size.width - 1) / size.width),
      n_rows_((std::int64_t{height_} + size.height - 1) / size.height) {}

GridRect BlockGrid::samples_of(const Range& range) const {
  const std::int32_t x0 = clipped(range.column, size_.width, width_);
  const std::int32_t y0 = clipped(range.row, size_.height, height_);
  return {x0, y0, clipped(range.column_end, size_.width, width_) - x0,
          clipped(range.row_end, size_.height, height_) - y0};
}

GridRect BlockGrid::samples_of(BlockNumber block) const {
  const auto column = static_cast<std::int64_t>(block) % n_columns_;
  const auto row = static_cast<std::int64_t>(block) / n_columns_;
  return samples_of({column, row, column + 1, row + 1});
}

BlockExtent BlockGrid::extent_of(BlockNumber block) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const auto column = static_cast<std::int64_t>(block) % n_columns_;
  const auto row = static_cast<std::int64_t>(block) / n_columns_;
  const auto start = [](std::int64_t n, std::int32_t size) { return static_cast<double>(n * size); };
  return {column == 0 ? -kInfinity : start(column, size_.width),
          column + 1 == n_columns_ ? kInfinity : start(column + 1, size_.width),
          row == 0 ? -kInfinity : start(row, size_.height),
          row + 1 == n_rows_ ? kInfinity : start(row + 1, size_.height)};
}

bool BlockGrid::is_in_one_block(const Facet& facet) const {
  const Extent columns = columns_of(facet);
  const Extent rows = rows_of(facet);
  const double margin = margin_of(facet);
  return column_of(columns.low - margin) == column_of(columns.high + margin) &&
         row_of(rows.low - margin) == row_of(rows.high + margin);
}

void BlockGrid::find_blocks(const Facet& facet, std::vector<BlockNumber>& blocks) const {
  blocks.clear();
  const Extent rows = rows_of(facet);
  const double margin = margin_of(facet);
  const auto& [a, b, c] = facet.position;
  const std::int64_t first_row = row_of(rows.low - margin);
  const std::int64_t last_row = row_of(rows.high + margin);
  for (std::int64_t row = first_row; row <= last_row; ++row) {
    // The outermost rows reach to infinity; rows of the facet do not.
    const auto top = static_cast<double>(row * size_.height);
    const Extent within{row == first_row ? rows.low : std::clamp(top - margin, rows.low, rows.high),
                        row == last_row ? rows.high : std::clamp(top + size_.height + margin, rows.low, rows.high)};
    Extent columns;
    add_columns(a, b, within, columns);
    add_columns(b, c, within, columns);
    add_columns(c, a, within, columns);
    const std::int64_t last_column = column_of(columns.high + margin);
    for (std::int64_t column = column_of(columns.low - margin); column <= last_column; ++column)
      blocks.push_back(number(column, row));
  }
}

std::vector<BlockNumber> BlockGrid::blocks_with_samples(const HeightField& field) const {
  std::vector<BlockNumber> blocks;
  add_blocks_with_samples(field, {0, 0, n_columns_, n_rows_}, blocks);
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

/// Halves what may hold samples, so that large voids are asked for once.
void BlockGrid::add_blocks_with_samples(const HeightField& field, const Range& range,
                                        std::vector<BlockNumber>& blocks) const {
  if (field.is_surely_void(samples_of(range))) return;
  const std::int64_t n_columns = range.column_end - range.column;
  const std::int64_t n_rows = range.row_end - range.row;
  if (n_columns == 1 && n_rows == 1) {
    blocks.push_back(number(range.column, range.row));
    return;
  }
  Range first = range;
  Range second = range;
  if (n_columns > n_rows)
    first.column_end = second.column = range.column + n_columns / 2;
  else
    first.row_end = second.row = range.row + n_rows / 2;
  add_blocks_with_samples(field, first, blocks);
  add_blocks_with_samples(field, second, blocks);
}

}  // namespace tinsmith
