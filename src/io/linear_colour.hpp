#pragma once
// Colours as glTF stores them: linear shares of light. Everywhere else they are levels of sRGB, 0 to 255, as in the
// images that they come from.

#include <cstdint>

namespace tinsmith {

/// The light of a level, 0 to 1 (IEC 61966-2-1).
double light_of_level(double level);

/// The level of so much light. Where 16 bits can't tell it from a whole level it is that level, so that whole
/// levels come back from share_of_level, and from float32, as they were.
double level_of_light(double light);

/// The same as a normalised 16-bit number; level_of_share takes it from a table.
std::uint16_t share_of_level(double level);
float level_of_share(std::uint16_t share);

}  // namespace tinsmith
