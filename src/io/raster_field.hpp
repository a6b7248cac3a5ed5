#pragma once
// GDAL rasters as one field of heights. The only folder that names GDAL is this one.

#include <memory>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// One or several rasters of one grid (same CRS, same steps, origins a whole number of steps apart), read
/// block-wise. Heights are band value * scale + offset in the vertical unit of the CRS or band. Where inputs
/// overlap the first valid one wins. Void: nodata value, NaN, mask band, alpha = 0.
class RasterField : public HeightField {
 public:
  /// Throws InputError when a file can't be opened, has no such band, or the grids don't match.
  RasterField(const std::vector<std::string>& paths, const InputOptions& options);
  ~RasterField() override;

  std::int32_t width() const override;
  std::int32_t height() const override;
  HeightGrid read(const GridRect& rect) const override;

  const GridFrame& frame() const;
  /// What a user should be told once (no CRS: metres assumed; vertical unit guessed), one sentence each.
  const std::vector<std::string>& remarks() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tinsmith
