#pragma once
// Several rasters on one grid, and the part of it that is asked for. Geometry only: no file is read.

#include <array>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// A raster's place on the earth and its size in samples; the name is for messages.
struct PlacedRaster {
  std::string name;
  GridFrame frame;
  std::int32_t width = 0;
  std::int32_t height = 0;
};

/// The grid that holds all rasters: its sample (0, 0) is the upper left one, in the grid's own sense, of the
/// smallest rectangle around them.
struct Mosaic {
  GridFrame frame;
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<GridRect> places;  // of each raster in the grid, in the order given; may stick out after a crop
};

/// West, south, east, north in CRS units.
using Bbox = std::array<double, 4>;

/// Lays rasters on the grid of the first. Throws InputError naming two of them when their CRS or units
/// differ, their steps differ, or their origins are not a whole number of steps apart; ResourceError when
/// the grid is too large to be counted in sixteenths of cells.
Mosaic lay_out(const std::vector<PlacedRaster>& rasters);

/// The mosaic's smallest rectangle that holds all samples inside the box. Throws UsageError when the box is
/// none or holds no sample.
Mosaic crop(const Mosaic& mosaic, const Bbox& bbox);

/// Whether a sample lies inside the box, its rim included.
bool is_inside(const GridFrame& frame, std::int32_t column, std::int32_t row, const Bbox& bbox);

/// Whether the rectangle of a crop also holds samples outside the box.
bool is_turned(const GridFrame& frame);

}  // namespace tinsmith
