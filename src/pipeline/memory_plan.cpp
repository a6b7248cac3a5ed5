#include "pipeline/memory_plan.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>

#include "base/machine_memory.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

constexpr std::uint64_t kMega = 1 << 20;
constexpr std::uint64_t kOwn = 60 * kMega;
constexpr std::uint64_t kLeast = 16 * kMega;  // of the cache, and for chunks
// Of a window at work: by count 206 bytes a vertex of the start mesh, at worst one a sample; its samples, which
// reach beyond it in later rounds; and what the allocator keeps between windows.
constexpr std::uint64_t kBytesPerSample = 450;

// Colours: levels as they are warped and read, and with each vertex of the mesh, its chunk and the star at work.
std::uint64_t bytes_per_sample(int n_channels) {
  return kBytesPerSample + (n_channels > 0 ? 100 + 20 * static_cast<std::uint64_t>(n_channels) : 0);
}

// What decodes each block once: the whole raster, where that is little, as what is read before the first window
// (input_identity(), typical_area()) lies all over it; else whole rows of windows, as later rounds read a row anew,
// one and a half rows after the first, and blocks reach into the next row. Generated mountains of 64 million
// samples, at 100 m and two threads, take half the time of a cache for neighbouring windows, which decodes each
// block five to six times; half of these rows are as good as nothing. For wider rasters than kMostForRows it is
// neighbours again: what a run takes must not grow with the raster.
std::uint64_t raster_cache(const RasterField& field, std::int32_t window, int threads, std::uint64_t most) {
  constexpr std::int64_t kRows = 5;
  constexpr std::uint64_t kMostForRows = 64 * kMega;
  std::uint64_t wanted = 3 * field.cache_for((std::int64_t{threads} + 1) * window, window);
  for (const std::int64_t rows : {std::int64_t{field.height()}, kRows * window}) {
    const std::uint64_t of_rows = field.cache_for(field.width(), rows);
    if (of_rows > std::min(most, kMostForRows)) continue;
    wanted = of_rows;
    break;
  }
  return std::clamp(wanted, kLeast, most);
}

std::string in_megabytes(std::uint64_t bytes) {
  return bytes < kMega ? fmt::format("{} bytes", bytes) : fmt::format("{}M", (bytes + kMega - 1) / kMega);
}

}  // namespace

MemoryPlan plan_memory(const RasterField& field, const MemoryNeeds& needs) {
  const auto [window, asked, memory, n_channels] = needs;
  MemoryPlan plan;
  plan.total = memory > 0 ? memory : machine_memory() / 4;
  plan.own = kOwn;
  const std::uint64_t side = static_cast<std::uint64_t>(window) + 3;
  const std::uint64_t samples = std::min(side, static_cast<std::uint64_t>(field.width())) *
                                std::min(side, static_cast<std::uint64_t>(field.height()));
  const std::uint64_t of_window = samples * bytes_per_sample(n_channels);
  const std::uint64_t besides = plan.own + 2 * kLeast;
  plan.threads = asked > 0 ? asked : tbb::info::default_concurrency();
  while (asked == 0 && plan.threads > 1 &&
         besides + static_cast<std::uint64_t>(plan.threads) * of_window > plan.total)
    --plan.threads;
  plan.windows = static_cast<std::uint64_t>(plan.threads) * of_window;
  if (plan.total < besides + plan.windows)
    throw ResourceError(fmt::format(
        "{} of memory are too little for {} window{} of {} x {} samples at a time, which need {}; give more "
        "with --memory, or {}a smaller --window",
        in_megabytes(plan.total), plan.threads, plan.threads == 1 ? "" : "s", window, window,
        in_megabytes(besides + plan.windows), plan.threads == 1 ? "" : "fewer --threads, or "));
  const std::uint64_t rest = plan.total - plan.own - plan.windows;
  plan.raster_cache = raster_cache(field, window, plan.threads, rest / 2);
  plan.chunks = std::min(rest - plan.raster_cache, rest / 2);
  return plan;
}

}  // namespace tinsmith
