#include "pipeline/typical_area.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "pipeline_fixture.hpp"

namespace tinsmith {
namespace {

using namespace test;

double area_of(const HeightGrid& grid, double tolerance) { return typical_area(GridField(grid), tolerance); }

TEST(TypicalArea, IsHalfABlockOfAPlane) {
  const auto plane = [](int x, int y) { return 0.1 * x - 0.3 * y; };
  EXPECT_EQ(area_of(grid_of(65, 65, plane), 1), 2048);
  EXPECT_EQ(area_of(grid_of(700, 400, plane), 1), 2048);
  EXPECT_EQ(area_of(grid_of(700, 400, plane), 0), 2048);  // and 0.1 is no number of a double
}

TEST(TypicalArea, IsHalfACellOfABoard) {
  EXPECT_EQ(area_of(grid_of(300, 200, [](int x, int y) { return (x + y) % 2; }), 0.4), 0.5);
}

TEST(TypicalArea, IsWithoutEndWhereThereAreNoTriangles) {
  for (const auto& [width, height] : {std::pair{300, 200}, {1, 500}, {500, 1}, {1, 1}})
    EXPECT_TRUE(std::isinf(area_of(grid_of(width, height, [](int, int) { return kVoid; }), 1)));
  EXPECT_TRUE(std::isinf(area_of(grid_of(1, 500, [](int, int y) { return y; }), 1)));
}

// A sixteenth of the ground is rough and has most of the triangles.
TEST(TypicalArea, TellsOfWhereTheTrianglesAre) {
  const double area =
      area_of(grid_of(1000, 1000, [](int x, int y) { return x < 250 && y < 250 ? (x + y) % 2 : 0; }), 0.4);
  EXPECT_GE(area, 0.5);
  EXPECT_LT(area, 1);
}

TEST(TypicalArea, GrowsWithTheTolerance) {
  double before = 0;
  for (const double tolerance : {1.0, 5.0, 20.0, 100.0}) {
    const double area = typical_area(matterhorn(), tolerance);
    EXPECT_GT(area, before) << tolerance;
    before = area;
  }
}

TEST(TypicalArea, ReadsASmallPartOfTheField) {
  for (const auto& [width, height] : {std::pair{1025, 1025}, {4000, 500}}) {
    const CountedField field(mountains(width, height, 441));
    typical_area(field, 20);
    EXPECT_GT(field.n_samples(), 0);
    EXPECT_LT(field.n_samples(), std::int64_t{width} * height / 6);
  }
}

}  // namespace
}  // namespace tinsmith
