#pragma once
// What a coordinate reference system says about lengths.

#include <optional>
#include <string>
#include <string_view>

namespace tinsmith {

/// The units of a CRS, and of a geographic one the ellipsoid.
struct CrsUnits {
  bool is_geographic = false;             // horizontal coordinates are angles
  double metres_per_horizontal_unit = 1;  // unused when geographic
  std::string horizontal_unit = "metre";  // its name in the CRS
  double radians_per_unit = 0;            // geographic only
  double equatorial_radius = 6378137;     // geographic only, metres
  double flattening = 1 / 298.257223563;
  std::optional<double> metres_per_height;  // of the vertical axis of a compound or 3-D CRS
};

/// Reads any WKT that OGR reads; empty means that no CRS is known: metres. Throws InputError, which names
/// `where`, for a CRS without horizontal axes or one that does not say how long its unit is.
CrsUnits crs_units(const std::string& wkt, const std::string& where);

/// Whether two WKT texts mean the same CRS, the order of the axes aside. Unknown equals unknown only.
bool is_same_crs(const std::string& a, const std::string& b);

/// Metres per unit of length by its name or symbol: "m", "Metre", "ft", "US survey foot", "ftUS", ...
std::optional<double> metres_per_named_unit(std::string_view name);

}  // namespace tinsmith
