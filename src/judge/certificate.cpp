#include "tinsmith/certificate.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tinsmith {
namespace {

// What adding up areas of many triangles loses by rounding, relative; and a trace of a cell, far below the
// smallest triangle of the lattice (1/512 cell), for rasters of a few cells only.
constexpr double kAreaEpsilon = 1e-9;
constexpr double kAreaTrace = 1e-6;

bool is_same_area(double cells_plan, double cells_valid) {
  return std::abs(cells_plan - cells_valid) <= kAreaEpsilon * cells_valid + kAreaTrace;
}

}  // namespace

std::vector<std::string> Certificate::broken_promises(double tolerance) const {
  std::vector<std::string> broken;
  if (tolerance >= 0 && !(max_error <= tolerance + rounding))
    broken.push_back(fmt::format("The largest error is {} m at column {}, row {}; the tolerance is {} m.",
                                 max_error, max_error_column, max_error_row, tolerance));
  const auto expect_none = [&](std::uint64_t n, const char* what) {
    if (n > 0) broken.push_back(fmt::format("{} {}.", n, what));
  };
  expect_none(uncovered, "samples beside a valid cell lie in no triangle");
  expect_none(overlapped, "samples lie inside more than one triangle");
  expect_none(voids_covered, "void cells lie inside a triangle");
  expect_none(folded, "triangles are folded: their area in plan is not positive");
  expect_none(non_manifold_edges,
              "edges are not manifold: used by more than two triangles, or twice in one direction");
  expect_none(non_manifold_vertices, "vertices are not manifold: their triangles form more than one fan");
  expect_none(t_junctions, "vertices are T-junctions: they lie inside an edge of another triangle");
  expect_none(unwelded_edges, "border edges lie on another one without being welded to it");
  if (!is_same_area(cells_plan, cells_valid))
    broken.push_back(
        fmt::format("The triangles cover {} cells in plan; {} cells are valid.", cells_plan, cells_valid));
  return broken;
}

}  // namespace tinsmith
