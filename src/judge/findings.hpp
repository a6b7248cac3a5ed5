#pragma once
// What the blocks add up to. Nothing in it depends on the order of adding, so that the certificate is the same
// for any blocks and any number of threads.

#include <array>
#include <cstdint>
#include <vector>

#include "judge/exact_sum.hpp"
#include "tinsmith/certificate.hpp"

namespace tinsmith {

/// Counts of |error| by its leading bits: 64 bins in each power of two, so that a percentile is known to 1.6 %.
class ErrorHistogram {
 public:
  void add(double error) { ++counts_[bin(error)]; }
  void add(const ErrorHistogram& other);

  /// The upper end of the bin below or in which this share of the n errors lies.
  double percentile(double share, std::uint64_t n) const;

 private:
  static constexpr int kShift = 52 - 6;
  static std::size_t bin(double error) { return std::bit_cast<std::uint64_t>(std::abs(error)) >> kShift; }
  std::vector<std::uint64_t> counts_ = std::vector<std::uint64_t>(std::size_t{1} << (63 - kShift), 0);
};

struct Findings {
  Certificate counts;  // its whole numbers, and the largest error in vertical units with its place
  std::uint64_t n_errors = 0;
  ExactSum error;  // vertical units
  ExactSum squared;
  ErrorHistogram histogram;
  double largest_height = 0;  // of samples and vertices, as a size
  ExactSum area_plan;         // square metres
  ExactSum area_valid;
  ExactSum cells_plan;  // cells
  ExactSum cells_valid;
  std::uint64_t n_colour_differences = 0;
  ExactSum squared_colour;  // levels

  void add_error(double size_and_sign, std::int32_t x, std::int32_t y);
  void add_colour_difference(double size);
  void add(const Findings& other);
};

/// The certificate of all blocks together.
Certificate certificate_of(const Findings& findings, double metres_per_vertical_unit);

}  // namespace tinsmith
