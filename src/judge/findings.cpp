#include "judge/findings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace tinsmith {
namespace {

bool is_worse(const Certificate& a, const Certificate& b) {
  return std::tuple(-a.max_error, a.max_error_row, a.max_error_column) <
         std::tuple(-b.max_error, b.max_error_row, b.max_error_column);
}

void keep_worse_error(Certificate& kept, const Certificate& other) {
  if (!is_worse(other, kept)) return;
  kept.max_error = other.max_error;
  kept.max_error_column = other.max_error_column;
  kept.max_error_row = other.max_error_row;
}

void add_counts(Certificate& sum, const Certificate& other) {
  for (const auto count :
       {&Certificate::samples, &Certificate::covered, &Certificate::uncovered, &Certificate::overlapped,
        &Certificate::voids_covered, &Certificate::folded, &Certificate::non_manifold_edges,
        &Certificate::non_manifold_vertices, &Certificate::t_junctions, &Certificate::unwelded_edges,
        &Certificate::components, &Certificate::color_samples})
    sum.*count += other.*count;
}

}  // namespace

void ErrorHistogram::add(const ErrorHistogram& other) {
  std::transform(counts_.begin(), counts_.end(), other.counts_.begin(), counts_.begin(), std::plus<>());
}

double ErrorHistogram::percentile(double share, std::uint64_t n) const {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(n)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < counts_.size(); ++i)
    if ((below += counts_[i]) >= wanted) return i == 0 ? 0 : std::bit_cast<double>((i + 1) << kShift);
  return 0;
}

void Findings::add_error(double size_and_sign, std::int32_t x, std::int32_t y) {
  ++n_errors;
  error.add(size_and_sign);
  squared.add(size_and_sign * size_and_sign);
  histogram.add(size_and_sign);
  if (std::abs(size_and_sign) < counts.max_error) return;
  Certificate here;
  here.max_error = std::abs(size_and_sign);
  here.max_error_column = x;
  here.max_error_row = y;
  keep_worse_error(counts, here);
}

void Findings::add_colour_difference(double size) {
  ++n_colour_differences;
  squared_colour.add(size * size);
  counts.color_max_error = std::max(counts.color_max_error, size);
}

void Findings::add(const Findings& other) {
  add_counts(counts, other.counts);
  keep_worse_error(counts, other.counts);
  n_errors += other.n_errors;
  error.add(other.error);
  squared.add(other.squared);
  histogram.add(other.histogram);
  largest_height = std::max(largest_height, other.largest_height);
  area_plan.add(other.area_plan);
  area_valid.add(other.area_valid);
  cells_plan.add(other.cells_plan);
  cells_valid.add(other.cells_valid);
  n_colour_differences += other.n_colour_differences;
  squared_colour.add(other.squared_colour);
  counts.color_max_error = std::max(counts.color_max_error, other.counts.color_max_error);
}

Certificate certificate_of(const Findings& findings, double metres_per_vertical_unit) {
  Certificate certificate = findings.counts;
  certificate.area_plan = findings.area_plan.value();
  certificate.area_valid = findings.area_valid.value();
  certificate.cells_plan = findings.cells_plan.value();
  certificate.cells_valid = findings.cells_valid.value();
  // Weights are exact on the lattice, so interpolation rounds a height five times and the difference once; four
  // times that leaves room for heights that a format shifts and scales.
  certificate.rounding =
      16 * std::numeric_limits<double>::epsilon() * findings.largest_height * metres_per_vertical_unit;
  certificate.max_error *= metres_per_vertical_unit;
  if (findings.n_colour_differences > 0)
    certificate.color_rmse =
        std::sqrt(findings.squared_colour.value() / static_cast<double>(findings.n_colour_differences));
  if (findings.n_errors == 0) return certificate;
  const auto n = static_cast<double>(findings.n_errors);
  certificate.mean_error = findings.error.value() / n * metres_per_vertical_unit;
  certificate.rmse = std::sqrt(findings.squared.value() / n) * metres_per_vertical_unit;
  certificate.p99_error = std::min(
      findings.histogram.percentile(0.99, findings.n_errors) * metres_per_vertical_unit, certificate.max_error);
  return certificate;
}

}  // namespace tinsmith
