#pragma once
// Colours at the samples of a height field: what a mesh is draped with.

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/colour.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// The colours of a rectangle of samples. A channel is a grid with levels of 0 to 255 in place of heights; a sample
/// without colour is NaN in all of them.
struct ColourGrid {
  GridRect rect;
  std::vector<HeightGrid> channels;  // 1 to kMaxChannels

  /// The colour of the grid's own column and row, which lie in rect.
  Levels at(std::int32_t x, std::int32_t y) const {
    Levels colour{};
    for (std::size_t c = 0; c < channels.size(); ++c) colour[c] = static_cast<float>(channels[c].at(x, y));
    return colour;
  }
};

/// Where colours come from, on the grid of a HeightField.
class ColourField {
 public:
  ColourField() = default;
  ColourField(const ColourField&) = delete;
  ColourField& operator=(const ColourField&) = delete;
  virtual ~ColourField() = default;

  /// 1 to kMaxChannels.
  virtual int n_channels() const = 0;

  /// The colours of any rectangle; what lies outside the field has none. The same sample has the same colour,
  /// whatever the rectangle. May be called by several threads. Throws InputError when they can't be read.
  virtual ColourGrid read(const GridRect& rect) const = 0;
};

/// A mesh has a colour everywhere: where the field has none it is white, and the rim of the field stays an edge.
inline void whiten_gaps(ColourGrid& grid) {
  for (HeightGrid& channel : grid.channels) {
    for (double& level : channel.z) {
      if (std::isnan(level)) level = static_cast<double>(kWhite);
    }
  }
}

}  // namespace tinsmith
