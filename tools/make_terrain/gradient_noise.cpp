#include "gradient_noise.hpp"

#include <algorithm>
#include <cmath>

namespace tinsmith {

namespace {

std::int64_t floor_of(double v) {
  const auto i = static_cast<std::int64_t>(v);
  return static_cast<double>(i) > v ? i - 1 : i;
}

/// Perlin's quintic: its first and second derivatives vanish at 0 and 1.
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

/// Turns the octaves against the lattice of the one before, so that their zeros do not line up: cosine and sine
/// of 37 degrees, and a shift.
constexpr double kCosine = 0.7986355100472928;
constexpr double kSine = 0.6018150231520483;
constexpr double kShift = 17.3;

struct Position {
  double x;
  double y;
};

Position next_octave(Position p) {
  return {2 * (kCosine * p.x - kSine * p.y) + kShift, 2 * (kSine * p.x + kCosine * p.y) + kShift};
}

}  // namespace

void GradientNoise::enter_cell(std::int64_t x, std::int64_t y) {
  cell_x_ = x;
  cell_y_ = y;
  constexpr double kUnit = 1.0 / 2147483648.0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::uint64_t h =
        hash_of(seed_, x + static_cast<std::int64_t>(i % 2), y + static_cast<std::int64_t>(i / 2));
    corners_[i] = {static_cast<double>(h >> 32) * kUnit - 1, static_cast<double>(h & 0xFFFFFFFFU) * kUnit - 1};
  }
}

double GradientNoise::at(double x, double y) {
  const std::int64_t cell_x = floor_of(x);
  const std::int64_t cell_y = floor_of(y);
  if (cell_x != cell_x_ || cell_y != cell_y_) enter_cell(cell_x, cell_y);
  const double u = x - static_cast<double>(cell_x);
  const double v = y - static_cast<double>(cell_y);
  const auto& [g00, g10, g01, g11] = corners_;
  const double n00 = g00.x * u + g00.y * v;
  const double n10 = g10.x * (u - 1) + g10.y * v;
  const double n01 = g01.x * u + g01.y * (v - 1);
  const double n11 = g11.x * (u - 1) + g11.y * (v - 1);
  const double along_x = fade(u);
  const double upper = n00 + along_x * (n10 - n00);
  const double lower = n01 + along_x * (n11 - n01);
  return upper + fade(v) * (lower - upper);
}

Octaves::Octaves(std::uint64_t seed, int n_octaves) {
  for (int i = 0; i < n_octaves; ++i) noise_.emplace_back(hash_of(seed, i, 0));
}

double Octaves::sum(double x, double y) {
  double total = 0;
  double weight = 0.5;
  Position p{x, y};
  for (GradientNoise& octave : noise_) {
    total += weight * octave.at(p.x, p.y);
    weight *= 0.5;
    p = next_octave(p);
  }
  return total;
}

double Octaves::ridged(double x, double y) {
  constexpr double kSteepness = 2.5;  // spreads the noise, which seldom leaves +-0.4, over the fold
  constexpr double kLeast = 0.3;      // the share of its detail that low ground has
  constexpr double kGain = 1.5;       // how soon high ground has all of it
  double total = 0;
  double weight = 0.5;
  double high_ground = 1;
  Position p{x, y};
  for (GradientNoise& octave : noise_) {
    const double fold = 1 - std::min(1.0, kSteepness * std::abs(octave.at(p.x, p.y)));
    const double signal = fold * fold * high_ground;
    total += weight * signal;
    high_ground = std::min(1.0, kLeast + kGain * signal);
    weight *= 0.5;
    p = next_octave(p);
  }
  return total;
}

}  // namespace tinsmith
