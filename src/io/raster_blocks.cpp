#include "io/raster_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tinsmith {
namespace {

constexpr std::int64_t kUsualWindow = 192;

// Blocks that a VRT says it has are often smaller than those of its sources.
constexpr std::int32_t kLeastStripe = 256;

// Strips of 65536 floats: twice of anything that is published as one strip-wise tile of a DEM.
constexpr std::uint64_t kCostlyRow = std::uint64_t{64} << 20;

std::int64_t n_blocks(std::int64_t first, std::int64_t size, std::int64_t block) {
  return (first + size - 1) / block - first / block + 1;
}

// The samples of the blocks that n samples along a side touch at worst, but no more than there are.
std::uint64_t touched(std::int64_t n, std::int64_t block, std::int64_t side) {
  const std::int64_t n_at_worst = (n + block - 2) / block + 1;
  const std::int64_t n_there = (side + block - 1) / block;
  return static_cast<std::uint64_t>(std::min(n_at_worst, n_there) * block);
}

}  // namespace

GridRect block_around(const RasterSource& source, std::int32_t x0, std::int32_t y0) {
  const std::int32_t x = x0 / source.block_width * source.block_width;
  const std::int32_t y = y0 / source.block_height * source.block_height;
  return {x, y, std::min(source.block_width, source.width - x), std::min(source.block_height, source.height - y)};
}

std::uint64_t decoded_samples(const RasterSource& source, const GridRect& rect) {
  const std::int64_t columns = n_blocks(rect.x0, rect.width, source.block_width) * source.block_width;
  const std::int64_t rows = n_blocks(rect.y0, rect.height, source.block_height) * source.block_height;
  return static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
}

std::vector<StripePart> stripes_of(const RasterSource& source, const GridRect& rect) {
  const std::int64_t block = source.block_width;
  const std::int64_t width = (std::max<std::int64_t>(kLeastStripe, block) + block - 1) / block * block;
  const std::int64_t end = std::int64_t{rect.x0} + rect.width;
  std::vector<StripePart> parts;
  for (std::int64_t x = rect.x0; x < end;) {
    const std::int64_t column = x / width;
    const std::int64_t next = std::min(end, (column + 1) * width);
    parts.push_back({static_cast<std::size_t>(column) % kStripes,
                     {static_cast<std::int32_t>(x), rect.y0, static_cast<std::int32_t>(next - x), rect.height}});
    x = next;
  }
  return parts;
}

std::uint64_t cache_for(const RasterSource& source, std::int64_t width, std::int64_t height) {
  const auto bytes = static_cast<std::uint64_t>(GDALGetDataTypeSizeBytes(source.type));
  return touched(width, source.block_width, source.width) * touched(height, source.block_height, source.height) *
         bytes;
}

std::uint64_t cache_for(const std::vector<RasterSource>& sources, std::int64_t width, std::int64_t height) {
  std::uint64_t most = 0;
  std::int64_t least_width = width;
  std::int64_t least_height = height;
  for (const RasterSource& source : sources) {
    most = std::max(most, cache_for(source, width, height));
    least_width = std::min<std::int64_t>(least_width, source.width);
    least_height = std::min<std::int64_t>(least_height, source.height);
  }
  // The rasters that a rectangle touches, were all as small as the smallest.
  const std::uint64_t n_touched =
      touched(width, least_width, width + 2 * least_width) / static_cast<std::uint64_t>(least_width) *
      (touched(height, least_height, height + 2 * least_height) / static_cast<std::uint64_t>(least_height));
  return most * std::min<std::uint64_t>(n_touched, sources.size());
}

bool is_costly_in_windows(const RasterSource& source) {
  return cache_for(source, 2 * kUsualWindow, kUsualWindow) > kCostlyRow;
}

std::optional<std::string> remark_on_blocks(const std::vector<RasterSource>& sources) {
  const auto first = std::find_if(sources.begin(), sources.end(), is_costly_in_windows);
  if (first == sources.end()) return std::nullopt;
  const auto n_others = std::count_if(first + 1, sources.end(), is_costly_in_windows);
  const std::string others = n_others > 0 ? fmt::format(" (and {} others)", n_others) : "";
  return fmt::format(
      "{}{} is stored in blocks of {} x {}, slow to read in windows and costly in memory; convert it with "
      "gdal_translate -co TILED=YES",
      first->path, others, first->block_width, first->block_height);
}

}  // namespace tinsmith
