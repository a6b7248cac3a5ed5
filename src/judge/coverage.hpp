#pragma once
// The samples of a block against the triangles over them.

#include <span>

#include "geodesy/grid_frame.hpp"
#include "judge/findings.hpp"
#include "judge/plan.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// Adds all that is counted by samples and cells: coverage, errors, the valid area. A sample is in a triangle
/// when it is no farther than the epsilon outside any edge, strictly when it is farther than the epsilon inside
/// all. Where several triangles have a sample its largest error counts. A cell belongs to the block of its upper
/// left sample. The facets are at least those that touch one of the samples.
void measure_coverage(const GridRect& samples, std::span<const Facet> facets, const HeightField& field,
                      const GridFrame& frame, Findings& findings);

}  // namespace tinsmith
