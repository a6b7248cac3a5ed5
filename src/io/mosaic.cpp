#include "io/mosaic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "geodesy/crs.hpp"
#include "geometry/lattice.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// Tiles declare their origins and steps in decimals, the best of them to 1e-6 of a cell, USGS tiles to some
// 1e-5. Half-cell shifts, the usual mismatch, are far beyond a thousandth.
constexpr double kGridEpsilon = 1e-3;

// A box given as the coordinates of a sample must hold it: a millionth of a step is far above the rounding
// of any coordinate and far below what a user could mean.
constexpr double kBoxEpsilon = 1e-6;

// Vertices lie on a lattice of 32-bit integers; a bit to spare for differences.
constexpr double kMaxSide = std::numeric_limits<std::int32_t>::max() / (2.0 * kLatticePerCell);

[[noreturn]] void refuse(const PlacedRaster& a, const PlacedRaster& b, const std::string& what) {
  throw InputError(fmt::format("{} and {} {}; bring them to one grid first with gdalwarp", a.name, b.name, what));
}

// The steps may differ by what their rounding moves the far corner, but not by more.
void require_same_steps(const PlacedRaster& a, const PlacedRaster& b) {
  const auto& g = a.frame.geotransform;
  const auto& h = b.frame.geotransform;
  const auto drift = [](double d_column, double d_row, const PlacedRaster& of) {
    return std::abs(d_column) * of.width + std::abs(d_row) * of.height;
  };
  const double cell = std::min(std::hypot(g[1], g[4]), std::hypot(g[2], g[5]));
  const double x = drift(h[1] - g[1], h[2] - g[2], b);
  const double y = drift(h[4] - g[4], h[5] - g[5], b);
  if (x <= kGridEpsilon * cell && y <= kGridEpsilon * cell) return;
  refuse(a, b, fmt::format("have different cells ({} x {} and {} x {})", g[1], g[5], h[1], h[5]));
}

void require_same_units(const PlacedRaster& a, const PlacedRaster& b) {
  if (!is_same_crs(a.frame.crs_wkt, b.frame.crs_wkt)) refuse(a, b, "have different CRSs");
  const double one = a.frame.metres_per_vertical_unit;
  const double other = b.frame.metres_per_vertical_unit;
  if (one == other) return;
  throw InputError(
      fmt::format("{} has heights in units of {} m, {} in units of {} m; bring them to one unit first, or "
                  "say it for both with --vertical-unit",
                  a.name, one, b.name, other));
}

struct Offset {
  double columns;
  double rows;
};

Offset offset_of(const PlacedRaster& a, const PlacedRaster& b) {
  const auto [x, y] = b.frame.to_crs(0, 0);
  const auto [column, row] = a.frame.to_grid(x, y);
  const Offset whole{std::round(column), std::round(row)};
  const double off = std::max(std::abs(column - whole.columns), std::abs(row - whole.rows));
  if (off <= kGridEpsilon) return whole;
  refuse(a, b, fmt::format("lie on shifted grids ({:.3f} columns and {:.3f} rows apart)", column, row));
}

void require_countable(double width, double height) {
  if (width <= kMaxSide && height <= kMaxSide) return;
  throw ResourceError(
      fmt::format("the inputs span {:.0f} x {:.0f} samples, more than the {:.0f} along a side that can "
                  "be counted; compress parts of them with --bbox",
                  width, height, kMaxSide));
}

void require_box(const Bbox& box) {
  const bool is_finite = std::all_of(box.begin(), box.end(), [](double v) { return std::isfinite(v); });
  if (is_finite && box[0] <= box[2] && box[1] <= box[3]) return;
  throw UsageError(fmt::format("the box {} makes no sense; give west south east north in the units of the CRS",
                               fmt::join(box, " ")));
}

std::array<double, 2> box_margin(const GridFrame& frame) {
  const auto& g = frame.geotransform;
  return {kBoxEpsilon * (std::abs(g[1]) + std::abs(g[2])), kBoxEpsilon * (std::abs(g[4]) + std::abs(g[5]))};
}

struct Span {
  double first;
  double last;

  void add(double v) {
    first = std::min(first, v);
    last = std::max(last, v);
  }
};

