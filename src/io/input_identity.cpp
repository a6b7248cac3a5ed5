#include "io/input_identity.hpp"

#include <cpl_vsi.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <utility>

namespace tinsmith {

namespace {

// Samples are taken from kBlocks x kBlocks places of kSide x kSide samples.
constexpr std::int32_t kBlocks = 4;
constexpr std::int32_t kSide = 16;

std::string file_line(const char* name, const std::string& path) {
  VSIStatBufL status;
  if (VSIStatL(path.c_str(), &status) != 0) return fmt::format("{}: {}", name, path);
  return fmt::format("{}: {}, {} bytes, of second {}", name, path, status.st_size, status.st_mtime);
}

// Rectangles all over a field.
std::vector<GridRect> places(const HeightField& field) {
  const auto start = [](std::int32_t i, std::int32_t size) {
    return static_cast<std::int32_t>(std::int64_t{std::max(size - kSide, 0)} * i / (kBlocks - 1));
  };
  std::vector<GridRect> rects;
  for (std::int32_t j = 0; j < kBlocks; ++j) {
    for (std::int32_t i = 0; i < kBlocks; ++i)
      rects.push_back({start(i, field.width()), start(j, field.height()), std::min(kSide, field.width()),
                       std::min(kSide, field.height())});
  }
  return rects;
}

std::uint64_t checksum_with(std::uint64_t checksum, HeightGrid&& grid) {
  // A void is any of many numbers that are none.
  std::replace_if(
      grid.z.begin(), grid.z.end(), [](double z) { return std::isnan(z); }, 1e300);
  return XXH3_64bits_withSeed(grid.z.data(), grid.z.size() * sizeof(double), checksum);
}

std::uint64_t checksum_of_samples(const HeightField& field) {
  std::uint64_t checksum = 0;
  for (const GridRect& rect : places(field)) {
    if (!field.is_surely_void(rect)) checksum = checksum_with(checksum, field.read(rect));
  }
  return checksum;
}

}  // namespace

std::vector<std::string> input_identity(const std::vector<std::string>& paths, const InputOptions& options,
                                        const HeightField& field) {
  std::vector<std::string> lines;
  lines.reserve(paths.size() + 5);
  for (const std::string& path : paths) lines.push_back(file_line("input", path));
  lines.push_back(fmt::format("band: {}", options.band));
  if (options.nodata) lines.push_back(fmt::format("nodata: {}", *options.nodata));
  if (options.bbox) lines.push_back(fmt::format("bbox: {}", fmt::join(*options.bbox, " ")));
  if (options.vertical_unit) lines.push_back(fmt::format("vertical unit: {} m", *options.vertical_unit));
  lines.push_back(
      fmt::format("samples: {} x {}, checksum {:016x}", field.width(), field.height(), checksum_of_samples(field)));
  return lines;
}

std::vector<std::string> colour_identity(const std::string& path, const ColourField& colours,
                                         const HeightField& field) {
  std::uint64_t checksum = 0;
  for (const GridRect& rect : places(field)) {
    ColourGrid grid = colours.read(rect);
    for (HeightGrid& channel : grid.channels) checksum = checksum_with(checksum, std::move(channel));
  }
  return {file_line("color", path),
          fmt::format("colors: {} channels, checksum {:016x}", colours.n_channels(), checksum)};
}

}  // namespace tinsmith
