#include "judge/coverage.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// Some rows of the raster, with a sample more on each side so that all cells about a sample are there.
struct Band {
  std::int32_t y0 = 0;
  std::int32_t n_rows = 0;
  std::int32_t width = 0;
  HeightGrid heights;                  // with the margin
  std::vector<double> error;           // z_TIN - z_sample, the largest; kNone: in no triangle
  std::vector<std::uint8_t> n_inside;  // triangles that have the sample strictly inside, 2 stands for more

  std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// Row y of the heights, from column -1.
  const double* row(std::int32_t y) const {
    return heights.z.data() + static_cast<std::size_t>(y - y0 + 1) * (static_cast<std::size_t>(width) + 2);
  }
};

Band read_band(const HeightField& field, std::int32_t y0, std::int32_t n_rows) {
  Band band{y0, n_rows, field.width(), field.read({-1, y0 - 1, field.width() + 2, n_rows + 2}), {}, {}};
  const std::size_t n = static_cast<std::size_t>(n_rows) * static_cast<std::size_t>(band.width);
  band.error.assign(n, kNone);
  band.n_inside.assign(n, 0);
  return band;
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

struct Facet {
  PlanPoint a, b, c;  // counter-clockwise in the grid
  double za, zb, zc;
};

Facet facet_of(const PlanMesh& mesh, std::uint32_t t) {
  auto [i, j, k] = mesh.triangles[t];
  if (doubled_area(mesh.position[i], mesh.position[j], mesh.position[k]) < 0) std::swap(j, k);
  return {mesh.position[i], mesh.position[j], mesh.position[k], mesh.height[i], mesh.height[j], mesh.height[k]};
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
Span columns_of(const Facet& f, const std::array<Side, 3>& sides, double y, std::int32_t width) {
  double low = std::min({f.a.x, f.b.x, f.c.x});
  double high = std::max({f.a.x, f.b.x, f.c.x});
  for (const Side& side : sides) {
    if (side.nx == 0) continue;
    const double x = side.start.x - (side.ny * (y - side.start.y) + side.slack) / side.nx;
    if (side.nx > 0) low = std::max(low, x);
    if (side.nx < 0) high = std::min(high, x);
  }
  return whole_within(low - kPlanEpsilon, high + kPlanEpsilon, 0, width - 1);
}

void record(Band& band, std::int32_t x, std::int32_t y, double z, bool is_strict) {
  const std::size_t i = band.index(x, y);
  if (is_strict && band.n_inside[i] < 2) ++band.n_inside[i];
  const double error = z - band.row(y)[x + 1];
  if (!(std::abs(error) <= std::abs(band.error[i])) && !std::isnan(error)) band.error[i] = error;
}

/// Records the triangle at all samples of the band that lie in it.
void cover(const PlanMesh& mesh, std::uint32_t t, Band& band) {
  const Facet f = facet_of(mesh, t);
  if (!(doubled_area(f.a, f.b, f.c) > 0)) return;
  const std::array<Side, 3> sides{Side(f.b, f.c), Side(f.c, f.a), Side(f.a, f.b)};  // opposite a, b, c
  const Span rows =
      whole_within(std::min({f.a.y, f.b.y, f.c.y}) - kPlanEpsilon, std::max({f.a.y, f.b.y, f.c.y}) + kPlanEpsilon,
                   band.y0, band.y0 + band.n_rows - 1);
  for (std::int32_t y = rows.first; y <= rows.last; ++y) {
    const Span columns = columns_of(f, sides, y, band.width);
    for (std::int32_t x = columns.first; x <= columns.last; ++x) {
      const double ea = sides[0].value(x, y);
      const double eb = sides[1].value(x, y);
      const double ec = sides[2].value(x, y);
      if (ea < -sides[0].slack || eb < -sides[1].slack || ec < -sides[2].slack) continue;
      // Within the slack outside an edge the height is that of the edge: nothing is extrapolated.
      const double wa = std::max(ea, 0.0);
      const double wb = std::max(eb, 0.0);
      const double wc = std::max(ec, 0.0);
      record(band, x, y, (wa * f.za + wb * f.zb + wc * f.zc) / (wa + wb + wc),
             ea > sides[0].slack && eb > sides[1].slack && ec > sides[2].slack);
    }
  }
}

// ---- which triangles a band needs

/// Triangles by the band in which they begin, in the order of their numbers.
struct Agenda {
  std::vector<std::size_t> start;  // of each band, and the end
  std::vector<std::uint32_t> triangles;
};

Span rows_of(const PlanMesh& mesh, std::uint32_t t, std::int32_t height) {
  const auto& [i, j, k] = mesh.triangles[t];
  const auto [low, high] = std::minmax({mesh.position[i].y, mesh.position[j].y, mesh.position[k].y});
  return whole_within(low - kPlanEpsilon, high + kPlanEpsilon, 0, height - 1);
}

Agenda agenda_of(const PlanMesh& mesh, std::int32_t height, std::int32_t band_rows) {
  const auto n_bands = static_cast<std::size_t>((height + band_rows - 1) / band_rows);
  Agenda agenda;
  agenda.start.assign(n_bands + 2, 0);
  const auto for_each = [&](auto visit) {
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      const Span rows = rows_of(mesh, t, height);
      if (rows.first <= rows.last) visit(static_cast<std::size_t>(rows.first / band_rows), t);
    }
  };
  for_each([&](std::size_t band, std::uint32_t) { ++agenda.start[band + 2]; });
  std::partial_sum(agenda.start.begin(), agenda.start.end(), agenda.start.begin());
  agenda.triangles.resize(agenda.start.back());
  // The start of `band` moves from place band + 1 up to where that of band + 1 belongs.
  for_each([&](std::size_t band, std::uint32_t t) { agenda.triangles[agenda.start[band + 1]++] = t; });
  return agenda;
}

// ---- statistics

/// Counts of |error| by its leading bits: 64 bins in each power of two, so that a percentile is known to 1.6 %.
class ErrorHistogram {
 public:
  void add(double error) { ++counts_[bin(error)]; }

  /// The upper end of the bin below or in which this share of the errors lies.
  double percentile(double share, std::uint64_t n) const {
    const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(n)));
    std::uint64_t below = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i)
      if ((below += counts_[i]) >= wanted) return i == 0 ? 0 : std::bit_cast<double>((i + 1) << kShift);
    return 0;
  }

 private:
  static constexpr int kShift = 52 - 6;
  static std::size_t bin(double error) { return std::bit_cast<std::uint64_t>(std::abs(error)) >> kShift; }
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(std::size_t{1} << (63 - kShift), 0);
};

