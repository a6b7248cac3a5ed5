#pragma once
// The rounds over all windows, in parallel.

#include <cstdint>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/compress.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

struct RoundsOptions {
  double tolerance = 0;  // vertical units of the field
  std::int32_t window = 256;
  Placement placement = Placement::kOptimal;
  Effort effort = Effort::kDefault;
};

/// Compresses a field. Must be called inside the task arena that limits the threads; the result does not
/// depend on how many there are. Fills the report's counts and times. Throws Interrupted when progress says so.
TerrainMesh run_rounds(const HeightField& field, const GridFrame& frame, const RoundsOptions& options,
                       const Progress& progress, CompressReport& report);

}  // namespace tinsmith
