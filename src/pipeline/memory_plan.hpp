#pragma once
// Who gets how much of the memory.

#include <cstdint>

#include "io/raster_field.hpp"

namespace tinsmith {

/// All in bytes.
struct MemoryPlan {
  std::uint64_t total = 0;
  std::uint64_t own = 0;           // the program with its libraries
  std::uint64_t windows = 0;       // samples and meshes of the windows at work
  std::uint64_t raster_cache = 0;  // GDAL's, for decoded blocks
  std::uint64_t chunks = 0;        // finished windows, before they are left to the disk
};

/// `memory` 0: a quarter of the machine's. Throws ResourceError when it can't suffice.
MemoryPlan plan_memory(const RasterField& field, std::int32_t window, int threads, std::uint64_t memory);

}  // namespace tinsmith
