#pragma once
// The star of a vertex that is about to be placed: what must hold where it goes, and which heights it may take
// there so that every sample under it stays within the tolerance ("feasible height", DESIGN section 4).

#include <limits>
#include <vector>

#include "geometry/lattice.hpp"
#include "geometry/triangle_rows.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// The side of a star's triangle opposite to its middle; (p, a, b) is counter-clockwise.
struct Side {
  Corner a;
  Corner b;
};
using Star = std::vector<Side>;

/// The heights of the middle vertex, relative to a reference, that all samples seen so far allow, with the
/// samples that set the two ends, and the sums that give the least-squares height.
struct HeightInterval {
  double lowest = -std::numeric_limits<double>::max();
  double highest = std::numeric_limits<double>::max();
  LatticePoint lowest_at;  // in samples
  LatticePoint highest_at;
  double sum_wr = 0;
  double sum_ww = 0;
  double sum_rr = 0;

  bool is_empty() const { return lowest > highest; }
  /// The least-squares height, held within the interval.
  double best() const;
  /// The sum of the samples' squared errors with this height.
  double squared_error(double height) const { return sum_rr + height * (height * sum_ww - 2 * sum_wr); }
};

/// A height of the middle vertex, relative to a reference, and the sums of the samples' squared errors with it and
/// with the reference itself.
struct HeightFit {
  double height = 0;
  double squared_error = 0;
  double squared_error_at_reference = 0;
  bool is_feasible = false;
};

/// How the squared error of a star changes with a step (x, y) of its middle in plan, in lattice units, when the
/// height is always the best one and the slopes of the triangles stay: half its gradient is (xx x + xy y - rx, xy x
/// + yy y - ry). (The Gauss-Newton step of a least-squares problem in x, y and z, with z eliminated.)
struct PlanSystem {
  double xx = 0, xy = 0, yy = 0;
  double rx = 0, ry = 0;
};

/// What the sweep measures against. Heights are taken relative to `reference`, for precision.
struct Bound {
  const HeightGrid& samples;
  double tolerance = 0;
  double reference = 0;
};

/// The heights that all samples under the star allow to a vertex at p; empty as soon as one contradicts. With the
/// weight w of the vertex at a sample, and the residual r of the sample over what the other corners bear there,
/// (r - tolerance) / w <= z_p <= (r + tolerance) / w. Between samples a vertex could be anywhere: it keeps to the
/// heights of the star's samples, give or take the tolerance, so that there are no spikes.
HeightInterval feasible_heights(const Star& star, const Bound& bound, LatticePoint p);

/// The least-squares height at p within those heights; not feasible when there are none or when the squared error
/// would not be below `limit`. Stops as soon as that is certain.
HeightFit fit_height(const Star& star, const Bound& bound, LatticePoint p, double limit);

/// The same without a limit, and where to go from p.
HeightFit fit_height(const Star& star, const Bound& bound, LatticePoint p, PlanSystem& system);

/// The same to the bit, with the instructions that every machine has.
HeightInterval feasible_heights_portable(const Star& star, const Bound& bound, LatticePoint p);
HeightFit fit_height_portable(const Star& star, const Bound& bound, LatticePoint p, double limit);
HeightFit fit_height_portable(const Star& star, const Bound& bound, LatticePoint p, PlanSystem& system);

/// Whether the two samples that set the ends of an earlier, empty interval alone leave no height at p either.
bool is_still_empty(const HeightInterval& earlier, const Star& star, const Bound& bound, LatticePoint p);

/// Half-space test, eq. 24 of the paper, in the horizontal plane: p strictly inside every side of the link.
bool is_in_kernel(const Star& star, LatticePoint p);

}  // namespace tinsmith