struct Sums {
  std::uint64_t n = 0;
  double error = 0;
  double squared = 0;
  double largest_height = 0;  // of samples and vertices, as a size
  ErrorHistogram histogram;
};

/// Whether cell (x, y), from (x, y) to (x + 1, y + 1), has four valid samples, for x from -1.
std::vector<std::uint8_t> valid_cells(const Band& band, std::int32_t y) {
  const double* const upper = band.row(y);
  const double* const lower = band.row(y + 1);
  std::vector<std::uint8_t> valid(static_cast<std::size_t>(band.width) + 1);
  for (std::size_t i = 0; i < valid.size(); ++i)
    valid[i] = !std::isnan(upper[i] + upper[i + 1] + lower[i] + lower[i + 1]);
  return valid;
}

/// The scale is taken anew every 64 columns, over which it does not change enough to be seen.
void add_valid_area(const std::vector<std::uint8_t>& cells, std::int32_t y, const GridFrame& frame,
                    Certificate& certificate) {
  constexpr std::size_t kRun = 64;
  for (std::size_t i = 0; i < cells.size(); i += kRun) {
    const std::size_t end = std::min(i + kRun, cells.size());
    const auto n = static_cast<double>(std::accumulate(&cells[i], &cells[i] + (end - i), 0U));
    if (n == 0) continue;
    certificate.cells_valid += n;
    certificate.area_valid += n * cell_area(frame, static_cast<double>(i + end) / 2 - 1, y + 0.5);
  }
}

