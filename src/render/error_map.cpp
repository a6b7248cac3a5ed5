#include "render/colour.hpp"
#include "render/panels.hpp"
#include "render/surface.hpp"

namespace tinsmith {

Surface draw_errors(const PixelGrid& errors, double scale) {
  return paint(errors, [&](std::size_t i) { return diverging(errors.value[i] / scale); });
}

}  // namespace tinsmith
