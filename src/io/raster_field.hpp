#pragma once
// GDAL rasters as one field of heights. The only folder that names GDAL is this one.

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// One or thousands of rasters of one grid (same CRS, same steps, origins a whole number of steps apart), read
/// block-wise at full resolution. Heights are band value * scale + offset in the vertical unit of the CRS or band.
/// Where inputs overlap, options.overlap says which of the valid ones counts. Void: nodata value, NaN, mask band,
/// alpha = 0, and with options.skip_unreadable what can't be opened or read.
class RasterField : public HeightField {
 public:
  /// A path @FILE stands for the paths in FILE, one a line. Throws InputError when a file can't be opened, has no
  /// such band, or the grids don't match; when all are skipped too.
  RasterField(const std::vector<std::string>& paths, const InputOptions& options);
  ~RasterField() override;

  std::int32_t width() const override;
  std::int32_t height() const override;
  HeightGrid read(const GridRect& rect) const override;
  /// True outside of all inputs, and where GeoTIFFs and VRTs hold no block and their nodata is void. Microseconds.
  bool is_surely_void(const GridRect& rect) const override;

  const GridFrame& frame() const;

  /// What a user should be told once (no CRS: metres assumed; vertical unit guessed; blocks that make windows
  /// costly; inputs left as voids), one sentence each. Inputs that read() found damaged so far are among them.
  std::vector<std::string> remarks() const;

  /// Compares the inputs where they overlap (see compare_overlaps for how much of it): one sentence when they
  /// disagree. Takes up to a sixteenth of a pass over the inputs. Throws UnreadableError.
  std::optional<std::string> remark_on_overlaps() const;

  /// Inputs that were left as voids, wholly or in part, as far as is known from what was read.
  std::uint64_t n_unreadable() const;

  /// The cache in bytes (set_raster_cache) that holds all decoded blocks under any rectangle of so many samples:
  /// little for tiled rasters, all of the rows for whole-row strips.
  std::uint64_t cache_for(std::int64_t width, std::int64_t height) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The memory that GDAL may use for decoded blocks of all rasters together, in bytes. Without a call GDAL takes
/// what GDAL_CACHEMAX says, or a twentieth of the machine's.
void set_raster_cache(std::uint64_t bytes);

/// Frees the blocks that GDAL holds decoded.
void empty_raster_cache();

}  // namespace tinsmith
