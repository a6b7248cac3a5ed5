#pragma once
// Samples of a window -> TIN (DESIGN section 1, steps 2 and 3).

#include "mesh/window_mesh.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

struct TriangulateOptions {
  double tolerance = 0;  // vertical units: no sample is farther than this from the triangulation
  double aspect = 1;     // metres between rows / metres between columns
};

/// The constrained Delaunay triangulation of the samples that a surface within the tolerance needs, bounded by
/// the exact outline of the window's valid cells; of a window of more than 96 cells a side, one for each of its
/// parts, whose common lines are edges. Every vertex is a sample. The vertices on the window's border depend on the
/// samples of that border only, so that neighbours agree. `samples` must reach one sample beyond the window on each
/// side (void outside the raster). Kinds are not set. A window without a valid cell gives an empty mesh.
WindowMesh triangulate(const HeightGrid& samples, const GridRect& window, const TriangulateOptions& options);

}  // namespace tinsmith
