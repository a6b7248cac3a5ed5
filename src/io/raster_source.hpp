#pragma once
// One raster file: what it declares, and its heights.

#include <gdal_priv.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "samples/height_grid.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// What has to be known of a raster's band, without keeping it open.
struct RasterSource {
  std::string path;
  std::int32_t width = 0;
  std::int32_t height = 0;
  int band = 1;
  GDALDataType type = GDT_Unknown;
  bool is_signed_byte = false;   // GDT_Byte that means -128 to 127 (PIXELTYPE=SIGNEDBYTE)
  std::optional<double> nodata;  // as a value of the band's own type, none if no value can equal it
  bool has_mask = false;         // a mask band besides nodata
  int alpha_band = 0;            // 0: none
  std::int32_t block_width = 1;  // what is decoded at once
  std::int32_t block_height = 1;
  bool knows_voids = false;  // where the file holds no block, all samples are void, and it says where
  double scale = 1;          // height = value * scale + offset
  double offset = 0;
  std::string height_unit;  // the band's unit type, may be empty
  std::string crs_wkt;      // may be empty
  std::optional<std::array<double, 6>> geotransform;
};

/// The nodata value as the band's type can hold it: float32 rounds 0.1 as the samples were rounded, an
/// integer band never equals 0.5 or what is out of its range.
std::optional<double> nodata_in_type(double nodata, GDALDataType type, bool is_signed_byte = false);

/// Whether a band value is the source's nodata or NaN.
bool is_void(double value, const RasterSource& source);

/// Reads what the band declares. Throws InputError when there is no such band, it is complex, its scale is 0
/// or the raster is only placed by control points; UsageError for band numbers below 1.
RasterSource read_source(GDALDataset& dataset, const std::string& path, const InputOptions& options);

/// Whether the file holds nothing of a rectangle that lies inside the raster: all of it is void. Throws
/// UnreadableError when a file that a VRT takes it from can't be opened.
bool is_surely_void(GDALDataset& dataset, const RasterSource& source, const GridRect& rect);

/// The heights of a rectangle that lies inside the raster, row by row, NaN for voids. Throws UnreadableError when
/// it can't be read, InputError when it holds an infinite height or one beyond any terrain, with the place in the
/// file.
std::vector<double> read_heights(GDALDataset& dataset, const RasterSource& source, const GridRect& rect);

}  // namespace tinsmith
