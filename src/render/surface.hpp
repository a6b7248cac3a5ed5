#pragma once
// Pixels of a cairo image, set one by one.

#include <cmath>
#include <cstdint>

#include "render/colour.hpp"
#include "render/panels.hpp"

namespace tinsmith {

/// As cairo keeps it in RGB24: blue in the low byte.
inline std::uint32_t packed(const Colour& c) {
  const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(v * 255)); };
  return byte(c.r) << 16U | byte(c.g) << 8U | byte(c.b);
}

/// colour_of(index) for each pixel with a value, blended into the colour of voids by its coverage.
template <class ColourOf>
Surface paint(const PixelGrid& pixels, const ColourOf& colour_of) {
  Surface surface = make_surface(pixels.width, pixels.height);
  unsigned char* const data = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  for (int y = 0; y < pixels.height; ++y) {
    auto* const row = reinterpret_cast<std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < pixels.width; ++x) {
      const std::size_t i = pixels.index(x, y);
      const float coverage = pixels.coverage[i];
      row[x] = packed(coverage > 0 ? mix(kVoidColour, colour_of(i), coverage) : kVoidColour);
    }
  }
  cairo_surface_mark_dirty(surface.get());
  return surface;
}

}  // namespace tinsmith
