#include "judge/plan.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr double kStepsPerCell = 16;
constexpr double kFarthest = 1e12;  // cells; products of two such numbers keep a cell apart from none

double snapped(double x) {
  const double nearest = std::round(x * kStepsPerCell) / kStepsPerCell;
  return std::abs(x - nearest) <= kPlanEpsilon ? nearest : x;
}

}  // namespace

PlanPoint plan_point(const GridFrame& frame, double x, double y) {
  const auto [column, row] = frame.to_grid(x, y);
  if (!(std::abs(column) <= kFarthest && std::abs(row) <= kFarthest))
    throw InputError(
        fmt::format("the mesh has a vertex at ({}, {}), beyond all measure away from the raster; "
                    "verify it against the raster that it was made from",
                    x, y));
  return {snapped(column), snapped(row)};
}

double cell_area(const GridFrame& frame, double column, double row) {
  const auto& g = frame.geotransform;
  const auto [mx, my] = frame.metres_per_unit(column, row);
  return std::abs(g[1] * g[5] - g[2] * g[4]) * mx * my;
}

}  // namespace tinsmith
