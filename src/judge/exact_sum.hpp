#pragma once
// Sums of doubles that do not depend on the order of adding, because nothing is lost on the way.

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tinsmith {

/// Any doubles, up to 2^42 of them. Rounds once, when asked for the value.
class ExactSum {
 public:
  void add(double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    const auto biased = static_cast<unsigned>(bits >> 52) & 0x7FFU;
    if (biased == 0x7FFU) {
      beyond_ += value;
      return;
    }
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const std::uint64_t mantissa = biased == 0 ? fraction : fraction | std::uint64_t{1} << 52;
    const unsigned exponent = biased == 0 ? 1 : biased;
    const Int128 part = static_cast<Int128>(mantissa) << (exponent & 31U);
    parts_[exponent >> 5U] += value < 0 ? -part : part;
  }

  void add(const ExactSum& other) {
    for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i] += other.parts_[i];
    beyond_ += other.beyond_;
  }

  double value() const {
    if (beyond_ != 0) return beyond_;
    ExactSum sum = *this;
    sum.carry();
    if (sum.parts_.back() >= 0) return sum.rounded();
    sum = {};
    for (std::size_t i = 0; i < parts_.size(); ++i) sum.parts_[i] = -parts_[i];
    sum.carry();
    return -sum.rounded();
  }

 private:
  __extension__ using Int128 = __int128;

  /// All but the last part within 0 and 2^32.
  void carry() {
    for (std::size_t i = 0; i + 1 < parts_.size(); ++i) {
      parts_[i + 1] += parts_[i] >> 32;
      parts_[i] &= 0xFFFFFFFF;
    }
  }
  double rounded() const {
    double sum = 0;
    for (std::size_t i = parts_.size(); i-- > 0;)
      sum += std::ldexp(static_cast<double>(parts_[i]), 32 * static_cast<int>(i) - 1075);
    return sum;
  }

  std::array<Int128, 68> parts_{};  // part i counts steps of 2^(32 i - 1075)
  double beyond_ = 0;               // infinities and what is no number
};

}  // namespace tinsmith
