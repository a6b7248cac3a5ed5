#pragma once
// Every sample against the triangles over it.

#include <cstdint>

#include "geodesy/grid_frame.hpp"
#include "judge/plan_mesh.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/certificate.hpp"
#include "tinsmith/progress.hpp"

namespace tinsmith {

/// The raster that a mesh is judged against, and how: band by band, so that it need not fit in memory.
struct Samples {
  const HeightField& field;
  const GridFrame& frame;
  std::int32_t band_rows = 0;  // 0: about a million samples in a band
  Progress progress;
};

/// Fills all that is counted by samples and cells: coverage, errors, the valid area, the rounding. A sample is
/// in a triangle when it is no farther than the epsilon outside any edge, strictly when it is farther than the
/// epsilon inside all. Where several triangles have a sample its largest error counts.
void measure_coverage(const PlanMesh& mesh, const Samples& samples, Certificate& certificate);

}  // namespace tinsmith
