#include "io/raster_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

void remark_once(std::vector<std::string>& remarks, const std::string& remark) {
  if (std::find(remarks.begin(), remarks.end(), remark) == remarks.end()) remarks.push_back(remark);
}

std::string plural(const std::string& unit) {
  constexpr std::string_view kFoot = "foot";
  if (unit.ends_with(kFoot)) return unit.substr(0, unit.size() - kFoot.size()) + "feet";
  return unit == "unknown" ? "units" : unit + "s";
}

bool says_nothing(const std::string& unit) {
  return unit.find_first_not_of(" \t") == std::string::npos || unit == "unknown" || unit == "none";
}

double named_height_unit(const RasterSource& source) {
  if (const auto metres = metres_per_named_unit(source.height_unit)) return *metres;
  throw InputError(
      fmt::format("{}: the heights of band {} are in '{}', which is no known unit of length; say how many "
                  "metres it is with --vertical-unit",
                  source.path, source.band, source.height_unit));
}

double height_unit(const RasterSource& source, const CrsUnits& crs, const InputOptions& options,
                   std::vector<std::string>& remarks) {
  if (options.vertical_unit) {
    if (std::isfinite(*options.vertical_unit) && *options.vertical_unit > 0) return *options.vertical_unit;
    throw UsageError(fmt::format("a vertical unit of {} metres makes no sense; give a positive length in metres",
                                 *options.vertical_unit));
  }
  if (!says_nothing(source.height_unit)) return named_height_unit(source);
  if (crs.metres_per_height) return *crs.metres_per_height;
  if (crs.is_geographic || crs.metres_per_horizontal_unit == 1) return 1;
  remark_once(remarks, fmt::format("heights taken to be in {} like the CRS; use --vertical-unit to say otherwise",
                                   plural(crs.horizontal_unit)));
  return crs.metres_per_horizontal_unit;
}

void place(const RasterSource& source, GridFrame& frame, std::vector<std::string>& remarks) {
  if (source.crs_wkt.empty()) remark_once(remarks, "no CRS: horizontal coordinates taken to be in metres");
  if (!source.geotransform) {
    remark_once(remarks, "no georeference: cells taken to be 1 unit wide, the first at the origin");
    return;
  }
  frame.geotransform = *source.geotransform;
  const auto& g = frame.geotransform;
  const bool is_finite = std::all_of(g.begin(), g.end(), [](double v) { return std::isfinite(v); });
  if (is_finite && std::isnormal(g[1] * g[5] - g[2] * g[4])) return;
  throw InputError(fmt::format("{}: its geotransform ({}) spans no plane; set one with gdal_edit.py -a_ullr",
                               source.path, fmt::join(g, ", ")));
}

// Metres labelled as degrees are the usual mistake: seen at once in a latitude of 5 100 000.
void require_latitudes(const RasterSource& source, const GridFrame& frame) {
  const double degrees_per_unit = frame.radians_per_unit * 180 / std::numbers::pi;
  const double row_step = std::abs(frame.geotransform[4]) + std::abs(frame.geotransform[5]);
  for (const double row : {0.0, source.height - 1.0}) {
    for (const double column : {0.0, source.width - 1.0}) {
      const double latitude = frame.to_crs(column, row)[1];
      if (std::abs(latitude) * degrees_per_unit <= 90 + row_step * degrees_per_unit) continue;
      throw InputError(
          fmt::format("{}: its CRS is geographic but its latitudes reach {}; set its true CRS with "
                      "gdal_edit.py -a_srs",
                      source.path, latitude));
    }
  }
}

}  // namespace

GridFrame frame_of(const RasterSource& source, const CrsUnits& crs, const InputOptions& options,
                   std::vector<std::string>& remarks) {
  GridFrame frame;
  frame.crs_wkt = source.crs_wkt;
  frame.is_geographic = crs.is_geographic;
  frame.metres_per_horizontal_unit = crs.metres_per_horizontal_unit;
  frame.radians_per_unit = crs.radians_per_unit;
  frame.equatorial_radius = crs.equatorial_radius;
  frame.flattening = crs.flattening;
  place(source, frame, remarks);
  if (frame.is_geographic) require_latitudes(source, frame);
  frame.metres_per_vertical_unit = height_unit(source, crs, options, remarks);
  return frame;
}

}  // namespace tinsmith
