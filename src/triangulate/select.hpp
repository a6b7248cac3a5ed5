#pragma once
// Which samples a surface within a fraction of the tolerance needs, found top down: right-triangulated
// hierarchy by newest-vertex bisection (Evans, Kirkpatrick, Townsend 2001), with the true error of each
// triangle over its samples instead of nested estimates.

#include <cstdint>
#include <vector>

#include "geometry/lattice.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// Marks of a window's samples, row by row like the window.
struct Selection {
  GridRect window;
  std::vector<std::uint8_t> is_selected;

  std::uint8_t& at(std::int32_t x, std::int32_t y) {
    return is_selected[static_cast<std::size_t>(y - window.y0) * static_cast<std::size_t>(window.width) +
                       static_cast<std::size_t>(x - window.x0)];
  }
};

/// The triangles that the hierarchy ends with, but for those outside the window and those of voids. Areas, in
/// cells, are powers of two.
struct Leaves {
  std::int64_t n = 0;
  std::int64_t sum_of_log2_areas = 0;
};

/// Marks the valid samples at which the hierarchy splits a triangle that has a sample farther than the tolerance
/// from its plane, or voids and valid samples both. The triangles are not conforming and not returned: it is the
/// samples that count, and the window's corners belong to them without a mark.
Leaves select_samples(const HeightGrid& samples, double tolerance, Selection& selection);

/// Marks on the straight line from sample a to sample b (on one row or column, both included) the samples that
/// a polyline within the tolerance needs: Douglas and Peucker's rule, which sees the line's own samples only,
/// so that the windows on both sides mark the same ones.
void select_on_line(const HeightGrid& samples, double tolerance, LatticePoint a, LatticePoint b,
                    Selection& selection);

}  // namespace tinsmith
