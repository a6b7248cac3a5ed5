#pragma once
// The part of the ground that a panel shows, and which samples lie under its pixels.

#include <array>
#include <vector>

#include "geodesy/crs.hpp"
#include "geodesy/grid_frame.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/options.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// West, south, east, north in CRS coordinates.
using Extent = std::array<double, 4>;

/// The extent that holds nothing, and the smallest one that holds a point too.
Extent no_extent();
Extent grown(const Extent& extent, const std::array<double, 2>& point);

/// A rectangle of pixels.
struct PixelRect {
  int x0 = 0;
  int y0 = 0;
  int width = 0;
  int height = 0;
};

/// North up, and a metre in the middle of the panel is as long across as down.
struct View {
  int width = 0;   // pixels
  int height = 0;  // pixels
  Extent extent{};
  double units_per_pixel_x = 1;  // CRS units
  double units_per_pixel_y = 1;

  /// CRS coordinates of a place in pixels; (0, 0) is the upper left corner of the upper left pixel.
  std::array<double, 2> to_crs(double px, double py) const;
  std::array<double, 2> to_pixel(double x, double y) const;
};

/// Metres per unit of a mesh's heights: as the options say, else its file, else its CRS; a CRS that is silent about
/// heights counts them like its horizontal lengths.
double metres_per_height(const Tin& tin, const CrsUnits& units, const InputOptions& options);

/// The outline of all cells of a grid of width x height samples.
Extent grid_extent(const GridFrame& frame, std::int32_t width, std::int32_t height);

/// A view of the extent, `panel_width` pixels wide, or less for ground that is much longer than wide.
View make_view(const GridFrame& frame, const Extent& extent, int panel_width);

/// Metres per pixel, across and down, in a row of the view.
std::array<double, 2> metres_per_pixel(const View& view, const GridFrame& frame, int py);

/// Samples per pixel, along the columns and along the rows of the grid; below 1 where the picture magnifies.
std::array<double, 2> samples_per_pixel(const View& view, const GridFrame& frame);

/// The view in tiles from the top, each with so few samples under it that they fit in memory at ease.
std::vector<PixelRect> tiles(const View& view, const std::array<double, 2>& samples_per_pixel);

/// The samples within `radius` (columns, rows) of the pixels of a tile, clipped to the field.
GridRect samples_under(const View& view, const GridFrame& frame, const PixelRect& tile,
                       const std::array<double, 2>& radius, const HeightField& field);

}  // namespace tinsmith
