#pragma once
// Heights in memory as a field.

#include <cstdint>

#include "samples/height_grid.hpp"

namespace tinsmith {

/// width * height doubles, row by row, NaN a void. Does not own them: they must outlive the field.
class ArrayField : public HeightField {
 public:
  /// Throws InputError when a size is not positive or z is null.
  ArrayField(const double* z, std::int32_t width, std::int32_t height);

  std::int32_t width() const override { return width_; }
  std::int32_t height() const override { return height_; }
  /// Throws InputError when a sample of the rectangle is infinite or no height.
  HeightGrid read(const GridRect& rect) const override;

 private:
  const double* z_;
  std::int32_t width_;
  std::int32_t height_;
};

}  // namespace tinsmith
