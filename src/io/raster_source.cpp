#include "io/raster_source.hpp"

#include <cpl_string.h>
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>
#include <type_traits>

#include "io/raster_dataset.hpp"
#include "io/vrt_sources.hpp"
#include "samples/height_limit.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

template <typename Integer>
std::optional<double> as_integer(double value) {
  const auto low = static_cast<double>(std::numeric_limits<Integer>::min());
  const auto high = static_cast<double>(std::numeric_limits<Integer>::max());
  if (value != std::floor(value) || value < low || value > high) return std::nullopt;
  return value;
}

// What lies a hair beyond the largest float is the largest float, printed with too few digits.
double as_float(double value) {
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::isinf(value) || std::abs(value) <= kLargest) return static_cast<double>(static_cast<float>(value));
  return std::abs(value) < kLargest * (1 + 1e-6) ? std::copysign(kLargest, value) : value;
}

// -3.4e38 stands for the -3.4028234663852886e38 of many files. No height is so large, hence nothing but
// voids can be meant by it or by what differs from it in the third digit.
bool is_huge_and_alike(double value, double nodata) {
  return std::abs(nodata) > kLargestHeight && std::abs(value - nodata) < 1e-3 * std::abs(nodata);
}

std::optional<double> declared_nodata(GDALRasterBand& band) {
  int is_there = 0;
  double value = 0;
  if (band.GetRasterDataType() == GDT_Int64) {
    value = static_cast<double>(band.GetNoDataValueAsInt64(&is_there));
  } else if (band.GetRasterDataType() == GDT_UInt64) {
    value = static_cast<double>(band.GetNoDataValueAsUInt64(&is_there));
  } else {
    value = band.GetNoDataValue(&is_there);
  }
  return is_there != 0 ? std::optional(value) : std::nullopt;
}

// A mask that only says again where nodata is would hide nothing more, and it would not know --nodata.
bool has_own_mask(GDALRasterBand& band) {
  const int flags = band.GetMaskFlags();
  return (flags & (GMF_ALL_VALID | GMF_NODATA | GMF_ALPHA)) == 0;
}

// A NODATA_VALUES item makes voids of the cells where every band has its value of the list.
bool has_nodata_of_all_bands(GDALRasterBand& band, const InputOptions& options) {
  const int flags = band.GetMaskFlags();
  return (flags & GMF_NODATA) != 0 && (flags & GMF_PER_DATASET) != 0 && !options.nodata;
}

int find_alpha_band(GDALDataset& dataset, int band) {
  for (int i = 1; i <= dataset.GetRasterCount(); ++i) {
    if (i != band && dataset.GetRasterBand(i)->GetColorInterpretation() == GCI_AlphaBand) return i;
  }
  return 0;
}

void require_usable_band(GDALDataset& dataset, const std::string& path, int band) {
  if (band < 1) throw UsageError(fmt::format("band {} makes no sense; bands are counted from 1", band));
  const int n_bands = dataset.GetRasterCount();
  if (band > n_bands) {
    throw InputError(fmt::format("{}: has no band {}; choose one from 1 to {} with --band", path, band, n_bands));
  }
  const GDALDataType type = dataset.GetRasterBand(band)->GetRasterDataType();
  if (GDALDataTypeIsComplex(type) == 0) return;
  throw InputError(fmt::format("{}: band {} holds complex numbers ({}), not heights; choose another with --band",
                               path, band, GDALGetDataTypeName(type)));
}

// What GDAL makes of a block that the file does not hold: nodata, in a GeoTIFF without it 0. Only these drivers say
// which blocks they hold; a VRT may hide its nodata, hence it has to declare it, and its overviews hide which tiles
// are missing (see touches_readable_only).
bool knows_voids(GDALDataset& dataset, const RasterSource& source) {
  const GDALDriver* driver = dataset.GetDriver();
  const std::string_view name = driver == nullptr ? "" : driver->GetDescription();
  if (name != "GTiff" && name != "COG" && name != "VRT") return false;
  GDALRasterBand& band = *dataset.GetRasterBand(source.band);
  const std::optional<double> declared = declared_nodata(band);
  if (name == "VRT" && (!declared || band.GetOverviewCount() > 0)) return false;
  const auto empty = nodata_in_type(declared.value_or(0), source.type, source.is_signed_byte);
  return empty && is_void(*empty, source);
}