void add_error(double error, std::int32_t x, std::int32_t y, Certificate& certificate, Sums& sums) {
  ++sums.n;
  sums.error += error;
  sums.squared += error * error;
  sums.histogram.add(error);
  if (std::abs(error) <= certificate.max_error) return;
  certificate.max_error = std::abs(error);
  certificate.max_error_column = x;
  certificate.max_error_row = y;
}

void add_band(const Band& band, const GridFrame& frame, Certificate& certificate, Sums& sums) {
  std::vector<std::uint8_t> above = valid_cells(band, band.y0 - 1);
  for (std::int32_t y = band.y0; y < band.y0 + band.n_rows; ++y) {
    std::vector<std::uint8_t> below = valid_cells(band, y);
    add_valid_area(below, y, frame, certificate);
    for (std::int32_t x = 0; x < band.width; ++x) {
      const auto left = static_cast<std::size_t>(x);
      const std::size_t i = band.index(x, y);
      const double z = band.row(y)[x + 1];
      if (std::isnan(z)) {
        if (band.n_inside[i] > 0) ++certificate.voids_covered;
        continue;
      }
      ++certificate.samples;
      sums.largest_height = std::max(sums.largest_height, std::abs(z));
      if (band.n_inside[i] > 1) ++certificate.overlapped;
      const bool is_coverable = above[left] + above[left + 1] + below[left] + below[left + 1] > 0;
      const bool is_covered = !std::isnan(band.error[i]);
      if (is_coverable) ++(is_covered ? certificate.covered : certificate.uncovered);
      if (is_covered) add_error(band.error[i], x, y, certificate, sums);
    }
    above = std::move(below);
  }
}

/// From sums in vertical units to figures in metres.
void conclude(const Sums& sums, double metres_per_unit, Certificate& certificate) {
  // Weights are exact on the lattice, so interpolation rounds a height five times and the difference once; four
  // times that leaves room for heights that a format shifts and scales.
  certificate.rounding = 16 * std::numeric_limits<double>::epsilon() * sums.largest_height * metres_per_unit;
  certificate.max_error *= metres_per_unit;
  if (sums.n == 0) return;
  const auto n = static_cast<double>(sums.n);
  certificate.mean_error = sums.error / n * metres_per_unit;
  certificate.rmse = std::sqrt(sums.squared / n) * metres_per_unit;
  certificate.p99_error =
      std::min(sums.histogram.percentile(0.99, sums.n) * metres_per_unit, certificate.max_error);
}

std::int32_t rows_in_band(const Samples& samples) {
  if (samples.band_rows > 0) return samples.band_rows;
  return std::clamp((1 << 20) / samples.field.width(), 64, 1024);
}

void report(const Samples& samples, std::int32_t n_rows_done) {
  if (samples.progress && !samples.progress(static_cast<double>(n_rows_done) / samples.field.height(), "verify"))
    throw Interrupted("verify: stopped on request");
}

}  // namespace

void measure_coverage(const PlanMesh& mesh, const Samples& samples, Certificate& certificate) {
  const std::int32_t height = samples.field.height();
  const std::int32_t band_rows = rows_in_band(samples);
  const Agenda agenda = agenda_of(mesh, height, band_rows);
  std::vector<std::uint32_t> open;  // triangles that reach into the band
  Sums sums;
  for (const double z : mesh.height) sums.largest_height = std::max(sums.largest_height, std::abs(z));
  for (std::int32_t y0 = 0; y0 < height; y0 += band_rows) {
    report(samples, y0);
    Band band = read_band(samples.field, y0, std::min(band_rows, height - y0));
    const auto b = static_cast<std::size_t>(y0 / band_rows);
    open.insert(open.end(), agenda.triangles.begin() + static_cast<std::ptrdiff_t>(agenda.start[b]),
                agenda.triangles.begin() + static_cast<std::ptrdiff_t>(agenda.start[b + 1]));
    for (const std::uint32_t t : open) cover(mesh, t, band);
    add_band(band, samples.frame, certificate, sums);
    std::erase_if(open, [&](std::uint32_t t) { return rows_of(mesh, t, height).last < y0 + band_rows; });
  }
  report(samples, height);
  conclude(sums, samples.frame.metres_per_vertical_unit, certificate);
}

}  // namespace tinsmith
