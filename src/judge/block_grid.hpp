#pragma once
// The raster in rectangular blocks, and the plane with them: the outer blocks reach to infinity, so that every
// place lies in exactly one.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "judge/plan.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

struct BlockSize {
  std::int32_t width = 512;  // samples
  std::int32_t height = 512;
};

/// The number of a block: row by row.
using BlockNumber = std::uint64_t;

/// A block's part of the plane: x and y from the low end, below the high one.
struct BlockExtent {
  double x_low, x_high, y_low, y_high;  // cells, infinite at the rim of the raster

  bool holds(const PlanPoint& p) const { return p.x >= x_low && p.x < x_high && p.y >= y_low && p.y < y_high; }
};

class BlockGrid {
 public:
  BlockGrid(const HeightField& field, BlockSize size);

  BlockNumber block_of(const PlanPoint& p) const { return number(column_of(p.x), row_of(p.y)); }
  /// The samples of a block.
  GridRect samples_of(BlockNumber block) const;
  /// Holds the places p with block_of(p) == block.
  BlockExtent extent_of(BlockNumber block) const;
  /// Whether the facet lies well inside one block.
  bool is_in_one_block(const Facet& facet) const;

  /// The blocks that the facet may touch, each once: at least those that it does, those of its vertices and all
  /// that an edge touches. Facets that share an edge agree about the blocks of the edge.
  void find_blocks(const Facet& facet, std::vector<BlockNumber>& blocks) const;

  /// The blocks that may hold valid samples.
  std::vector<BlockNumber> blocks_with_samples(const HeightField& field) const;

 private:
  struct Range;

  std::int64_t column_of(double x) const { return part(x, size_.width, n_columns_); }
  std::int64_t row_of(double y) const { return part(y, size_.height, n_rows_); }
  /// Divides whole numbers only: a place just before a block must not be rounded into it.
  static std::int64_t part(double x, std::int32_t size, std::int64_t n) {
    const double last = static_cast<double>(n * size - 1);
    return static_cast<std::int64_t>(std::clamp(std::floor(x), 0.0, last)) / size;
  }
  BlockNumber number(std::int64_t column, std::int64_t row) const {
    return static_cast<BlockNumber>(row) * static_cast<BlockNumber>(n_columns_) + static_cast<BlockNumber>(column);
  }
  GridRect samples_of(const Range& range) const;
  void add_blocks_with_samples(const HeightField& field, const Range& range,
                               std::vector<BlockNumber>& blocks) const;

  std::int32_t width_;  // samples
  std::int32_t height_;
  BlockSize size_;
  std::int64_t n_columns_;
  std::int64_t n_rows_;
};

}  // namespace tinsmith
