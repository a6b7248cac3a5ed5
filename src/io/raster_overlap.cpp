#include "io/raster_overlap.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/raster_blocks.hpp"
#include "samples/grid_rect.hpp"

namespace tinsmith {
namespace {

constexpr std::uint64_t kUsualBudget = std::uint64_t{1} << 28;  // decoded samples: seconds
constexpr std::uint64_t kShare = 16;                            // of a pass over the inputs
constexpr std::uint64_t kMaxPairs = 65536;                      // of a stack of thousands: each costs a millisecond
constexpr std::int32_t kMinBand = 16;                           // rows that are read at once or not at all
constexpr std::int64_t kChunk = 1 << 20;                        // samples in memory

// Heights written as floats by one program and as doubles by another still agree.
bool differ(double a, double b) {
  constexpr double kRounding = std::numeric_limits<float>::epsilon();
  return std::abs(a - b) > kRounding * std::max(std::abs(a), std::abs(b));
}

struct Comparison {
  const RasterInputs& inputs;
  const RasterIndex& index;
  const Mosaic& mosaic;
};

GridRect in_file(const GridRect& rect, const GridRect& place) {
  return {rect.x0 - place.x0, rect.y0 - place.y0, rect.width, rect.height};
}

// Calls function(a, b, where both lie).
template <typename Function>
void for_each_pair(const Comparison& all, Function function) {
  const auto& places = all.mosaic.places;
  const GridRect whole{0, 0, all.mosaic.width, all.mosaic.height};
  for (std::size_t a = 0; a < places.size(); ++a) {
    const GridRect inside = intersection(places[a], whole);
    for (const std::uint32_t b : all.index.touching(inside)) {
      if (b > a) function(a, b, intersection(inside, places[b]));
    }
  }
}

void compare_part(const Comparison& all, const GridRect& part, OverlapCheck& check) {
  const auto& places = all.mosaic.places;
  const std::vector<double> za = all.inputs.read(check.a, in_file(part, places[check.a]));
  const std::vector<double> zb = all.inputs.read(check.b, in_file(part, places[check.b]));
  if (za.empty() || zb.empty()) return;
  for (std::size_t i = 0; i < za.size(); ++i) {
    if (std::isnan(za[i]) || std::isnan(zb[i])) continue;
    ++check.n_compared;
    if (!differ(za[i], zb[i])) continue;
    ++check.n_differing;
    if (std::abs(za[i] - zb[i]) <= check.largest) continue;
    check.largest = std::abs(za[i] - zb[i]);
    check.column = part.x0 + static_cast<std::int32_t>(i % static_cast<std::size_t>(part.width));
    check.row = part.y0 + static_cast<std::int32_t>(i / static_cast<std::size_t>(part.width));
  }
}

void compare_rows(const Comparison& all, const GridRect& rows, OverlapCheck& check) {
  const auto n = static_cast<std::int32_t>(std::max<std::int64_t>(1, kChunk / rows.width));
  for (std::int64_t y = rows.y0; y < static_cast<std::int64_t>(rows.y0) + rows.height; y += n) {
    const auto height = static_cast<std::int32_t>(std::min<std::int64_t>(n, rows.y0 + rows.height - y));
    compare_part(all, {rows.x0, static_cast<std::int32_t>(y), rows.width, height}, check);
  }
}

std::uint64_t cost_of(const Comparison& all, const OverlapCheck& pair, const GridRect& overlap) {
  const auto& places = all.mosaic.places;
  return decoded_samples(all.inputs.sources()[pair.a], in_file(overlap, places[pair.a])) +
         decoded_samples(all.inputs.sources()[pair.b], in_file(overlap, places[pair.b]));
}

// Bands of rows as high as the blocks, so that a band left out is a block not decoded.
void compare_pair(const Comparison& all, const GridRect& overlap, std::uint64_t budget, OverlapCheck& check) {
  const auto& sources = all.inputs.sources();
  const std::uint64_t step = (cost_of(all, check, overlap) + budget - 1) / budget;
  if (step <= 1) return compare_rows(all, overlap, check);
  const std::int64_t band = std::max({kMinBand, sources[check.a].block_height, sources[check.b].block_height});
  const std::int64_t last = static_cast<std::int64_t>(overlap.y0) + overlap.height;
  for (std::int64_t y = overlap.y0; y < last; y += band * static_cast<std::int64_t>(step)) {
    const auto height = static_cast<std::int32_t>(std::min(band, last - y));
    compare_rows(all, {overlap.x0, static_cast<std::int32_t>(y), overlap.width, height}, check);
  }
}

struct Plan {
  std::uint64_t n_pairs = 0;
  std::uint64_t pair_step = 1;    // every so manieth is compared
  std::uint64_t pair_budget = 1;  // decoded samples
  bool is_partial = false;
};

Plan plan(const Comparison& all) {
  Plan result;
  std::uint64_t dearest = 0;
  for_each_pair(all, [&](std::size_t a, std::size_t b, const GridRect& overlap) {
    ++result.n_pairs;
    dearest = std::max(dearest, cost_of(all, {a, b}, overlap));
  });
  if (result.n_pairs == 0) return result;
  std::uint64_t n_samples = 0;
  for (const GridRect& place : all.mosaic.places) n_samples += static_cast<std::uint64_t>(place.area());
  result.pair_step = (result.n_pairs + kMaxPairs - 1) / kMaxPairs;
  result.pair_budget =
      std::max(kUsualBudget, n_samples / kShare) / ((result.n_pairs + result.pair_step - 1) / result.pair_step);
  result.is_partial = result.pair_step > 1 || dearest > result.pair_budget;
  return result;
}

}  // namespace

OverlapReport compare_overlaps(const RasterInputs& inputs, const RasterIndex& index, const Mosaic& mosaic) {
  const Comparison all{inputs, index, mosaic};
  const Plan planned = plan(all);
  OverlapReport report;
  report.is_partial = planned.is_partial;
  if (planned.n_pairs == 0) return report;
  for_each_pair(all, [&](std::size_t a, std::size_t b, const GridRect& overlap) {
    if (report.n_pairs++ % planned.pair_step != 0) return;
    OverlapCheck check{a, b};
    compare_pair(all, overlap, planned.pair_budget, check);
    ++report.n_compared_pairs;
    if (check.n_differing > 0) ++report.n_differing_pairs;
    if (check.largest > report.worst.largest) report.worst = check;
  });
  return report;
}

std::optional<std::string> remark_on_overlaps(const OverlapReport& report, const RasterInputs& inputs,
                                              const GridFrame& frame) {
  if (report.n_differing_pairs == 0) return std::nullopt;
  const OverlapCheck& worst = report.worst;
  const auto [x, y] = frame.to_crs(worst.column, worst.row);
  const std::string compared = report.is_partial
                                   ? fmt::format(" ({} of {} overlaps were compared, large ones in part)",
                                                 report.n_compared_pairs, report.n_pairs)
                                   : "";
  return fmt::format(
      "{} and {} disagree where they overlap: {} of {} samples, by up to {:.6g} m at {} {}; {} of {} such pairs of "
      "inputs disagree{}; --overlap says which one counts",
      inputs.sources()[worst.a].path, inputs.sources()[worst.b].path, worst.n_differing, worst.n_compared,
      worst.largest * frame.metres_per_vertical_unit, x, y, report.n_differing_pairs, report.n_compared_pairs,
      compared);
}

}  // namespace tinsmith
