#include "judge/plan_mesh.hpp"

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

PlanMesh plan_mesh(const Tin& tin, const GridFrame& frame) {
  PlanMesh mesh;
  mesh.orientation = frame.is_mirrored() ? -1 : 1;
  mesh.position.reserve(tin.vertices.size());
  mesh.height.reserve(tin.vertices.size());
  for (const auto& [x, y, z] : tin.vertices) {
    const auto [column, row] = frame.to_grid(x, y);
    if (!(std::abs(column) <= kFarthest && std::abs(row) <= kFarthest))
      throw InputError(
          fmt::format("the mesh has a vertex at ({}, {}), beyond all measure away from the raster; "
                      "verify it against the raster that it was made from",
                      x, y));
    mesh.position.push_back({snapped(column), snapped(row)});
    mesh.height.push_back(z);
  }
  mesh.triangles = tin.triangles;
  return mesh;
}

double cell_area(const GridFrame& frame, double column, double row) {
  const auto& g = frame.geotransform;
  const auto [mx, my] = frame.metres_per_unit(column, row);
  return std::abs(g[1] * g[5] - g[2] * g[4]) * mx * my;
}

void measure_areas(const PlanMesh& mesh, const GridFrame& frame, Certificate& certificate) {
  for (const auto& [i, j, k] : mesh.triangles) {
    const PlanPoint& a = mesh.position[i];
    const PlanPoint& b = mesh.position[j];
    const PlanPoint& c = mesh.position[k];
    const double doubled = mesh.orientation * doubled_area(a, b, c);
    if (!(doubled > 0)) ++certificate.folded;
    const double cells = std::abs(doubled) / 2;
    certificate.cells_plan += cells;
    certificate.area_plan += cells * cell_area(frame, (a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3);
  }
}

}  // namespace tinsmith
