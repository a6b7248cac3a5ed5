#pragma once
// Four doubles at once, in whatever vector registers the machine has. Their number is fixed, so that sums over them
// are added in the same order, and give the same bits, on every machine.

#include <algorithm>
#include <cstddef>
#include <cstdint>

// Compiled into the caller, with the instruction set of the caller.
#define TINSMITH_INLINE inline __attribute__((always_inline))

#if defined(__x86_64__) && defined(__GNUC__)
#define TINSMITH_HAS_AVX2_VARIANT
#endif

namespace tinsmith {

#ifdef TINSMITH_HAS_AVX2_VARIANT
/// Whether this machine has it.
inline bool has_avx2() {
  static const bool has = __builtin_cpu_supports("avx2");
  return has;
}
#endif

inline constexpr std::size_t kLanes = 4;
inline constexpr auto kLaneStep = static_cast<std::int32_t>(kLanes);

using Pair = double __attribute__((vector_size(2 * sizeof(double))));
using Quad = double __attribute__((vector_size(4 * sizeof(double))));

/// kLanes doubles in registers of the type Pair or Quad.
template <class Register>
struct Lanes {
  static constexpr std::size_t kRegisters = kLanes * sizeof(double) / sizeof(Register);
  Register r[kRegisters];  // NOLINT(modernize-avoid-c-arrays): stays in registers where std::array does not

  TINSMITH_INLINE static Lanes all(double value) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i)
      result.r[i] = value - Register{};  // x - 0 is x: the compiler broadcasts
    return result;
  }
  TINSMITH_INLINE static Lanes load(const double* from) {
    Lanes result;
    const auto* parts = reinterpret_cast<const InMemory*>(from);
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = parts[i].value;
    return result;
  }
  TINSMITH_INLINE double operator[](std::size_t i) const {
    constexpr std::size_t kWidth = kLanes / kRegisters;
    return r[i / kWidth][i % kWidth];
  }

  TINSMITH_INLINE friend Lanes operator+(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] + b.r[i];
    return result;
  }
  TINSMITH_INLINE friend Lanes operator-(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] - b.r[i];
    return result;
  }
  TINSMITH_INLINE friend Lanes operator*(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] * b.r[i];
    return result;
  }
  TINSMITH_INLINE friend Lanes operator/(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] / b.r[i];
    return result;
  }
  TINSMITH_INLINE friend Lanes min(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] < b.r[i] ? a.r[i] : b.r[i];
    return result;
  }
  TINSMITH_INLINE friend Lanes max(const Lanes& a, const Lanes& b) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] > b.r[i] ? a.r[i] : b.r[i];
    return result;
  }
  /// Where a < b: yes, elsewhere: no.
  TINSMITH_INLINE friend Lanes where_less(const Lanes& a, const Lanes& b, const Lanes& yes, const Lanes& no) {
    Lanes result;
    for (std::size_t i = 0; i < kRegisters; ++i) result.r[i] = a.r[i] < b.r[i] ? yes.r[i] : no.r[i];
    return result;
  }

  TINSMITH_INLINE double smallest() const {
    return std::min(std::min((*this)[0], (*this)[2]), std::min((*this)[1], (*this)[3]));
  }
  TINSMITH_INLINE double largest() const {
    return std::max(std::max((*this)[0], (*this)[2]), std::max((*this)[1], (*this)[3]));
  }
  TINSMITH_INLINE double sum() const { return ((*this)[0] + (*this)[2]) + ((*this)[1] + (*this)[3]); }

 private:
  struct InMemory {
    Register value;
  } __attribute__((packed, may_alias));
};

}  // namespace tinsmith
