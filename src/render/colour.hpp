#pragma once
// Colours, and the two scales that turn numbers into them.

namespace tinsmith {

/// Red, green and blue, 0 to 1.
struct Colour {
  double r = 0;
  double g = 0;
  double b = 0;
};

/// t = 0: a, t = 1: b.
Colour mix(const Colour& a, const Colour& b, double t);

/// Of land by height, 0 (lowest) to 1 (highest): meadow, sand, rock, snow.
Colour hypsometric_tint(double t);

/// Of the sea floor by depth, 0 (surface) to 1 (deepest).
Colour bathymetric_tint(double t);

/// -1 blue, 0 white, 1 red; what lies beyond is taken to be at the end.
Colour diverging(double t);

inline constexpr Colour kVoidColour{0.86, 0.86, 0.87};
inline constexpr Colour kInk{0.13, 0.14, 0.17};

}  // namespace tinsmith