void read_scale(GDALRasterBand& band, RasterSource& source) {
  source.scale = band.GetScale();
  source.offset = band.GetOffset();
  if (std::isfinite(source.scale) && source.scale != 0 && std::isfinite(source.offset)) return;
  throw InputError(
      fmt::format("{}: band {} declares the scale {} and offset {}, which make no heights; set them with "
                  "gdal_edit.py -scale -offset",
                  source.path, source.band, source.scale, source.offset));
}

void read_georeference(GDALDataset& dataset, RasterSource& source) {
  std::array<double, 6> g{};
  if (const OGRSpatialReference* crs = dataset.GetSpatialRef(); crs != nullptr) {
    char* wkt = nullptr;
    if (crs->exportToWkt(&wkt) == OGRERR_NONE) source.crs_wkt = wkt;
    CPLFree(wkt);
  }
  if (dataset.GetGeoTransform(g.data()) == CE_None) {
    source.geotransform = g;
  } else if (dataset.GetGCPCount() > 0 || dataset.GetMetadata("RPC") != nullptr ||
             dataset.GetMetadata("GEOLOCATION") != nullptr) {
    throw InputError(
        fmt::format("{}: placed by control points, RPCs or a geolocation array only, not on a grid of its "
                    "CRS; make a grid of it first with gdalwarp",
                    source.path));
  }
}

std::string place_of(const GridRect& rect) {
  return fmt::format("columns {} to {}, rows {} to {}", rect.x0, rect.x0 + rect.width - 1, rect.y0,
                     rect.y0 + rect.height - 1);
}

bool is_vrt(GDALDataset& dataset) {
  const GDALDriver* driver = dataset.GetDriver();
  return driver != nullptr && std::string_view(driver->GetDescription()) == "VRT";
}

// The reason GDAL gives; of a VRT it gives it for the first dataset only, and the file of it that can't be opened
// has to be looked for.
[[noreturn]] void refuse_unreadable(GDALRasterBand& band, const RasterSource& source, const GridRect& rect) {
  std::string reason = gdal_reason();
  if (reason.empty()) reason = reason_of_vrt(band, source.path);
  throw UnreadableError(
      fmt::format("{}: {} can't be read{}; a file is damaged, cut short or missing: get it again, or leave what it "
                  "holds as a void with --skip-unreadable",
                  source.path, place_of(rect), reason));
}

// A VRT calls a tile that it can't open empty, but it can't read it either: not even a single value for all.
bool touches_readable_only(GDALRasterBand& band, const GridRect& rect) {
  double value = 0;
  return band.RasterIO(GF_Read, rect.x0, rect.y0, rect.width, rect.height, &value, 1, 1, GDT_Float64, 0, 0,
                       nullptr) == CE_None;
}

// GDAL may fill a block in and go on after a failure: its last error counts too, not its return value only.
template <typename Value>
std::vector<Value> read_band(GDALRasterBand& band, const RasterSource& source, const GridRect& rect) {
  constexpr GDALDataType kType = std::is_same_v<Value, double> ? GDT_Float64 : GDT_Float32;
  const QuietGdal quiet;
  std::vector<Value> values(static_cast<std::size_t>(rect.area()));
  const CPLErr status = band.RasterIO(GF_Read, rect.x0, rect.y0, rect.width, rect.height, values.data(), rect.width,
                                      rect.height, kType, 0, 0, nullptr);
  if (status == CE_None && CPLGetLastErrorType() < CE_Failure) return values;
  refuse_unreadable(band, source, rect);
}

void void_where_zero(std::vector<double>& heights, const std::vector<float>& mask) {
  for (std::size_t i = 0; i < heights.size(); ++i) {
    if (mask[i] == 0) heights[i] = std::numeric_limits<double>::quiet_NaN();
  }
}

void apply_masks(GDALDataset& dataset, const RasterSource& source, const GridRect& rect,
                 std::vector<double>& values) {
  if (source.has_mask) {
    void_where_zero(values, read_band<float>(*dataset.GetRasterBand(source.band)->GetMaskBand(), source, rect));
  }
  if (source.alpha_band != 0) {
    void_where_zero(values, read_band<float>(*dataset.GetRasterBand(source.alpha_band), source, rect));
  }
}

