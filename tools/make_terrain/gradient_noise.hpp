#pragma once
// Gradient noise (K. Perlin: Improving noise, 2002) over a hashed lattice, and the two sums of its octaves that
// terrain needs (F. K. Musgrave's fractal sum and ridged multifractal; D. Ebert et al.: Texturing and Modeling).

#include <array>
#include <cstdint>
#include <vector>

namespace tinsmith {

/// A well-mixed number for a lattice point (the finaliser of splitmix64).
inline std::uint64_t hash_of(std::uint64_t seed, std::int64_t x, std::int64_t y) {
  std::uint64_t h = seed + static_cast<std::uint64_t>(x) * 0x9E3779B97F4A7C15U;
  h ^= h >> 30;
  h = (h + static_cast<std::uint64_t>(y)) * 0xBF58476D1CE4E5B9U;
  h ^= h >> 27;
  h *= 0x94D049BB133111EBU;
  return h ^ (h >> 31);
}

/// One octave. Remembers the gradients of the lattice cell of the latest call, which neighbouring samples
/// share; the value does not depend on what was asked before.
class GradientNoise {
 public:
  explicit GradientNoise(std::uint64_t seed) : seed_(seed) {}

  /// Zero at lattice points, within [-1, 1], wavelength about 1.
  double at(double x, double y);

 private:
  void enter_cell(std::int64_t x, std::int64_t y);

  struct Gradient {
    double x = 0;
    double y = 0;
  };
  std::uint64_t seed_;
  std::int64_t cell_x_ = INT64_MIN;
  std::int64_t cell_y_ = INT64_MIN;
  std::array<Gradient, 4> corners_;  // (0, 0), (1, 0), (0, 1), (1, 1)
};

/// Octaves of noise, each of half the wavelength of the one before.
class Octaves {
 public:
  Octaves(std::uint64_t seed, int n_octaves);

  /// The fractal sum, each octave half as high as the one before: within [-1, 1], mostly within +-0.5.
  double sum(double x, double y);

  /// The ridged multifractal: within [0, 1], sharp ridges, fine detail on high ground only.
  double ridged(double x, double y);

 private:
  std::vector<GradientNoise> noise_;
};

}  // namespace tinsmith
