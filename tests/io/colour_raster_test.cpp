#include "io/colour_raster.hpp"

#include <cmath>
#include <thread>

#include "support/colour_file.hpp"

namespace tinsmith {
namespace {

using test::ColourFile;

/// What every test changes where it is about. The grid of the terrain is 60 x 40 cells of 10 m.
ColourFile map_of_the_terrain() {
  ColourFile map;
  map.width = 60;
  map.height = 40;
  map.geotransform = {400000, 10, 0, 5100000, 0, -10};
  map.value = [](int band, int column, int row) { return band == 1 ? 4.0 * column : band == 2 ? 6.0 * row : 77.0; };
  return map;
}

class ColourRasterTest : public RasterTest {
 protected:
  static GridFrame terrain() {
    GridFrame frame;
    frame.geotransform = {400000, 10, 0, 5100000, 0, -10};
    frame.crs_wkt = wkt("EPSG:32632");
    return frame;
  }

  static std::string wkt(const std::string& name) {
    OGRSpatialReference crs;
    EXPECT_EQ(crs.SetFromUserInput(name.c_str()), OGRERR_NONE);
    char* text = nullptr;
    EXPECT_EQ(crs.exportToWkt(&text), OGRERR_NONE);
    std::string result = text;
    CPLFree(text);
    return result;
  }

