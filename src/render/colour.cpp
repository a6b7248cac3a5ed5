#include "render/colour.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tinsmith {
namespace {

// Evenly spaced colours, straight lines between them.
template <std::size_t N>
Colour along(const std::array<Colour, N>& ramp, double t) {
  const double at = std::clamp(t, 0.0, 1.0) * (N - 1);
  const auto first = std::min(static_cast<std::size_t>(at), N - 2);
  return mix(ramp[first], ramp[first + 1], at - static_cast<double>(first));
}

constexpr std::array<Colour, 6> kLand{{{0.58, 0.68, 0.52},
                                       {0.75, 0.78, 0.60},
                                       {0.89, 0.84, 0.69},
                                       {0.82, 0.74, 0.65},
                                       {0.84, 0.82, 0.82},
                                       {0.97, 0.98, 1.00}}};

constexpr std::array<Colour, 3> kSeaFloor{{{0.80, 0.89, 0.93}, {0.58, 0.75, 0.85}, {0.35, 0.53, 0.70}}};

// ColorBrewer's RdBu, turned round: readable to colour-blind eyes.
constexpr std::array<Colour, 9> kBlueWhiteRed{{{0.13, 0.40, 0.67},
                                               {0.26, 0.58, 0.76},
                                               {0.57, 0.77, 0.87},
                                               {0.82, 0.90, 0.94},
                                               {0.97, 0.97, 0.97},
                                               {0.99, 0.86, 0.78},
                                               {0.96, 0.65, 0.51},
                                               {0.84, 0.38, 0.30},
                                               {0.70, 0.09, 0.17}}};

}  // namespace

Colour mix(const Colour& a, const Colour& b, double t) {
  return {a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

Colour hypsometric_tint(double t) { return along(kLand, t); }

Colour bathymetric_tint(double t) { return along(kSeaFloor, t); }

Colour diverging(double t) { return along(kBlueWhiteRed, (t + 1) / 2); }

}  // namespace tinsmith
