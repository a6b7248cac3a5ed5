#include "render/view.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "samples/height_grid.hpp"

namespace tinsmith {
namespace {

GridFrame projected(double step) {
  GridFrame frame;
  frame.geotransform = {1000, step, 0, 2000, 0, -step};
  return frame;
}

// A size without samples.
class HugeField : public HeightField {
 public:
  std::int32_t width() const override { return 300000; }
  std::int32_t height() const override { return 300000; }
  HeightGrid read(const GridRect& rect) const override { return {rect, {}}; }
};

TEST(View, ShowsTheOutlineOfAllCells) {
  const Extent extent = grid_extent(projected(10), 30, 20);
  EXPECT_EQ(extent, (Extent{1000, 1800, 1300, 2000}));
}

TEST(View, HasTheProportionsOfTheGround) {
  const View view = make_view(projected(10), {0, 0, 300, 200}, 600);
  EXPECT_EQ(view.width, 600);
  EXPECT_EQ(view.height, 400);
}

TEST(View, ShowsADegreeAtSixtyNorthTwiceAsHighAsWide) {
  GridFrame frame;
  frame.geotransform = {10, 0.01, 0, 60.5, 0, -0.01};
  frame.is_geographic = true;
  frame.radians_per_unit = 3.14159265358979 / 180;
  const View view = make_view(frame, {10, 59.5, 11, 60.5}, 500);
  EXPECT_NEAR(view.height, 1000, 10);
}

TEST(View, KeepsALongStripWithinFourTimesItsWidth) {
  const View view = make_view(projected(1), {0, 0, 1, 10000}, 800);
  EXPECT_LE(view.height, 3200);
  EXPECT_GE(view.width, 1);
}

TEST(View, ToPixelUndoesToCrs) {
  const View view = make_view(projected(10), {1000, 1800, 1300, 2000}, 600);
  const auto [x, y] = view.to_crs(123.25, 45.5);
  const auto [px, py] = view.to_pixel(x, y);
  EXPECT_NEAR(px, 123.25, 1e-9);
  EXPECT_NEAR(py, 45.5, 1e-9);
}

TEST(Tiles, CoverEveryPixelOnce) {
  View view;
  view.width = 700;
  view.height = 431;
  for (const double density : {0.1, 1.0, 77.0, 5000.0}) {
    std::vector<int> times(700 * 431, 0);
    for (const PixelRect& tile : tiles(view, {density, density / 2}))
      for (int y = tile.y0; y < tile.y0 + tile.height; ++y)
        for (int x = tile.x0; x < tile.x0 + tile.width; ++x)
          ++times[static_cast<std::size_t>(y) * 700 + static_cast<std::size_t>(x)];
    EXPECT_EQ(std::count(times.begin(), times.end(), 1), 700 * 431) << density;
  }
}

// What a picture of a huge raster reads at once stays small.
TEST(Tiles, HaveFewSamplesUnderThem) {
  const GridFrame frame = projected(1);
  const HugeField field;
  const View view = make_view(frame, grid_extent(frame, field.width(), field.height()), 800);
  const auto density = samples_per_pixel(view, frame);
  EXPECT_NEAR(density[0], 375, 1e-6);
  for (const PixelRect& tile : tiles(view, density))
    EXPECT_LT(samples_under(view, frame, tile, density, field).area(), 10000000);
}

}  // namespace
}  // namespace tinsmith
