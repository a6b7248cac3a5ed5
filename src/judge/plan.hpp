#pragma once
// Places and triangles in plan, in the grid frame of the raster that a mesh is judged against.

#include <array>
#include <cstdint>

#include "geodesy/grid_frame.hpp"

namespace tinsmith {

/// Machine's slack in plan, in cells: far above what double CRS coordinates lose (some 1e-8 cells at the worst,
/// for grids of centimetres at northings of millions of metres), far below a step of 1/16 cell.
inline constexpr double kPlanEpsilon = 1e-6;

struct PlanPoint {
  double x = 0;  // cells
  double y = 0;

  friend bool operator==(const PlanPoint&, const PlanPoint&) = default;
};

/// A triangle with all that its judgement needs.
struct Facet {
  std::array<PlanPoint, 3> position;
  std::array<double, 3> height;           // vertical units
  std::array<std::uint32_t, 3> vertices;  // their numbers in the mesh
  std::uint32_t number = 0;               // its own
};

/// What a CRS coordinate lost by rounding is put right: a position within the epsilon of a sixteenth of a cell
/// is taken to be there, which makes the arithmetic on it exact. Throws InputError when it is beyond all measure
/// away from the grid.
PlanPoint plan_point(const GridFrame& frame, double x, double y);

/// Twice the area in cells, > 0 when counter-clockwise in the grid.
inline double doubled_area(const PlanPoint& a, const PlanPoint& b, const PlanPoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// Square metres of a cell at a grid position.
double cell_area(const GridFrame& frame, double column, double row);

}  // namespace tinsmith
