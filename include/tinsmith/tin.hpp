#pragma once
// A triangulated irregular network, as plain data.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tinsmith {

/// Vertices are (x, y, z) in the units of the CRS; triangles are indices, counter-clockwise seen from above
/// (for a right-handed x, y). No guarantee about order beyond: the same input and options, the same order.
struct Tin {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::string crs_wkt;                           // empty: unknown
  std::optional<double> metres_per_height = {};  // of a unit of z; none: unknown
};

}  // namespace tinsmith
