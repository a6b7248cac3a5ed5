#include "geodesy/grid_frame.hpp"

#include <GeographicLib/Ellipsoid.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tinsmith {
namespace {

// What a + b loses by rounding (Knuth 1969): a + b == sum + rounding_of(a, b, sum), exactly.
double rounding_of(double a, double b, double sum) {
  const double b_part = sum - a;
  return (a - (sum - b_part)) + (b - b_part);
}

// origin + u * du + v * dv as if rounded once, or nearly so: the same place then has the same coordinates,
// to the last bit or its neighbour, in every crop and mosaic whose origin was reckoned here too.
double along(double origin, double u, double du, double v, double dv) {
  const double p = u * du;
  const double q = v * dv;
  const double step = p + q;
  const double sum = origin + step;
  const double lost = std::fma(u, du, -p) + std::fma(v, dv, -q) + rounding_of(p, q, step);
  return sum + (lost + rounding_of(origin, step, sum));
}

// Along x the scale vanishes at the poles; half a row from them is as near as it is asked for.
double latitude_deg(const GridFrame& frame, double y) {
  const double degrees_per_unit = frame.radians_per_unit * 180 / std::numbers::pi;
  const double row_step = (std::abs(frame.geotransform[4]) + std::abs(frame.geotransform[5])) * degrees_per_unit;
  const double limit = std::max(90 - row_step / 2, 0.0);
  return std::clamp(y * degrees_per_unit, -limit, limit);
}

}  // namespace

std::array<double, 2> GridFrame::to_crs(double column, double row) const {
  const auto& g = geotransform;
  return {along(g[0], column + 0.5, g[1], row + 0.5, g[2]), along(g[3], column + 0.5, g[4], row + 0.5, g[5])};
}

std::array<double, 2> GridFrame::to_grid(double x, double y) const {
  const auto& g = geotransform;
  const double dx = x - g[0];
  const double dy = y - g[3];
  if (g[2] == 0 && g[4] == 0) return {dx / g[1] - 0.5, dy / g[5] - 0.5};
  const double det = g[1] * g[5] - g[2] * g[4];
  return {(dx * g[5] - dy * g[2]) / det - 0.5, (dy * g[1] - dx * g[4]) / det - 0.5};
}

GridFrame GridFrame::shifted(double columns, double rows) const {
  GridFrame frame = *this;
  const auto& g = geotransform;
  frame.geotransform[0] = along(g[0], columns, g[1], rows, g[2]);
  frame.geotransform[3] = along(g[3], columns, g[4], rows, g[5]);
  return frame;
}

std::array<double, 2> GridFrame::metres_per_unit(double column, double row) const {
  if (!is_geographic) return {metres_per_horizontal_unit, metres_per_horizontal_unit};
  const GeographicLib::Ellipsoid ellipsoid(equatorial_radius, flattening);
  const double latitude = latitude_deg(*this, to_crs(column, row)[1]);
  return {ellipsoid.CircleRadius(latitude) * radians_per_unit,
          ellipsoid.MeridionalCurvatureRadius(latitude) * radians_per_unit};
}

std::array<double, 2> GridFrame::metres_per_step(double column, double row) const {
  const auto [x, y] = metres_per_unit(column, row);
  const auto& g = geotransform;
  return {std::hypot(g[1] * x, g[4] * y), std::hypot(g[2] * x, g[5] * y)};
}

bool GridFrame::is_mirrored() const {
  const auto& g = geotransform;
  return g[1] * g[5] - g[2] * g[4] < 0;
}

}  // namespace tinsmith
