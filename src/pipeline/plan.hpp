#pragma once
// What a run finds out before it starts.

#include <cstdint>
#include <string>
#include <vector>

#include "io/raster_field.hpp"
#include "pipeline/memory_plan.hpp"
#include "samples/colour_grid.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

struct RunToPlan {
  const RasterField& field;
  const std::string& output;
  const CompressOptions& options;
  const ColourField* colours;  // of the vertices; null: none
  const MemoryPlan& memory;
};

/// Throws ResourceError when the output's format, or the room on the disks, is certain not to suffice; gives a
/// sentence for each place where it may not. Tries a few windows for that, and nothing when the full grid fits.
/// `work_there`: see require_room.
std::vector<std::string> require_result_may_fit(const RunToPlan& run, std::uint64_t work_there);

}  // namespace tinsmith
