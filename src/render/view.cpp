#include "render/view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tinsmith {
namespace {

// A panel at most so many times higher than wide, and the other way round: a strip of 1 x 10 000 samples
// must not make a picture of millions of rows.
constexpr double kLongestProportion = 4;

// Samples along a side of the block under one tile: 32 MB of heights.
constexpr double kBlockSide = 2048;

constexpr int kTileSide = 256;  // pixels

// Metres per CRS unit at CRS coordinates.
std::array<double, 2> metres_per_unit_at(const GridFrame& frame, double x, double y) {
  const auto [column, row] = frame.to_grid(x, y);
  const auto metres = frame.metres_per_unit(column, row);
  // At a pole a degree of longitude has no length; the picture still needs one.
  return {std::max(metres[0], metres[1] * 1e-3), std::max(metres[1], metres[0] * 1e-3)};
}

}  // namespace

Extent no_extent() {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return {kInfinity, kInfinity, -kInfinity, -kInfinity};
}

Extent grown(const Extent& e, const std::array<double, 2>& p) {
  return {std::min(e[0], p[0]), std::min(e[1], p[1]), std::max(e[2], p[0]), std::max(e[3], p[1])};
}

double metres_per_height(const Tin& tin, const CrsUnits& units, const InputOptions& options) {
  if (options.vertical_unit) return *options.vertical_unit;
  if (tin.metres_per_height) return *tin.metres_per_height;
  return units.metres_per_height.value_or(units.is_geographic ? 1 : units.metres_per_horizontal_unit);
}

std::array<double, 2> View::to_crs(double px, double py) const {
  return {extent[0] + px * units_per_pixel_x, extent[3] - py * units_per_pixel_y};
}

std::array<double, 2> View::to_pixel(double x, double y) const {
  return {(x - extent[0]) / units_per_pixel_x, (extent[3] - y) / units_per_pixel_y};
}

Extent grid_extent(const GridFrame& frame, std::int32_t width, std::int32_t height) {
  Extent extent = no_extent();
  for (const double column : {-0.5, width - 0.5})
    for (const double row : {-0.5, height - 0.5}) extent = grown(extent, frame.to_crs(column, row));
  return extent;
}

View make_view(const GridFrame& frame, const Extent& extent, int panel_width) {
  const auto metres = metres_per_unit_at(frame, (extent[0] + extent[2]) / 2, (extent[1] + extent[3]) / 2);
  const double ground_width = (extent[2] - extent[0]) * metres[0];
  const double ground_height = (extent[3] - extent[1]) * metres[1];
  const double proportion = ground_height / ground_width;
  const double width = panel_width * std::min(1.0, kLongestProportion / proportion);
  View view;
  view.width = std::max(1, static_cast<int>(std::lround(width)));
  view.height = std::max(1, static_cast<int>(std::lround(width * proportion)));
  view.extent = extent;
  view.units_per_pixel_x = (extent[2] - extent[0]) / view.width;
  view.units_per_pixel_y = (extent[3] - extent[1]) / view.height;
  return view;
}

std::array<double, 2> metres_per_pixel(const View& view, const GridFrame& frame, int py) {
  const auto [x, y] = view.to_crs(view.width / 2.0, py + 0.5);
  const auto metres = metres_per_unit_at(frame, x, y);
  return {view.units_per_pixel_x * metres[0], view.units_per_pixel_y * metres[1]};
}

std::array<double, 2> samples_per_pixel(const View& view, const GridFrame& frame) {
  const auto [x, y] = view.to_crs(view.width / 2.0, view.height / 2.0);
  const auto here = frame.to_grid(x, y);
  const auto east = frame.to_grid(x + view.units_per_pixel_x, y);
  const auto south = frame.to_grid(x, y - view.units_per_pixel_y);
  // The sides of the box in the grid about a pixel: also of a pixel that lies askew in it.
  return {std::abs(east[0] - here[0]) + std::abs(south[0] - here[0]),
          std::abs(east[1] - here[1]) + std::abs(south[1] - here[1])};
}

std::vector<PixelRect> tiles(const View& view, const std::array<double, 2>& samples_per_pixel) {
  const double densest = std::max(samples_per_pixel[0], samples_per_pixel[1]);
  const int side = static_cast<int>(std::clamp(kBlockSide / densest, 1.0, static_cast<double>(kTileSide)));
  std::vector<PixelRect> result;
  for (int y = 0; y < view.height; y += side)
    for (int x = 0; x < view.width; x += side)
      result.push_back({x, y, std::min(side, view.width - x), std::min(side, view.height - y)});
  return result;
}

GridRect samples_under(const View& view, const GridFrame& frame, const PixelRect& tile,
                       const std::array<double, 2>& radius, const HeightField& field) {
  Extent covered = no_extent();  // in columns and rows
  for (const int px : {tile.x0, tile.x0 + tile.width}) {
    for (const int py : {tile.y0, tile.y0 + tile.height}) {
      const auto [x, y] = view.to_crs(px, py);
      covered = grown(covered, frame.to_grid(x, y));
    }
  }
  const auto clip = [](double value, std::int32_t count) {
    return static_cast<std::int32_t>(std::clamp(value, 0.0, static_cast<double>(count)));
  };
  const auto x0 = clip(std::floor(covered[0] - radius[0]), field.width() - 1);
  const auto y0 = clip(std::floor(covered[1] - radius[1]), field.height() - 1);
  const auto x1 = clip(std::ceil(covered[2] + radius[0]) + 1, field.width());
  const auto y1 = clip(std::ceil(covered[3] + radius[1]) + 1, field.height());
  return {x0, y0, std::max(x1 - x0, 1), std::max(y1 - y0, 1)};
}

}  // namespace tinsmith
