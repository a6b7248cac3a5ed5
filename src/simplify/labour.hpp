#pragma once
// How hard simplify() tries, and what it may do for it.

#include <limits>

#include "tinsmith/options.hpp"

namespace tinsmith {

/// How hard to try.
struct Labour {
  static constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  // Rounds of vertex moves, flips and further collapses after the first pass, then one without.
  int refinements = 0;
  // Edges whose mean squared quadric error is more than this times the squared tolerance are not tried.
  double patience = kNoLimit;
  // Nor may the root of the mean squared error over a new star be more than this times the tolerance.
  double roughness = kNoLimit;
};

Labour labour_of(Effort effort);

}  // namespace tinsmith
