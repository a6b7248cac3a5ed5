// Where the samples lie, in what units; mosaics and crops.

#include <cmath>
#include <limits>
#include <map>

#include "geometry/lattice.hpp"
#include "raster_fixture.hpp"

namespace tinsmith {
namespace {

constexpr double kFoot = 0.3048;
constexpr double kUsFoot = 1200.0 / 3937.0;
constexpr double kArcSeconds = 3.0 / 3600;

using RasterGrid = RasterTest;

std::function<void(GDALDataset&)> unit(const char* name) {
  return [name](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetUnitType(name); };
}

// A height for every place of a common grid, so that a tile laid wrongly can't pass.
double height_at(int column, int row) { return 1000 + 10 * column + row; }

RasterRecipe tile(int column, int row, int width, int height) {
  RasterRecipe recipe{.width = width, .height = height};
  recipe.geotransform = {400000 + 30.0 * column, 30, 0, 5100000 - 30.0 * row, 0, -30};
  recipe.values.clear();
  for (int r = 0; r < height; ++r) {
    for (int c = 0; c < width; ++c) recipe.values.push_back(height_at(column + c, row + r));
  }
  return recipe;
}

TEST_F(RasterGrid, UnitsOfHeightComeFromTheOptionTheBandTheVerticalAxisTheProjectionInThisOrder) {
  const std::string all = write("a.tif", {.crs = "EPSG:2263+6360", .declare = unit("cm")});
  EXPECT_EQ(RasterField({all}, with_vertical_unit(0.5)).frame().metres_per_vertical_unit, 0.5);
  EXPECT_EQ(RasterField({all}, {}).frame().metres_per_vertical_unit, 0.01);
  const std::string axis = write("axis.tif", {.crs = "EPSG:2263+5703"});
  EXPECT_EQ(RasterField({axis}, {}).frame().metres_per_vertical_unit, 1);
  const RasterField projected({write("projected.tif", {.crs = "EPSG:2263"})}, {});
  EXPECT_DOUBLE_EQ(projected.frame().metres_per_vertical_unit, kUsFoot);
  EXPECT_DOUBLE_EQ(projected.frame().metres_per_horizontal_unit, kUsFoot);
  ASSERT_EQ(projected.remarks().size(), 1);
  EXPECT_NE(projected.remarks()[0].find("US survey feet"), std::string::npos) << projected.remarks()[0];
}

TEST_F(RasterGrid, MetresNeedNoRemark) {
  for (const char* crs : {"EPSG:32632", "EPSG:4979"}) {
    const RasterField field({write("dem.tif", {.crs = crs, .geotransform = {{7, 0.1, 0, 46, 0, -0.1}}})}, {});
    EXPECT_EQ(field.frame().metres_per_vertical_unit, 1);
    EXPECT_TRUE(field.remarks().empty()) << field.remarks()[0];
  }
}

TEST_F(RasterGrid, BandUnitsAreUnderstoodOrRefused) {
  const std::map<std::string, double> units{{"m", 1},        {"metre", 1},       {"ft", kFoot},
                                            {"foot", kFoot}, {"us-ft", kUsFoot}, {"US survey foot", kUsFoot}};
  for (const auto& [name, metres] : units) {
    const std::string dem = write("dem.tif", {.declare = unit(name.c_str())});
    EXPECT_DOUBLE_EQ(RasterField({dem}, {}).frame().metres_per_vertical_unit, metres) << name;
  }
  const std::string kelvin = write("kelvin.tif", {.declare = unit("K")});
  expect_error<InputError>([&] { RasterField({kelvin}, {}); }, {"kelvin.tif", "'K'", "--vertical-unit"});
  EXPECT_EQ(RasterField({kelvin}, with_vertical_unit(2)).frame().metres_per_vertical_unit, 2);
  for (const double wrong : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    expect_error<UsageError>([&] { RasterField({kelvin}, with_vertical_unit(wrong)); }, {"vertical unit"});
  }
}

TEST_F(RasterGrid, GeographicRastersHaveLongitudeFirst) {
  RasterRecipe recipe{.crs = "EPSG:4326"};
  recipe.geotransform = {7 - kArcSeconds / 2, kArcSeconds, 0, 46 + kArcSeconds / 2, 0, -kArcSeconds};
  const RasterField field({write("dem.tif", recipe)}, {});
  EXPECT_TRUE(field.frame().is_geographic);
  EXPECT_TRUE(field.frame().is_mirrored());
  EXPECT_NEAR(field.frame().to_crs(0, 0)[0], 7, 1e-14);
  EXPECT_NEAR(field.frame().to_crs(0, 0)[1], 46, 1e-14);
  EXPECT_NEAR(field.frame().metres_per_step(0, 0)[1], 92.6, 0.1);
  EXPECT_NEAR(field.frame().metres_per_step(0, 0)[0], 64.5, 0.1);
}

TEST_F(RasterGrid, MetresLabelledAsDegreesAreRefused) {
  const std::string dem = write("dem.tif", {.crs = "EPSG:4326"});
  expect_error<InputError>([&] { RasterField({dem}, {}); }, {"dem.tif", "latitude", "-a_srs"});
}

TEST_F(RasterGrid, WithoutCrsOrGeoreferenceUnitsAreAssumedAndSaidOnce) {
  RasterRecipe bare{.crs = ""};
  bare.geotransform.reset();
  const std::string dem = write("dem.tif", bare);
  const RasterField field({dem, dem}, {});
  EXPECT_EQ(field.frame().geotransform, (std::array<double, 6>{0, 1, 0, 0, 0, 1}));
  EXPECT_EQ(field.frame().metres_per_step(0, 0), (std::array<double, 2>{1, 1}));
  EXPECT_EQ(field.remarks().size(), 2);
}

TEST_F(RasterGrid, UnknownHorizontalUnitsAreRefused) {
  write("other.tif", {});
  const std::string vrt = write_text("unknown.vrt", R"(<VRTDataset rasterXSize="3" rasterYSize="2">
    <SRS>LOCAL_CS["site",UNIT["unknown",1]]</SRS><GeoTransform>0,1,0,0,0,-1</GeoTransform>
    <VRTRasterBand dataType="Int16" band="1"><SimpleSource><SourceFilename relativeToVRT="1">other.tif</SourceFilename>
    </SimpleSource></VRTRasterBand></VRTDataset>)");
  expect_error<InputError>([&] { RasterField({vrt}, {}); }, {"unknown.vrt", "site", "-a_srs"});
}

TEST_F(RasterGrid, ControlPointsAloneAreRefusedWithTheWayOut) {
  RasterRecipe recipe{.crs = ""};
  recipe.geotransform.reset();
  recipe.declare = [](GDALDataset& dataset) {
    std::array<GDAL_GCP, 4> points{};
    GDALInitGCPs(static_cast<int>(points.size()), points.data());
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].dfGCPPixel = static_cast<double>(i % 2) * 3;
      points[i].dfGCPLine = i < 2 ? 0 : 2;
      points[i].dfGCPX = points[i].dfGCPPixel + static_cast<double>(i);
      points[i].dfGCPY = -points[i].dfGCPLine;
    }
    OGRSpatialReference crs;
    crs.importFromEPSG(32632);
    ASSERT_EQ(dataset.SetGCPs(4, points.data(), &crs), CE_None);
    GDALDeinitGCPs(static_cast<int>(points.size()), points.data());
  };
  const std::string dem = write("dem.tif", recipe);
  expect_error<InputError>([&] { RasterField({dem}, {}); }, {"dem.tif", "control points", "gdalwarp"});
}

