// Shaded relief: B. Horn, Hill shading and the reflectance map, 1981.

#include <algorithm>
#include <cmath>

#include "render/colour.hpp"
#include "render/panels.hpp"
#include "render/surface.hpp"

namespace tinsmith {
namespace {

// Towards the sun: azimuth 315 degrees, altitude 45 degrees; east, north, up.
constexpr double kSunEast = -0.5;
constexpr double kSunNorth = 0.5;
constexpr double kSunUp = 0.70710678118654752;

constexpr Colour kShadow{0.17, 0.18, 0.29};
constexpr Colour kHighlight{1.00, 0.99, 0.94};

// Mountains are shown as they are. Flatter ground is exaggerated until its slopes, root mean square, are
// this steep (a fifth of the Alps' at 90 m), or by the limit: else a plain would be one even grey.
constexpr double kSlopeThatReads = 0.12;
constexpr double kMostExaggeration = 20;

// A picture that goes deeper shows a sea floor: what lies below 0 is water. Land that dips below the sea's
// level, as the Dead Sea's shore at -430 m, is no such thing.
constexpr double kDeepSea = -1000;

// An ortho has shadows of its own: the relief is laid over it lightly.
constexpr double kReliefOfColours = 0.5;

struct Slope {
  double east = 0;
  double north = 0;
};

// Horn's eight neighbours; a neighbour without a height counts as level with the middle.
Slope slope_at(const PixelGrid& heights, int x, int y, const std::array<double, 2>& pixel) {
  const double middle = heights.value[heights.index(x, y)];
  const auto at = [&](int dx, int dy) {
    const int u = std::clamp(x + dx, 0, heights.width - 1);
    const int v = std::clamp(y + dy, 0, heights.height - 1);
    const double z = heights.value[heights.index(u, v)];
    return std::isnan(z) ? middle : z;
  };
  const double east = at(1, -1) + 2 * at(1, 0) + at(1, 1) - at(-1, -1) - 2 * at(-1, 0) - at(-1, 1);
  const double north = at(-1, -1) + 2 * at(0, -1) + at(1, -1) - at(-1, 1) - 2 * at(0, 1) - at(1, 1);
  return {east / (8 * pixel[0]), north / (8 * pixel[1])};
}

// 0 in the shade, kSunUp on level ground, 1 towards the sun.
double illumination(const Slope& slope, double exaggeration) {
  const double east = slope.east * exaggeration;
  const double north = slope.north * exaggeration;
  const double cosine =
      (-east * kSunEast - north * kSunNorth + kSunUp) / std::sqrt(1 + east * east + north * north);
  return std::max(cosine, 0.0);
}

Colour lit(const Colour& tint, double light) {
  if (light < kSunUp) return mix(kShadow, tint, std::pow(light / kSunUp, 0.85));
  return mix(tint, kHighlight, 0.6 * (light - kSunUp) / (1 - kSunUp));
}

Colour tint_of(double z, double lowest, double highest) {
  const bool has_sea = lowest < kDeepSea;
  if (has_sea && z < 0) return bathymetric_tint(z / lowest);
  const double shore = has_sea ? 0 : lowest;
  return hypsometric_tint(highest > shore ? (z - shore) / (highest - shore) : 0);
}

Colour tint_of(const PixelColours& colours, std::size_t i) {
  const auto& [red, green, blue] = colours.channels;
  constexpr double kFullLevel = 255;
  return {red.value[i] / kFullLevel, green.value[i] / kFullLevel, blue.value[i] / kFullLevel};
}

double root_mean_square(const std::vector<Slope>& slopes) {
  double sum = 0;
  for (const Slope& s : slopes) sum += s.east * s.east + s.north * s.north;
  return slopes.empty() ? 0 : std::sqrt(sum / static_cast<double>(slopes.size()));
}

}  // namespace

Surface draw_hillshade(const View& view, const GridFrame& frame, const PixelGrid& heights,
                       const std::optional<PixelColours>& colours) {
  std::vector<Slope> slopes(heights.value.size());
  double lowest = std::numeric_limits<double>::infinity();
  double highest = -lowest;
  for (int y = 0; y < view.height; ++y) {
    const auto pixel = metres_per_pixel(view, frame, y);
    for (int x = 0; x < view.width; ++x) {
      const double z = heights.value[heights.index(x, y)];
      if (std::isnan(z)) continue;
      slopes[heights.index(x, y)] = slope_at(heights, x, y, pixel);
      lowest = std::min(lowest, z);
      highest = std::max(highest, z);
    }
  }
  const double steepness = root_mean_square(slopes);
  const double exaggeration = steepness > 0 ? std::clamp(kSlopeThatReads / steepness, 1.0, kMostExaggeration) : 1;
  if (colours) {
    return paint(heights, [&](std::size_t i) {
      const Colour tint = tint_of(*colours, i);
      return mix(tint, lit(tint, illumination(slopes[i], exaggeration)), kReliefOfColours);
    });
  }
  return paint(heights, [&](std::size_t i) {
    return lit(tint_of(heights.value[i], lowest, highest), illumination(slopes[i], exaggeration));
  });
}

}  // namespace tinsmith
