#include "io/linear_colour.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tinsmith {
namespace {

constexpr double kFullLevel = 255;
constexpr int kFullShare = 65535;

// IEC 61966-2-1: a straight line at the dark end, a power beyond.
constexpr double kLine = 12.92, kLineEnd = 0.04045;
constexpr double kOffset = 0.055, kPower = 2.4;

std::vector<float> levels_of_all_shares() {
  std::vector<float> levels;
  for (int share = 0; share <= kFullShare; ++share)
    levels.push_back(static_cast<float>(level_of_light(share / double{kFullShare})));
  return levels;
}

}  // namespace

double light_of_level(double level) {
  const double value = level / kFullLevel;
  return value <= kLineEnd ? value / kLine : std::pow((value + kOffset) / (1 + kOffset), kPower);
}

double level_of_light(double light) {
  const double value =
      light <= kLineEnd / kLine ? light * kLine : (1 + kOffset) * std::pow(light, 1 / kPower) - kOffset;
  const double whole = std::round(value * kFullLevel);
  return std::abs(light - light_of_level(whole)) <= 0.5 / kFullShare ? whole : value * kFullLevel;
}

std::uint16_t share_of_level(double level) {
  return static_cast<std::uint16_t>(std::lround(light_of_level(std::clamp(level, 0.0, kFullLevel)) * kFullShare));
}

float level_of_share(std::uint16_t share) {
  static const std::vector<float> levels = levels_of_all_shares();
  return levels[share];
}

}  // namespace tinsmith