TEST_F(RasterGrid, ATurnedGeotransformIsKept) {
  RasterRecipe turned;
  turned.geotransform = {1000, 3, 4, 2000, 4, -3};
  const RasterField field({write("dem.tif", turned)}, {});
  EXPECT_EQ(field.frame().to_crs(0.5, -0.5), (std::array<double, 2>{1003, 2004}));
  EXPECT_EQ(field.frame().metres_per_step(0, 0), (std::array<double, 2>{5, 5}));
}

TEST_F(RasterGrid, AnLOfTilesIsOneGridWithAVoidCorner) {
  // Neighbours share their border row or column, as SRTM tiles do.
  const std::vector<std::string> tiles{write("east.tif", tile(4, 0, 5, 4)), write("corner.tif", tile(0, 0, 5, 4)),
                                       write("south.tif", tile(0, 3, 5, 4))};
  const RasterField field(tiles, {});
  ASSERT_EQ(field.width(), 9);
  ASSERT_EQ(field.height(), 7);
  EXPECT_EQ(field.frame().geotransform[0], 400000);
  EXPECT_EQ(field.frame().geotransform[3], 5100000);
  int n_void = 0;
  const HeightGrid grid = field.read({-2, -2, 13, 11});
  for (int row = -2; row < 9; ++row) {
    for (int column = -2; column < 11; ++column) {
      const bool is_there = column >= 0 && row >= 0 && column < 9 && row < 7 && (row < 4 || column < 5);
      ASSERT_EQ(grid.is_valid(column, row), is_there) << column << ' ' << row;
      if (is_there) {
        ASSERT_EQ(grid.at(column, row), height_at(column, row)) << column << " " << row;
      }
      n_void += is_there ? 0 : 1;
    }
  }
  EXPECT_EQ(n_void, 13 * 11 - (9 * 4 + 5 * 3));
}

