#pragma once
// Where a grid of samples lies on the earth, and how long its steps are in metres.

#include <array>
#include <string>

namespace tinsmith {

/// The georeference of a grid. Columns and rows here are sample positions: (0, 0) is the centre of the upper
/// left cell; the geotransform is GDAL's and speaks of cell corners, hence the half cells inside.
struct GridFrame {
  std::array<double, 6> geotransform{0, 1, 0, 0, 0, 1};
  std::string crs_wkt;                    // empty: no CRS, metres assumed
  bool is_geographic = false;             // horizontal coordinates are degrees (or another angle)
  double metres_per_horizontal_unit = 1;  // projected CRS: exact. Geographic: unused, see metres_per_unit
  double metres_per_vertical_unit = 1;
  double radians_per_unit = 0;         // geographic: of the CRS's angle, for degrees pi / 180
  double equatorial_radius = 6378137;  // geographic: of the CRS's ellipsoid, metres
  double flattening = 1 / 298.257223563;

  /// CRS coordinates of a grid position, and back. to_grid(to_crs(p)) is p to 1e-9 cells, or to the half of
  /// the last bit of the coordinate where that is more.
  std::array<double, 2> to_crs(double column, double row) const;
  std::array<double, 2> to_grid(double x, double y) const;

  /// The frame whose sample (0, 0) is this one's (columns, rows). A sample's CRS coordinates are those of
  /// this frame but for the last bit.
  GridFrame shifted(double columns, double rows) const;

  /// Metres per CRS unit along x and y at a grid position (GeographicLib's radii of curvature when geographic).
  std::array<double, 2> metres_per_unit(double column, double row) const;

  /// Metres per step along a row and along a column at a grid position.
  std::array<double, 2> metres_per_step(double column, double row) const;

  /// Whether the georeference mirrors the grid (as every north-up raster does, whose rows run south).
  bool is_mirrored() const;
};

}  // namespace tinsmith
