#pragma once
// What a raster's layout in blocks costs those who read it window by window.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/raster_source.hpp"

namespace tinsmith {

/// The block that holds column x0 and row y0 of the raster; at its right and lower rim blocks are cut.
GridRect block_around(const RasterSource& source, std::int32_t x0, std::int32_t y0);

/// The samples that are decoded for a rectangle.
std::uint64_t decoded_samples(const RasterSource& source, const GridRect& rect);

/// The cache in bytes that decodes no block of the raster twice while one thread goes through a row of windows of
/// `window` samples from left to right.
std::uint64_t cache_for_row(const RasterSource& source, std::int32_t window);

/// The same for several rasters side by side and threads that work on neighbouring windows; more than is needed at
/// worst, never more than all of the rasters for each dataset that they may have open.
std::uint64_t cache_for_row(const std::vector<RasterSource>& sources, std::int32_t window, int threads);

/// Whether such a row needs so much that all threads should share it: whole-row strips of a wide raster.
bool is_costly_in_windows(const RasterSource& source);

/// Names the first raster that is, how many others are, and the remedy; none when none is.
std::optional<std::string> remark_on_blocks(const std::vector<RasterSource>& sources);

}  // namespace tinsmith