constexpr Span kNothing{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

std::string extent_of(const Mosaic& mosaic) {
  Span x = kNothing;
  Span y = kNothing;
  for (const double column : {-0.5, mosaic.width - 0.5}) {
    for (const double row : {-0.5, mosaic.height - 0.5}) {
      const auto corner = mosaic.frame.to_crs(column, row);
      x.add(corner[0]);
      y.add(corner[1]);
    }
  }
  return fmt::format("{} {} {} {}", x.first, y.first, x.last, y.last);
}

// The samples within the box, as columns and rows of the rectangle around it.
GridRect box_on_grid(const Mosaic& mosaic, const Bbox& box) {
  const auto [mx, my] = box_margin(mosaic.frame);
  Span columns = kNothing;
  Span rows = kNothing;
  for (const double x : {box[0] - mx, box[2] + mx}) {
    for (const double y : {box[1] - my, box[3] + my}) {
      const auto [column, row] = mosaic.frame.to_grid(x, y);
      columns.add(column);
      rows.add(row);
    }
  }
  const double c0 = std::max(0.0, std::ceil(columns.first));
  const double r0 = std::max(0.0, std::ceil(rows.first));
  const double c1 = std::min(mosaic.width - 1.0, std::floor(columns.last));
  const double r1 = std::min(mosaic.height - 1.0, std::floor(rows.last));
  if (c1 < c0 || r1 < r0) {
    throw UsageError(fmt::format("the box {} holds no sample of the input, which spans {} (west south east north)",
                                 fmt::join(box, " "), extent_of(mosaic)));
  }
  return {static_cast<std::int32_t>(c0), static_cast<std::int32_t>(r0), static_cast<std::int32_t>(c1 - c0 + 1),
          static_cast<std::int32_t>(r1 - r0 + 1)};
}

}  // namespace

Mosaic lay_out(const std::vector<PlacedRaster>& rasters) {
  if (rasters.empty()) throw UsageError("no input; name at least one raster");
  const PlacedRaster& first = rasters.front();
  std::vector<Offset> offsets;
  Span columns = kNothing;
  Span rows = kNothing;
  for (const PlacedRaster& raster : rasters) {
    require_same_units(first, raster);
    require_same_steps(first, raster);
    const Offset offset = offset_of(first, raster);
    offsets.push_back(offset);
    columns.add(offset.columns);
    columns.add(offset.columns + raster.width);
    rows.add(offset.rows);
    rows.add(offset.rows + raster.height);
  }
  require_countable(columns.last - columns.first, rows.last - rows.first);
  Mosaic mosaic{first.frame.shifted(columns.first, rows.first),
                static_cast<std::int32_t>(columns.last - columns.first),
                static_cast<std::int32_t>(rows.last - rows.first),
                {}};
  for (std::size_t i = 0; i < rasters.size(); ++i) {
    mosaic.places.push_back({static_cast<std::int32_t>(offsets[i].columns - columns.first),
                             static_cast<std::int32_t>(offsets[i].rows - rows.first), rasters[i].width,
                             rasters[i].height});
  }
  return mosaic;
}

Mosaic crop(const Mosaic& mosaic, const Bbox& bbox) {
  require_box(bbox);
  const GridRect part = box_on_grid(mosaic, bbox);
  Mosaic cropped{mosaic.frame.shifted(part.x0, part.y0), part.width, part.height, mosaic.places};
  for (GridRect& place : cropped.places) {
    place.x0 -= part.x0;
    place.y0 -= part.y0;
  }
  return cropped;
}

bool is_inside(const GridFrame& frame, std::int32_t column, std::int32_t row, const Bbox& bbox) {
  const auto [x, y] = frame.to_crs(column, row);
  const auto [mx, my] = box_margin(frame);
  return x >= bbox[0] - mx && x <= bbox[2] + mx && y >= bbox[1] - my && y <= bbox[3] + my;
}

bool is_turned(const GridFrame& frame) {
  const auto& g = frame.geotransform;
  return (g[1] != 0 || g[5] != 0) && (g[2] != 0 || g[4] != 0);
}

}  // namespace tinsmith
