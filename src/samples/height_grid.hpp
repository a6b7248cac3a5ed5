#pragma once
// Heights on a regular grid, as they were measured: the plain block of samples that the stages work on, and
// the interface through which they ask for one.

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace tinsmith {

/// A rectangle of samples: columns [x0, x0 + width), rows [y0, y0 + height).
struct GridRect {
  std::int32_t x0 = 0;
  std::int32_t y0 = 0;
  std::int32_t width = 0;
  std::int32_t height = 0;

  friend bool operator==(const GridRect&, const GridRect&) = default;
  std::int64_t area() const { return static_cast<std::int64_t>(width) * height; }
};

/// The heights of a rectangle, row by row, in the vertical unit of the input; NaN is a void. Positions that
/// lie outside the field are voids too.
struct HeightGrid {
  GridRect rect;
  std::vector<double> z;

  /// The sample at the grid's own column and row (not relative to rect). Void outside rect.
  double at(std::int32_t x, std::int32_t y) const {
    const std::int64_t i = static_cast<std::int64_t>(x) - rect.x0;
    const std::int64_t j = static_cast<std::int64_t>(y) - rect.y0;
    if (i < 0 || j < 0 || i >= rect.width || j >= rect.height) return std::numeric_limits<double>::quiet_NaN();
    return z[static_cast<std::size_t>(j * rect.width + i)];
  }
  bool is_valid(std::int32_t x, std::int32_t y) const { return !std::isnan(at(x, y)); }

  /// Whether the cell with the corners (x, y) and (x + 1, y + 1) has four valid samples.
  bool is_valid_cell(std::int32_t x, std::int32_t y) const {
    return is_valid(x, y) && is_valid(x + 1, y) && is_valid(x, y + 1) && is_valid(x + 1, y + 1);
  }
};

/// Where samples come from: a raster file, a mosaic, an array in memory.
class HeightField {
 public:
  HeightField() = default;
  HeightField(const HeightField&) = delete;
  HeightField& operator=(const HeightField&) = delete;
  virtual ~HeightField() = default;

  virtual std::int32_t width() const = 0;
  virtual std::int32_t height() const = 0;

  /// The samples of any rectangle; what lies outside the field is void. May be called by several threads.
  /// Throws InputError when the samples can't be read.
  virtual HeightGrid read(const GridRect& rect) const = 0;

  /// Whether all samples of the rectangle are known to be void without reading any: false means that they are or
  /// are not. What makes a raster of 90 billion samples cheap when next to nothing of it is there.
  virtual bool is_surely_void(const GridRect& /*rect*/) const { return false; }
};

}  // namespace tinsmith
