#pragma once
// The mesh of a file, in the grid frame of the raster that it is judged against.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "tinsmith/certificate.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// Machine's slack in plan, in cells: far above what double CRS coordinates lose (some 1e-8 cells at the worst,
/// for grids of centimetres at northings of millions of metres), far below a step of 1/16 cell.
inline constexpr double kPlanEpsilon = 1e-6;

struct PlanPoint {
  double x = 0;  // cells
  double y = 0;

  friend bool operator==(const PlanPoint&, const PlanPoint&) = default;
};

using Corners = std::array<std::uint32_t, 3>;

struct PlanMesh {
  std::vector<PlanPoint> position;
  std::vector<double> height;  // vertical units
  std::vector<Corners> triangles;
  double orientation = 1;  // sign of the area in the grid of what is counter-clockwise seen from above
};

/// What a CRS coordinate lost by rounding is put right: positions within the epsilon of a sixteenth of a cell
/// are taken to be there, which makes the arithmetic on them exact. Throws InputError when the mesh is beyond
/// all measure away from the grid.
PlanMesh plan_mesh(const Tin& tin, const GridFrame& frame);

/// Twice the area in cells, > 0 when counter-clockwise in the grid.
inline double doubled_area(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Square metres of a cell at a grid position.
double cell_area(const GridFrame& frame, double column, double row);

/// Fills folded, area_plan and cells_plan.
void measure_areas(const PlanMesh& mesh, const GridFrame& frame, Certificate& certificate);

}  // namespace tinsmith
