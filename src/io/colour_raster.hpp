#pragma once
// A GDAL raster as colours on the grid of a height field.

#include <memory>
#include <optional>
#include <string>

#include "geodesy/grid_frame.hpp"
#include "samples/colour_grid.hpp"

namespace tinsmith {

/// Any raster of 1 to 4 bands (besides alpha) with a resolution and CRS of its own, warped as it is read: the
/// average of its cells where they are finer than the grid's, bilinear where not. No colour: nodata value, mask
/// band, alpha = 0, outside. When the raster or the grid has no CRS, both are taken to have the same.
///
/// Levels: of Byte bands the values; a palette is expanded to red, green and blue. Of other types the largest value
/// of all bands (GDAL's approximate maximum, that of a sample of the raster) is rounded up to 1, 255, or a power of
/// two less one (1023, 4095, 65535), and that full scale becomes 255; beyond either end is that end.
class ColourRaster : public ColourField {
 public:
  /// `frame`, `width` and `height` are those of the height field. Throws InputError when the file can't be opened,
  /// has too many bands or complex ones, no place on the earth, or lies elsewhere.
  ColourRaster(const std::string& path, const GridFrame& frame, std::int32_t width, std::int32_t height);
  ~ColourRaster() override;

  /// What the user should be told once: that a CRS is missing.
  std::optional<std::string> remark() const;

  int n_channels() const override;
  ColourGrid read(const GridRect& rect) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tinsmith
