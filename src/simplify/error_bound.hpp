#pragma once
// The error bound: which heights a new vertex may take so that every sample under its star stays within the
// tolerance ("feasible height", DESIGN section 4).

#include <limits>

#include "geometry/lattice.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// A vertex of the mesh as the sweep needs it.
struct Corner {
  LatticePoint position;
  double height = 0;
};

/// The heights of a new vertex, relative to a reference, that all samples seen so far allow, and the sums
/// whose quotient is the height with the least squared error over them.
struct HeightInterval {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  double sum_wr = 0;
  double sum_ww = 0;

  bool is_empty() const { return lowest > highest; }
};

/// What the sweep measures against. Heights are taken relative to `reference`, for precision.
struct Bound {
  const HeightGrid& samples;
  double tolerance = 0;
  double reference = 0;
};

/// Narrows the interval by the samples in the triangle (p, a, b), p being the new vertex: with the weight w of
/// p at a sample and the residual r of the sample over the part that a and b bear,
/// (r - tolerance) / w <= z_p <= (r + tolerance) / w. Stops early and
/// returns false when the interval is empty.
bool narrow(HeightInterval& interval, const Bound& bound, LatticePoint p, const Corner& a, const Corner& b);

}  // namespace tinsmith