TEST_F(RasterGrid, WhereTilesOverlapTheFirstValidSampleWins) {
  RasterRecipe first = tile(0, 0, 2, 1);
  first.values = {7, -1};
  first.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-1); };
  RasterRecipe second = tile(0, 0, 2, 1);
  second.values = {8, 9};
  const std::string a = write("a.tif", first);
  const std::string b = write("b.tif", second);
  EXPECT_EQ(read_all(RasterField({a, b}, {})).z, (std::vector<double>{7, 9}));
  EXPECT_EQ(read_all(RasterField({b, a}, {})).z, (std::vector<double>{8, 9}));
}

TEST_F(RasterGrid, GridsThatDoNotMatchAreRefusedByName) {
  const std::string a = write("a.tif", {});
  const auto expect_refused = [&](const RasterRecipe& recipe, const std::string& why) {
    const std::string b = write("b.tif", recipe);
    expect_error<InputError>([&] { RasterField({a, b}, {}); }, {"a.tif", "b.tif", why});
  };
  expect_refused({.crs = "EPSG:32633"}, "CRS");
  expect_refused({.crs = ""}, "CRS");
  expect_refused({.geotransform = {{400000, 25, 0, 5100000, 0, -25}}}, "cells");
  expect_refused({.geotransform = {{400000, 30, 0, 5100000, 0, 30}}}, "cells");
  expect_refused({.geotransform = {{400015, 30, 0, 5100000, 0, -30}}}, "shifted");
  expect_refused({.declare = unit("ft")}, "heights");
  RasterRecipe far;
  far.geotransform = {400000 + 30 * 1e9, 30, 0, 5100000, 0, -30};
  const std::string b = write("b.tif", far);
  expect_error<ResourceError>([&] { RasterField({a, b}, {}); }, {"samples", "--bbox"});
}

TEST_F(RasterGrid, TilesWhoseOriginsAreRoundedDecimalsMatch) {
  RasterRecipe west{.crs = "EPSG:4326"};
  west.geotransform = {7 - kArcSeconds / 2, kArcSeconds, 0, 46, 0, -kArcSeconds};
  RasterRecipe east = west;
  east.geotransform = {7.9995833333, 0.00083333333333, 0, 46.0000000001, 0, -0.00083333333333};
  const RasterField field({write("w.tif", west), write("e.tif", east)}, {});
  EXPECT_EQ(field.width(), 1203);
  EXPECT_EQ(field.height(), 2);
  EXPECT_EQ(field.read({1200, 1, 1, 1}).at(1200, 1), 4);
}

