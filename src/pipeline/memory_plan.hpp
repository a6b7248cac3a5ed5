#pragma once
// Who gets how much of the memory.

#include <cstdint>

#include "io/raster_field.hpp"

namespace tinsmith {

/// All in bytes.
struct MemoryPlan {
  std::uint64_t total = 0;
  int threads = 1;                 // windows at a time: as many as were asked for, or as the memory holds
  std::uint64_t own = 0;           // the program with its libraries
  std::uint64_t windows = 0;       // samples and meshes of the windows at work
  std::uint64_t raster_cache = 0;  // GDAL's, for decoded blocks
  std::uint64_t chunks = 0;        // finished windows, before they are left to the disk
};

struct MemoryNeeds {
  std::int32_t window = 0;   // samples along its side
  int threads = 0;           // windows at a time; 0: as many as there are processors, or fewer if that takes it
  std::uint64_t memory = 0;  // bytes in all; 0: a quarter of the machine's
  int n_channels = 0;        // of colour
};

/// Throws ResourceError when the memory can't suffice.
MemoryPlan plan_memory(const RasterField& field, const MemoryNeeds& needs);

}  // namespace tinsmith
