#pragma once
// Which numbers can be heights at all.

#include <cmath>

namespace tinsmith {

/// Beyond any terrain in any unit (a tenth of a millimetre included), far below what marks voids in files
/// that do not say so (1e20, 1e30, -3.4e38).
inline constexpr double kLargestHeight = 1e10;

/// False for infinities, NaN and what is beyond the limit.
inline bool is_height(double z) { return std::abs(z) <= kLargestHeight; }

}  // namespace tinsmith