  ColourGrid read_colours(const ColourFile& recipe) const {
    return ColourRaster(write_colours(path("ortho.tif"), recipe), terrain(), 60, 40).read({0, 0, 60, 40});
  }
};

// Of the default map: red runs along the columns, green along the rows.
void expect_map(const ColourGrid& grid, const GridRect& part, double slack) {
  for (std::int32_t y = part.y0; y < part.y0 + part.height; ++y) {
    for (std::int32_t x = part.x0; x < part.x0 + part.width; ++x) {
      ASSERT_NEAR(grid.channels[0].at(x, y), 4.0 * x, slack) << x << ", " << y;
      ASSERT_NEAR(grid.channels[1].at(x, y), 6.0 * y, slack) << x << ", " << y;
      ASSERT_NEAR(grid.channels[2].at(x, y), 77, 1e-3) << x << ", " << y;
    }
  }
}

TEST_F(ColourRasterTest, OfTheSameGridAreItsValues) {
  expect_map(read_colours(map_of_the_terrain()), {0, 0, 60, 40}, 1e-3);
}

TEST_F(ColourRasterTest, LieAtTheirPlacesWhenFinerCoarserAndShifted) {
  ColourFile finer = map_of_the_terrain();
  finer.width = 300;
  finer.height = 200;
  finer.geotransform = {400000, 2, 0, 5100000, 0, -2};
  finer.type = GDT_Byte;
  finer.value = [](int band, int column, int row) {
    const int five_columns = column / 5;
    const int five_rows = row / 5;
    return band == 1 ? 4.0 * five_columns : band == 2 ? 6.0 * five_rows : 77.0;
  };
  expect_map(read_colours(finer), {0, 0, 60, 40}, 0.01);
  ColourFile coarser = map_of_the_terrain();  // its first column and row hold no negative values
  coarser.width = 16;
  coarser.height = 11;
  coarser.geotransform = {399980, 40, 0, 5100020, 0, -40};
  coarser.value = [](int band, int column, int row) {
    return band == 1 ? 16.0 * column - 2 : band == 2 ? 24.0 * row - 3 : 77.0;
  };
  expect_map(read_colours(coarser), {4, 4, 50, 32}, 0.01);
}

TEST_F(ColourRasterTest, LieAtTheirPlacesWhenTheCrsIsAnother) {
  ColourFile recipe = map_of_the_terrain();
  recipe.crs = "EPSG:4326";
  recipe.width = 120;
  recipe.height = 80;
  recipe.type = GDT_Float32;
  // Around the terrain, with the map's values at the places that the UTM zone says.
  recipe.geotransform = {7.6950, 0.00008, 0, 46.0465, 0, -0.00006};
  OGRSpatialReference utm;
  OGRSpatialReference degrees;
  utm.SetFromUserInput("EPSG:32632");
  degrees.SetFromUserInput("EPSG:4326");
  utm.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  const std::unique_ptr<OGRCoordinateTransformation> back(OGRCreateCoordinateTransformation(&utm, &degrees));
  double west = 400000;
  double north = 5100000;
  ASSERT_TRUE(back->Transform(1, &west, &north));
  recipe.geotransform = {west - 0.0005, 0.00008, 0, north + 0.0005, 0, -0.00006};
  const std::unique_ptr<OGRCoordinateTransformation> to_utm(OGRCreateCoordinateTransformation(&degrees, &utm));
  const auto g = recipe.geotransform;
  recipe.value = [&](int band, int column, int row) {
    double x = g[0] + (column + 0.5) * g[1];
    double y = g[3] + (row + 0.5) * g[5];
    EXPECT_TRUE(to_utm->Transform(1, &x, &y));
    const double level = band == 1 ? 4 * ((x - 400000) / 10 - 0.5) : 6 * ((5100000 - y) / 10 - 0.5);
    return band == 3 ? 77.0 : std::clamp(level, 0.0, 255.0);
  };
  expect_map(read_colours(recipe), {2, 2, 54, 36}, 1.0);
}

TEST_F(ColourRasterTest, HaveNoColourWhereNodataAlphaOrNothingIs) {
  ColourFile alpha = map_of_the_terrain();
  alpha.bands = 4;
  alpha.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(4)->SetColorInterpretation(GCI_AlphaBand); };
  alpha.value = [](int band, int column, int) { return band < 4 ? 50.0 : column < 30 ? 255.0 : 0.0; };
  ColourFile nodata = map_of_the_terrain();
  nodata.declare = [](GDALDataset& dataset) {
    for (int b = 1; b <= 3; ++b) dataset.GetRasterBand(b)->SetNoDataValue(9);
  };
  nodata.value = [](int band, int column, int) { return column >= 30 || band == 1 ? 9.0 : 50.0; };
  ColourFile narrow = map_of_the_terrain();
  narrow.width = 30;
  for (const ColourFile& recipe : {alpha, nodata, narrow}) {
    const ColourGrid grid = read_colours(recipe);
    ASSERT_EQ(grid.channels.size(), 3U);
    for (const HeightGrid& channel : grid.channels) {
      EXPECT_FALSE(std::isnan(channel.at(28, 20)));
      EXPECT_TRUE(std::isnan(channel.at(32, 20)));
    }
  }
}

TEST_F(ColourRasterTest, ScaleOtherTypesByTheNextFullScale) {
  const auto level = [&](GDALDataType type, double value, double largest) {
    ColourFile recipe = map_of_the_terrain();
    recipe.bands = 1;
    recipe.type = type;
    recipe.value = [=](int, int column, int) { return column < 50 ? value : largest; };
    return read_colours(recipe).channels[0].at(20, 20);
  };
  EXPECT_NEAR(level(GDT_Byte, 3, 9), 3, 1e-4);
  EXPECT_NEAR(level(GDT_UInt16, 200, 250), 200, 1e-3);
  EXPECT_NEAR(level(GDT_UInt16, 2000, 4000), 2000 * 255.0 / 4095, 1e-3);
  EXPECT_NEAR(level(GDT_UInt16, 30000, 60000), 30000 * 255.0 / 65535, 1e-3);
  EXPECT_NEAR(level(GDT_Float32, 0.5, 0.9), 127.5, 1e-3);
  EXPECT_NEAR(level(GDT_Float32, -0.5, 0.9), 0, 1e-3);
}

TEST_F(ColourRasterTest, ExpandAPalette) {
  ColourFile recipe = map_of_the_terrain();
  recipe.bands = 1;
  recipe.declare = [](GDALDataset& dataset) {
    GDALColorTable table;
    const GDALColorEntry green{10, 200, 30, 255};
    const GDALColorEntry blue{1, 2, 220, 255};
    table.SetColorEntry(0, &green);
    table.SetColorEntry(1, &blue);
    dataset.GetRasterBand(1)->SetColorTable(&table);
  };
  recipe.value = [](int, int column, int) { return column < 30 ? 0 : 1; };
  const ColourGrid grid = read_colours(recipe);
  ASSERT_EQ(grid.channels.size(), 3U);
  EXPECT_EQ(grid.at(10, 10), (Levels{10, 200, 30, 0}));
  EXPECT_EQ(grid.at(50, 10), (Levels{1, 2, 220, 0}));
}

TEST_F(ColourRasterTest, AreTheSameWhateverTheRectangleAndTheThread) {
  ColourFile finer = map_of_the_terrain();
  finer.width = 190;
  finer.height = 130;
  finer.geotransform = {400003, 3.1, 0, 5100000, 0.1, -3.1};
  finer.value = [](int band, int column, int row) { return (column * 37 + row * 91 + band * 53) % 256; };
  const ColourRaster colours(write_colours(path("ortho.tif"), finer), terrain(), 60, 40);
  const ColourGrid whole = colours.read({-1, -1, 62, 42});
  std::vector<std::thread> threads;
  for (std::int32_t t = 0; t < 4; ++t) {
    threads.emplace_back([&, t] {
      const GridRect rect{13 * t, 7 * t - 1, 21, 15};
      const ColourGrid part = colours.read(rect);
      for (std::int32_t y = rect.y0; y < rect.y0 + rect.height; ++y) {
        for (std::int32_t x = rect.x0; x < rect.x0 + rect.width; ++x) {
          const double a = part.channels[1].at(x, y);
          const double b = whole.channels[1].at(x, y);
          EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << x << ", " << y;
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
}

TEST_F(ColourRasterTest, SayInOneLineWhyNot) {
  ColourFile five = map_of_the_terrain();
  five.bands = 5;
  expect_error<InputError>([&] { read_colours(five); }, {"ortho.tif", "5 bands", "gdal_translate -b"});
  ColourFile elsewhere = map_of_the_terrain();
  elsewhere.geotransform = {700000, 10, 0, 5100000, 0, -10};
  expect_error<InputError>([&] { read_colours(elsewhere); }, {"ortho.tif", "where the terrain lies", "gdalinfo"});
  expect_error<InputError>([&] { ColourRaster(path("none.tif"), terrain(), 60, 40); },
                           {"none.tif", "no such file"});
}

}  // namespace
}  // namespace tinsmith
