#pragma once
// How far the samples in a triangle are from its plane.

#include "geometry/triangle_rows.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// Vertical distances of the samples in or on a triangle, in the unit of the heights.
struct TriangleError {
  double largest = 0;
  LatticePoint worst;  // the sample with the largest, in samples; meaningless when that is 0
  double sum_of_squares = 0;
};

/// The corners are counter-clockwise, and every sample under the triangle is in `samples` and valid.
TriangleError triangle_error(const HeightGrid& samples, const Corner& a, const Corner& b, const Corner& c);

/// The same to the bit, with the instructions that every machine has.
TriangleError triangle_error_portable(const HeightGrid& samples, const Corner& a, const Corner& b, const Corner& c);

}  // namespace tinsmith
