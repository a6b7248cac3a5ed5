#pragma once
// A colour as the numbers of its channels.

#include <array>
#include <cstddef>

namespace tinsmith {

inline constexpr std::size_t kMaxChannels = 4;
inline constexpr float kWhite = 255;

/// Levels of 0 to 255 by channel; channels that there are not hold 0.
using Levels = std::array<float, kMaxChannels>;

}  // namespace tinsmith
