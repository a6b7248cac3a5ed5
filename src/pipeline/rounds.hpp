#pragma once
// The rounds over all windows, in parallel.

#include <cstdint>
#include <memory>
#include <string>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "samples/colour_grid.hpp"
#include "samples/height_grid.hpp"
#include "stitch/window_task.hpp"
#include "tinsmith/compress.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

struct RoundsOptions {
  double tolerance = 0;  // vertical units of the field
  std::int32_t window = 192;
  Placement placement = Placement::kOptimal;
  Effort effort = Effort::kDefault;
  std::string folder{};                  // where finished windows are kept, there already; empty: in memory only
  std::uint64_t chunk_memory = 1 << 26;  // bytes for chunks when there is a folder
  const ColourField* colours = nullptr;  // to drape the surface with, on the grid of the field; null: none
  ColourOptions colour{};
};

/// What the tasks on a window are done with; `area` is the field's typical_area().
WindowOptions window_options(const GridFrame& frame, const GridRect& window, const RoundsOptions& options,
                             double area);

/// Compresses a field; goes on from what an earlier run with the same options left in the folder. Must be called
/// inside the task arena that limits the threads; the result does not depend on how many there are. Fills the
/// report's counts and times. The surface keeps what it needs but for the folder. Throws Interrupted when progress
/// says so, OutputError when the folder can't be written.
std::shared_ptr<const TerrainSurface> run_rounds(const HeightField& field, const GridFrame& frame,
                                                 const RoundsOptions& options, const Progress& progress,
                                                 CompressReport& report);

}  // namespace tinsmith