TEST_F(RasterGrid, ABoxKeepsTheSamplesInsideAndTheirPlaces) {
  const std::string dem = write("dem.tif", tile(0, 0, 20, 10));
  const RasterField whole({dem}, {});
  const auto [west, north] = whole.frame().to_crs(3, 2);
  const auto [east, south] = whole.frame().to_crs(12, 7);
  const RasterField part({dem}, with_bbox({west, south, east, north}));
  EXPECT_EQ(part.width(), 10);
  EXPECT_EQ(part.height(), 6);
  EXPECT_EQ(part.frame().to_crs(4, 3), whole.frame().to_crs(7, 5));
  const HeightGrid grid = part.read({-1, -1, 12, 8});
  EXPECT_EQ(grid.at(0, 0), height_at(3, 2));
  EXPECT_EQ(grid.at(9, 5), height_at(12, 7));
  EXPECT_FALSE(grid.is_valid(-1, 0));
  EXPECT_FALSE(grid.is_valid(10, 0));
  const RasterField inner({dem}, with_bbox({west + 1, south + 1, east - 1, north - 1}));
  EXPECT_EQ(inner.width(), 8);
  EXPECT_EQ(inner.height(), 4);
}

TEST_F(RasterGrid, ABoxCutsAMosaicAcrossItsTiles) {
  const std::vector<std::string> tiles{write("w.tif", tile(0, 0, 5, 4)), write("e.tif", tile(5, 0, 5, 4))};
  const RasterField whole(tiles, {});
  const auto [west, north] = whole.frame().to_crs(3, 1);
  const auto [east, south] = whole.frame().to_crs(6, 2);
  const HeightGrid grid = read_all(RasterField(tiles, with_bbox({west, south, east, north})));
  std::vector<double> expected;
  for (int row = 1; row <= 2; ++row) {
    for (int column = 3; column <= 6; ++column) expected.push_back(height_at(column, row));
  }
  EXPECT_EQ(grid.z, expected);
}

TEST_F(RasterGrid, ABoxOnATurnedGridHidesWhatLiesOutside) {
  RasterRecipe turned{.width = 20, .height = 20};
  turned.values.assign(400, 1);
  turned.geotransform = {0, 3, 4, 0, 4, -3};
  const std::string dem = write("dem.tif", turned);
  const RasterField whole({dem}, {});
  const std::array<double, 4> box{40, -20, 90, 30};
  int n_inside = 0;
  for (int row = 0; row < 20; ++row) {
    for (int column = 0; column < 20; ++column) {
      const auto [x, y] = whole.frame().to_crs(column, row);
      n_inside += x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3] ? 1 : 0;
    }
  }
  const RasterField part({dem}, with_bbox(box));
  const HeightGrid grid = read_all(part);
  int n_valid = 0;
  for (int row = 0; row < part.height(); ++row) {
    for (int column = 0; column < part.width(); ++column) {
      if (!grid.is_valid(column, row)) continue;
      const auto [x, y] = part.frame().to_crs(column, row);
      ASSERT_TRUE(x >= box[0] && x <= box[2] && y >= box[1] && y <= box[3]) << x << ' ' << y;
      ++n_valid;
    }
  }
  EXPECT_EQ(n_valid, n_inside);
  EXPECT_GT(n_inside, 50);
  EXPECT_LT(n_inside, part.width() * part.height());
}

TEST_F(RasterGrid, ABoxThatHoldsNoSampleIsAUsageError) {
  const std::string dem = write("dem.tif", {});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_error<UsageError>(
      [&] {
        RasterField({dem}, with_bbox({0, 0, 1, 1}));
      },
      {"no sample", "400000 5099940 400090 5100000"});
  expect_error<UsageError>(
      [&] {
        RasterField({dem}, with_bbox({400001, 5099941, 400002, 5099942}));
      },
      {"no sample"});
  expect_error<UsageError>([&] { RasterField({dem}, with_bbox({1, 0, 0, 1})); }, {"west south east north"});
  expect_error<UsageError>([&] { RasterField({dem}, with_bbox({0, 0, nan, 1})); }, {"west south east north"});
}

TEST_F(RasterGrid, OneSampleIsAGridToo) {
  const std::string dem = write("dem.tif", {.width = 1, .height = 1, .values = {42}});
  EXPECT_EQ(read_all(dem).z, std::vector<double>{42});
  EXPECT_TRUE(RasterField({dem}, {}).read({0, 0, 0, 0}).z.empty());
}

}  // namespace
}  // namespace tinsmith
