#include "samples/array_field.hpp"

#include <fmt/format.h>

#include "samples/grid_rect.hpp"
#include "samples/height_limit.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

ArrayField::ArrayField(const double* z, std::int32_t width, std::int32_t height)
    : z_(z), width_(width), height_(height) {
  if (z == nullptr || width <= 0 || height <= 0) {
    throw InputError(
        fmt::format("an array of {} x {} heights{} holds no samples; give a pointer and positive sizes", width,
                    height, z == nullptr ? " at a null pointer" : ""));
  }
}

HeightGrid ArrayField::read(const GridRect& rect) const {
  HeightGrid grid = void_grid(rect);
  const GridRect inside = intersection(rect, {0, 0, width_, height_});
  for (std::int32_t row = inside.y0; row < inside.y0 + inside.height; ++row) {
    const double* from = z_ + static_cast<std::int64_t>(row) * width_ + inside.x0;
    double* to = grid.z.data() + static_cast<std::int64_t>(row - rect.y0) * rect.width + (inside.x0 - rect.x0);
    for (std::int32_t i = 0; i < inside.width; ++i) {
      if (!std::isnan(from[i]) && !is_height(from[i])) {
        throw InputError(fmt::format("the height at column {}, row {} of the array is {}; mark voids with NaN",
                                     inside.x0 + i, row, from[i]));
      }
      to[i] = from[i];
    }
  }
  return grid;
}

}  // namespace tinsmith
