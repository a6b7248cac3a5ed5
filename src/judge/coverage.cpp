#include "judge/coverage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

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

/// The side on which a triangle lies of one of its edges: value(x, y) = length times the distance inside.
struct Side {
  Side(const PlanPoint& from, const PlanPoint& to)
      : start(from), nx(from.y - to.y), ny(to.x - from.x), slack(kPlanEpsilon * std::hypot(nx, ny)) {}
  double value(double x, double y) const { return nx * (x - start.x) + ny * (y - start.y); }

  PlanPoint start;
  double nx, ny;  // inward normal, as long as the edge
  double slack;
};

struct Slope {
  PlanPoint a, b, c;  // counter-clockwise in the grid
  double za, zb, zc;
};

Slope slope_of(const Facet& facet) {
  auto [i, j, k] = std::array<std::size_t, 3>{0, 1, 2};
  const auto& [a, b, c] = facet.position;
  if (doubled_area(a, b, c) < 0) std::swap(j, k);
  return {facet.position[i], facet.position[j], facet.position[k],
          facet.height[i],   facet.height[j],   facet.height[k]};
}

struct Span {
  std::int32_t first;
  std::int32_t last;  // smaller when empty
};

/// Whole numbers within [low, high] and [least, most].
Span whole_within(double low, double high, std::int32_t least, std::int32_t most) {
  return {static_cast<std::int32_t>(std::clamp(std::ceil(low), double{0} + least, most + 1.0)),
          static_cast<std::int32_t>(std::clamp(std::floor(high), least - 1.0, double{0} + most))};
}

/// The columns that may lie in the triangle on a row: at least all that do.
Span columns_of(const Slope& f, const std::array<Side, 3>& sides, double y, const GridRect& rect) {
  double low = std::min({f.a.x, f.b.x, f.c.x});
  double high = std::max({f.a.x, f.b.x, f.c.x});
  for (const Side& side : sides) {
    if (side.nx == 0) continue;
    const double x = side.start.x - (side.ny * (y - side.start.y) + side.slack) / side.nx;
    if (side.nx > 0) low = std::max(low, x);
    if (side.nx < 0) high = std::min(high, x);
  }
  return whole_within(low - kPlanEpsilon, high + kPlanEpsilon, rect.x0, rect.x0 + rect.width - 1);
}

void record(Coverage& coverage, std::int32_t x, std::int32_t y, double z, bool is_strict) {
  const std::size_t i = coverage.index(x, y);
  if (is_strict && coverage.n_inside[i] < 2) ++coverage.n_inside[i];
  const double error = z - coverage.row(y)[x + 1 - coverage.rect.x0];
  if (!(std::abs(error) <= std::abs(coverage.error[i])) && !std::isnan(error)) coverage.error[i] = error;
}

/// Records the triangle at all samples of the block that lie in it.
void cover(const Facet& facet, Coverage& coverage) {
  const Slope f = slope_of(facet);
  if (!(doubled_area(f.a, f.b, f.c) > 0)) return;
  const std::array<Side, 3> sides{Side(f.b, f.c), Side(f.c, f.a), Side(f.a, f.b)};  // opposite a, b, c
  const Span rows =
      whole_within(std::min({f.a.y, f.b.y, f.c.y}) - kPlanEpsilon, std::max({f.a.y, f.b.y, f.c.y}) + kPlanEpsilon,
                   coverage.rect.y0, coverage.rect.y0 + coverage.rect.height - 1);
  for (std::int32_t y = rows.first; y <= rows.last; ++y) {
    const Span columns = columns_of(f, sides, y, coverage.rect);
    for (std::int32_t x = columns.first; x <= columns.last; ++x) {
      const double ea = sides[0].value(x, y);
      const double eb = sides[1].value(x, y);
      const double ec = sides[2].value(x, y);
      if (ea < -sides[0].slack || eb < -sides[1].slack || ec < -sides[2].slack) continue;
      // Within the slack outside an edge the height is that of the edge: nothing is extrapolated.
      const double wa = std::max(ea, 0.0);
      const double wb = std::max(eb, 0.0);
      const double wc = std::max(ec, 0.0);
      record(coverage, x, y, (wa * f.za + wb * f.zb + wc * f.zc) / (wa + wb + wc),
             ea > sides[0].slack && eb > sides[1].slack && ec > sides[2].slack);
    }
  }
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

/// The scale is taken anew every 64 columns, over which it does not change enough to be seen.
void add_valid_area(const std::vector<std::uint8_t>& cells, const GridRect& rect, std::int32_t y,
                    const HeightField& field, const GridFrame& frame, Findings& findings) {
  constexpr std::int32_t kRun = 64;
  for (std::int32_t x = rect.x0; x < rect.x0 + rect.width;) {
    const std::int32_t run = x / kRun * kRun;
    const std::int32_t run_end = std::min(run + kRun, field.width());
    const std::int32_t end = std::min(run_end, rect.x0 + rect.width);
    double n = 0;
    for (; x < end; ++x) n += cells[static_cast<std::size_t>(x - rect.x0 + 1)];
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
    add_valid_area(below, samples, y, field, frame, findings);
    for (std::int32_t x = samples.x0; x < samples.x0 + samples.width; ++x) {
      const auto left = static_cast<std::size_t>(x - samples.x0);
      add_sample(coverage, x, y, above[left] + above[left + 1] + below[left] + below[left + 1] > 0, findings);
    }
    above = std::move(below);
  }
}

}  // namespace tinsmith
