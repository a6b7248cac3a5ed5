#include "geodesy/grid_frame.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace tinsmith {
namespace {

GridFrame frame_of(const std::array<double, 6>& geotransform) {
  GridFrame frame;
  frame.geotransform = geotransform;
  return frame;
}

GridFrame degrees(const std::array<double, 6>& geotransform) {
  GridFrame frame = frame_of(geotransform);
  frame.is_geographic = true;
  frame.radians_per_unit = std::numbers::pi / 180;
  return frame;
}

std::vector<GridFrame> frames() {
  constexpr double kArcSeconds = 3.0 / 3600;
  return {frame_of({0, 1, 0, 0, 0, 1}),
          frame_of({399960, 30, 0, 5100000, 0, -30}),
          frame_of({635577, 3, 0, 853544, 0, -3}),
          frame_of({500000.25, 0.5, 0, 5000000.75, 0, -0.5}),
          frame_of({1000, 3, 1.25, 2000, -0.75, -4}),
          frame_of({-1e5, 25 * std::cos(0.3), 25 * std::sin(0.3), 2e5, 25 * std::sin(0.3), -25 * std::cos(0.3)}),
          degrees({7 - kArcSeconds / 2, kArcSeconds, 0, 46 + kArcSeconds / 2, 0, -kArcSeconds})};
}

TEST(GridFrame, SampleZeroLiesHalfACellInside) {
  const auto [x, y] = frame_of({100, 10, 0, 500, 0, -20}).to_crs(0, 0);
  EXPECT_EQ(x, 105);
  EXPECT_EQ(y, 490);
}

TEST(GridFrame, ToGridUndoesToCrsWithinABillionthOfACell) {
  std::mt19937_64 random(20240117);
  std::uniform_int_distribution<int> sixteenth(-16, 16 * 43200);
  for (const GridFrame& frame : frames()) {
    for (int i = 0; i < 5000; ++i) {
      const double column = sixteenth(random) / 16.0;
      const double row = sixteenth(random) / 16.0;
      const auto [x, y] = frame.to_crs(column, row);
      const auto [c, r] = frame.to_grid(x, y);
      ASSERT_NEAR(c, column, 1e-9) << frame.geotransform[0] << ' ' << row;
      ASSERT_NEAR(r, row, 1e-9) << frame.geotransform[0] << ' ' << column;
    }
  }
}

TEST(GridFrame, ASampleHasTheSameCoordinatesInEveryCropButForTheLastBit) {
  std::mt19937_64 random(5);
  std::uniform_int_distribution<int> place(0, 20000);
  for (const GridFrame& frame : frames()) {
    int n_equal = 0;
    constexpr int kTries = 2000;
    for (int i = 0; i < kTries; ++i) {
      const int column = place(random);
      const int row = place(random);
      const int c0 = place(random);
      const int r0 = place(random);
      const auto whole = frame.to_crs(column, row);
      const auto crop = frame.shifted(c0, r0).to_crs(column - c0, row - r0);
      n_equal += whole == crop ? 1 : 0;
      for (std::size_t axis = 0; axis < 2; ++axis) {
        const double size = std::max(std::abs(whole[axis]), std::abs(frame.shifted(c0, r0).geotransform[axis * 3]));
        ASSERT_NEAR(whole[axis], crop[axis], size * std::numeric_limits<double>::epsilon());
      }
    }
    EXPECT_GT(n_equal, kTries / 4);
  }
}

TEST(GridFrame, ACropOfWholeMetresIsExact) {
  const GridFrame frame = frame_of({399960, 30, 0, 5100000, 0, -30});
  EXPECT_EQ(frame.shifted(7, 11).to_crs(0, 0), frame.to_crs(7, 11));
  EXPECT_EQ(frame.shifted(7, 11).geotransform[0], 399960 + 7 * 30);
  EXPECT_EQ(frame.shifted(7, 11).geotransform[3], 5100000 - 11 * 30);
}

TEST(GridFrame, ProjectedStepsAreMetresWhateverTheUnit) {
  GridFrame feet = frame_of({635577, 3, 0, 853544, 0, -6});
  feet.metres_per_horizontal_unit = 0.3048;
  const auto [along_row, along_column] = feet.metres_per_step(10, 20);
  EXPECT_DOUBLE_EQ(along_row, 3 * 0.3048);
  EXPECT_DOUBLE_EQ(along_column, 6 * 0.3048);
}

TEST(GridFrame, RotatedStepsHaveTheLengthOfTheirVectors) {
  const auto [along_row, along_column] = frame_of({0, 3, 12, 0, 4, -5}).metres_per_step(0, 0);
  EXPECT_DOUBLE_EQ(along_row, 5);
  EXPECT_DOUBLE_EQ(along_column, 13);
}

TEST(GridFrame, DegreesAreAsLongAsTheGeodesicSays) {
  const GridFrame frame = degrees({0, 0.001, 0, 90, 0, -0.001});
  for (const double latitude : {-89.0, -60.0, 0.0, 30.0, 45.0, 46.5, 80.0}) {
    const double row = frame.to_grid(0, latitude)[1];
    const auto [along_row, along_column] = frame.metres_per_step(0, row);
    double east = 0;
    double north = 0;
    GeographicLib::Geodesic::WGS84().Inverse(latitude, 0, latitude, 0.001, east);
    GeographicLib::Geodesic::WGS84().Inverse(latitude - 0.0005, 0, latitude + 0.0005, 0, north);
    EXPECT_NEAR(along_row / east, 1, 1e-8) << latitude;
    EXPECT_NEAR(along_column / north, 1, 1e-8) << latitude;
  }
}

TEST(GridFrame, GradsOnASphereAreTheirShareOfItsGirth) {
  GridFrame frame = degrees({0, 1, 0, 10, 0, -1});
  frame.radians_per_unit = std::numbers::pi / 200;
  frame.equatorial_radius = 1000;
  frame.flattening = 0;
  const auto [x, y] = frame.metres_per_unit(0, frame.to_grid(0, 0)[1]);
  EXPECT_NEAR(x, 2000 * std::numbers::pi / 400, 1e-9);
  EXPECT_NEAR(y, 2000 * std::numbers::pi / 400, 1e-9);
}

TEST(GridFrame, StepsStayPositiveAtThePole) {
  const GridFrame frame = degrees({0, 0.25, 0, 90.125, 0, -0.25});
  EXPECT_DOUBLE_EQ(frame.to_crs(0, 0)[1], 90);
  EXPECT_GT(frame.metres_per_step(0, 0)[0], 10);
  EXPECT_LT(frame.metres_per_step(0, 0)[0], frame.metres_per_step(0, 1)[0]);
}

TEST(GridFrame, NorthUpRastersAreMirrored) {
  EXPECT_TRUE(frame_of({0, 1, 0, 0, 0, -1}).is_mirrored());
  EXPECT_FALSE(frame_of({0, 1, 0, 0, 0, 1}).is_mirrored());
  EXPECT_FALSE(frame_of({0, -1, 0, 0, 0, -1}).is_mirrored());
  EXPECT_TRUE(frame_of({0, 0, 1, 0, 1, 0}).is_mirrored());
}

}  // namespace
}  // namespace tinsmith
