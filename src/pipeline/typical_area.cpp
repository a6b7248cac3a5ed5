#include "pipeline/typical_area.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "stitch/window_task.hpp"
#include "triangulate/select.hpp"

namespace tinsmith {

namespace {

// Samples along the side of a block. A power of two and one, for the hierarchy.
constexpr std::int32_t kSide = 65;

// Blocks along a side of the field: one where it has so many samples, and not many. Together they are at most a
// seventh of it, and 1/49 of 16 million samples. But rasters give whole tiles: a plane of so many samples, in tiles
// of 256 x 256, takes 1.09 times as long (two threads) as without.
std::int32_t n_blocks(std::int32_t samples) {
  constexpr std::int32_t kSamplesPerBlock = 172;
  constexpr std::int32_t kMost = 9;
  return std::clamp(samples / kSamplesPerBlock, 1, kMost);
}

// The first sample of the block in the middle of the i-th of n parts.
std::int32_t first_sample(std::int32_t samples, std::int32_t i, std::int32_t n) {
  const std::int64_t middle = static_cast<std::int64_t>(samples) * (2 * i + 1) / (2 * n);
  return std::max(static_cast<std::int32_t>(middle) - kSide / 2, 0);
}

Leaves leaves_of(const HeightField& field, const GridRect& block, double tolerance) {
  if (field.is_surely_void(block)) return {};
  Selection selection{block, std::vector<std::uint8_t>(static_cast<std::size_t>(block.area()), 0)};
  const HeightGrid samples = field.read(block);
  return select_samples(samples, safe_tolerance(samples, tolerance), selection);
}

}  // namespace

double typical_area(const HeightField& field, double tolerance) {
  const std::int32_t columns = n_blocks(field.width());
  const std::int32_t rows = n_blocks(field.height());
  const std::int32_t width = std::min(kSide, field.width());
  const std::int32_t height = std::min(kSide, field.height());
  std::vector<Leaves> of_blocks(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  tbb::parallel_for(0, columns * rows, [&](std::int32_t i) {
    const GridRect block{first_sample(field.width(), i % columns, columns),
                         first_sample(field.height(), i / columns, rows), width, height};
    of_blocks[static_cast<std::size_t>(i)] = leaves_of(field, block, tolerance);
  });
  Leaves all;
  for (const Leaves& leaves : of_blocks) {
    all.n += leaves.n;
    all.sum_of_log2_areas += leaves.sum_of_log2_areas;
  }
  if (all.n == 0) return std::numeric_limits<double>::infinity();
  const double log2_area = static_cast<double>(all.sum_of_log2_areas) / static_cast<double>(all.n);
  // Between powers of two a straight line, which is the same on every machine.
  const double whole = std::floor(log2_area);
  return std::ldexp(1 + (log2_area - whole), static_cast<int>(whole));
}

}  // namespace tinsmith
