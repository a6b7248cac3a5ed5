#pragma once
// A TIN in the plane of a grid of positions, ready to be asked for its heights there.

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "samples/height_grid.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// Vertices are (column, row, height) of a grid; the triangles are sorted into square bins.
struct PlanTin {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::array<double, 2> origin{};  // of the bins
  double bin_side = 1;
  int n_columns = 0;
  int n_rows = 0;
  std::vector<std::size_t> first;     // of each bin in `binned`, and one past the last bin
  std::vector<std::uint32_t> binned;  // triangles by bin; a triangle is in each bin that its bounding box meets
};

/// Places a TIN in the plane that `to_plan` maps its CRS coordinates to.
PlanTin make_plan_tin(const Tin& tin, const std::function<std::array<double, 2>(double x, double y)>& to_plan);

/// The heights of the TIN at the integer positions of a rectangle; NaN where no triangle lies.
HeightGrid heights_at(const PlanTin& tin, const GridRect& rect);

}  // namespace tinsmith
