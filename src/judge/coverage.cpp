#include "judge/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "judge/facet_samples.hpp"

namespace tinsmith {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// What the triangles do to the samples of a block.
struct Coverage {
  GridRect rect;
  HeightGrid heights;                  // with a sample more on each side: all cells about the samples
  std::vector<double> error;           // z_TIN - z_sample, the largest; kNone: in no triangle
  std::vector<std::uint8_t> n_inside;  // triangles that have the sample strictly inside, 2 stands for more

  std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y - rect.y0) * static_cast<std::size_t>(rect.width) +
           static_cast<std::size_t>(x - rect.x0);
  }
  /// Row y of the heights, from one column before the block.
  const double* row(std::int32_t y) const {
    return heights.z.data() +
           static_cast<std::size_t>(y - rect.y0 + 1) * (static_cast<std::size_t>(rect.width) + 2);
  }
};

Coverage read_samples(const HeightField& field, const GridRect& rect) {
  const auto n = static_cast<std::size_t>(rect.area());
  return {rect, field.read({rect.x0 - 1, rect.y0 - 1, rect.width + 2, rect.height + 2}),
          std::vector<double>(n, kNone), std::vector<std::uint8_t>(n, 0)};
}

// ---- triangles over samples

void record(Coverage& coverage, std::int32_t x, std::int32_t y, double z, bool is_strict) {
  const std::size_t i = coverage.index(x, y);
  if (is_strict && coverage.n_inside[i] < 2) ++coverage.n_inside[i];
  const double error = z - coverage.row(y)[x + 1 - coverage.rect.x0];
  if (!(std::abs(error) <= std::abs(coverage.error[i])) && !std::isnan(error)) coverage.error[i] = error;
}

/// Records the triangle at all samples of the block that lie in it.
void cover(const Facet& facet, Coverage& coverage) {
  for_each_sample_in(
      facet, coverage.rect, [&](std::int32_t x, std::int32_t y, const CornerWeights& corners, bool is_strict) {
        record(coverage, x, y, corners.mean([&](std::size_t k) { return facet.height[k]; }), is_strict);
      });
}

// ---- statistics

/// Whether cell (x, y), from (x, y) to (x + 1, y + 1), has four valid samples, from one column before the block.
std::vector<std::uint8_t> valid_cells(const Coverage& coverage, std::int32_t y) {
  const double* const upper = coverage.row(y);
  const double* const lower = coverage.row(y + 1);
  std::vector<std::uint8_t> valid(static_cast<std::size_t>(coverage.rect.width) + 1);
  for (std::size_t i = 0; i < valid.size(); ++i)
    valid[i] = !std::isnan(upper[i] + upper[i + 1] + lower[i] + lower[i + 1]);
  return valid;
}

/// Adds n times the area, without rounding the product: a run of cells counts the same whole or in parts.
void add_product(double n, double area, ExactSum& sum) {
  const double product = n * area;
  sum.add(product);
  sum.add(std::fma(n, area, -product));
}

/// Which cells below row y are valid, from the column before the rectangle.
struct CellRow {
  const std::vector<std::uint8_t>& cells;
  const GridRect& rect;
  std::int32_t y;
};

/// The scale is taken anew every 64 columns, over which it does not change enough to be seen.
void add_valid_area(const CellRow& row, const HeightField& field, const GridFrame& frame, Findings& findings) {
  constexpr std::int32_t kRun = 64;
  const auto& [cells, rect, y] = row;
  for (std::int32_t x = rect.x0; x < rect.x0 + rect.width;) {
    const std::int32_t run = x / kRun * kRun;
    const std::int32_t run_end = std::min(run + kRun, field.width());
    const std::int32_t end = std::min(run_end, rect.x0 + rect.width);
    double n = 0;
    for (; x < end; ++x) {
      const std::int32_t i = x - rect.x0 + 1;
      n += cells[static_cast<std::size_t>(i)];
    }
    if (n == 0) continue;
    findings.cells_valid.add(n);
    add_product(n, cell_area(frame, (run + double{0} + run_end) / 2, y + 0.5), findings.area_valid);
  }
}

void add_sample(const Coverage& coverage, std::int32_t x, std::int32_t y, bool is_coverable, Findings& findings) {
  const std::size_t i = coverage.index(x, y);
  const double z = coverage.row(y)[x + 1 - coverage.rect.x0];
  if (std::isnan(z)) {
    if (coverage.n_inside[i] > 0) ++findings.counts.voids_covered;
    return;
  }
  ++findings.counts.samples;
  findings.largest_height = std::max(findings.largest_height, std::abs(z));
  if (coverage.n_inside[i] > 1) ++findings.counts.overlapped;
  const bool is_covered = !std::isnan(coverage.error[i]);
  if (is_coverable) ++(is_covered ? findings.counts.covered : findings.counts.uncovered);
  if (is_covered) findings.add_error(coverage.error[i], x, y);
}

}  // namespace

void measure_coverage(const GridRect& samples, std::span<const Facet> facets, const HeightField& field,
                      const GridFrame& frame, Findings& findings) {
  Coverage coverage = read_samples(field, samples);
  for (const Facet& facet : facets) cover(facet, coverage);
  std::vector<std::uint8_t> above = valid_cells(coverage, samples.y0 - 1);
  for (std::int32_t y = samples.y0; y < samples.y0 + samples.height; ++y) {
    std::vector<std::uint8_t> below = valid_cells(coverage, y);
    add_valid_area({below, samples, y}, field, frame, findings);
    for (std::int32_t x = samples.x0; x < samples.x0 + samples.width; ++x) {
      const auto left = static_cast<std::size_t>(x - samples.x0);
      add_sample(coverage, x, y, above[left] + above[left + 1] + below[left] + below[left + 1] > 0, findings);
    }
    above = std::move(below);
  }
}

}  // namespace tinsmith