double height_of(double value, const RasterSource& source) {
  if (is_void(value, source)) return std::numeric_limits<double>::quiet_NaN();
  if (source.scale == 1 && source.offset == 0) return value;
  return value * source.scale + source.offset;
}

[[noreturn]] void refuse_height(double value, const RasterSource& source, std::int64_t column, std::int64_t row) {
  throw InputError(
      fmt::format("{}: the value at column {}, row {} of band {} is {}, which can't be a height; if it "
                  "marks voids, say so with --nodata {}",
                  source.path, column, row, source.band, value, value));
}

}  // namespace

std::optional<double> nodata_in_type(double nodata, GDALDataType type, bool is_signed_byte) {
  switch (type) {
    case GDT_Byte:
      return is_signed_byte ? as_integer<std::int8_t>(nodata) : as_integer<std::uint8_t>(nodata);
    case GDT_UInt16:
      return as_integer<std::uint16_t>(nodata);
    case GDT_Int16:
      return as_integer<std::int16_t>(nodata);
    case GDT_UInt32:
      return as_integer<std::uint32_t>(nodata);
    case GDT_Int32:
      return as_integer<std::int32_t>(nodata);
    case GDT_UInt64:
      return as_integer<std::uint64_t>(nodata);
    case GDT_Int64:
      return as_integer<std::int64_t>(nodata);
    case GDT_Float32:
      return as_float(nodata);
    default:
      return nodata;
  }
}

bool is_void(double value, const RasterSource& source) {
  if (std::isnan(value)) return true;
  return source.nodata && (value == *source.nodata || is_huge_and_alike(value, *source.nodata));
}

RasterSource read_source(GDALDataset& dataset, const std::string& path, const InputOptions& options) {
  const QuietGdal quiet;
  require_usable_band(dataset, path, options.band);
  GDALRasterBand& band = *dataset.GetRasterBand(options.band);
  const char* pixel_type = band.GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
  RasterSource source;
  source.path = path;
  source.width = dataset.GetRasterXSize();
  source.height = dataset.GetRasterYSize();
  source.band = options.band;
  source.type = band.GetRasterDataType();
  source.is_signed_byte = pixel_type != nullptr && std::strcmp(pixel_type, "SIGNEDBYTE") == 0;
  const std::optional<double> nodata = options.nodata ? options.nodata : declared_nodata(band);
  if (nodata) source.nodata = nodata_in_type(*nodata, source.type, source.is_signed_byte);
  source.has_mask = has_own_mask(band) || has_nodata_of_all_bands(band, options);
  source.alpha_band = find_alpha_band(dataset, options.band);
  band.GetBlockSize(&source.block_width, &source.block_height);
  source.knows_voids = knows_voids(dataset, source);
  source.height_unit = band.GetUnitType();
  read_scale(band, source);
  read_georeference(dataset, source);
  return source;
}

bool is_surely_void(GDALDataset& dataset, const RasterSource& source, const GridRect& rect) {
  if (!source.knows_voids) return false;
  const QuietGdal quiet;
  GDALRasterBand& band = *dataset.GetRasterBand(source.band);
  const int status = band.GetDataCoverageStatus(rect.x0, rect.y0, rect.width, rect.height, 0, nullptr);
  const bool is_empty = status == GDAL_DATA_COVERAGE_STATUS_EMPTY;
  if (CPLGetLastErrorType() >= CE_Failure || (is_empty && is_vrt(dataset) && !touches_readable_only(band, rect)))
    refuse_unreadable(band, source, rect);
  return is_empty;
}

std::vector<double> read_heights(GDALDataset& dataset, const RasterSource& source, const GridRect& rect) {
  std::vector<double> z = read_band<double>(*dataset.GetRasterBand(source.band), source, rect);
  apply_masks(dataset, source, rect, z);
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double value = source.is_signed_byte && z[i] > 127 ? z[i] - 256 : z[i];
    z[i] = height_of(value, source);
    if (std::isnan(z[i]) || is_height(z[i])) continue;
    const auto at = static_cast<std::int64_t>(i);
    refuse_height(value, source, rect.x0 + at % rect.width, rect.y0 + at / rect.width);
  }
  return z;
}

}  // namespace tinsmith
