#include "tinsmith/render.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "io/raster_field.hpp"
#include "render/pixel_grid.hpp"
#include "scratch.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

using test::Picture;
using test::RasterRecipe;
using test::Rgb;
using test::Scratch;

const Progress silent;

int brightness(const Rgb& c) { return c.r + c.g + c.b; }

RasterRecipe hill() {
  return {64, 48, [](int x, int y) { return 300 - 8 * std::hypot(x - 32, y - 24); }};
}

// Draws one panel; its pixels start at the page's margin.
Picture draw(const Scratch& scratch, const RasterRecipe& recipe, const RenderOptions& options,
             const std::string& mesh = "") {
  test::write_raster(scratch.path("dem.tif"), recipe);
  render({scratch.path("dem.tif")}, mesh, scratch.path("out.png"), options);
  return Picture::load(scratch.path("out.png"));
}

constexpr int kMargin = 11;  // of a page with panels 320 pixels wide or less: 1.2 times the smallest type

TEST(Hillshade, IsBrightTowardsTheNorthWestAndDarkAwayFromIt) {
  const Scratch scratch;
  RenderOptions options;
  options.panel_width = 320;
  const Picture picture = draw(scratch, hill(), options);
  ASSERT_TRUE(picture.is_valid());
  const Rgb lit = picture.at(kMargin + 110, kMargin + 70);
  const Rgb shaded = picture.at(kMargin + 210, kMargin + 170);
  EXPECT_GT(brightness(lit), brightness(shaded) + 150);
}

TEST(Hillshade, ShowsVoidsGrey) {
  const Scratch scratch;
  RasterRecipe recipe = hill();
  recipe.z = [](int x, int y) { return x < 32 ? test::kNodata : 100.0 + y; };
  RenderOptions options;
  options.panel_width = 320;
  const Picture picture = draw(scratch, recipe, options);
  const Rgb hole = picture.at(kMargin + 50, kMargin + 100);
  EXPECT_LE(std::abs(hole.r - hole.g), 2);
  EXPECT_NEAR(hole.r, 219, 3);
  EXPECT_FALSE(picture.at(kMargin + 250, kMargin + 100) == hole);
}

// Mirrored and turned georeferences must not mirror or turn the picture: it is always north up.
TEST(Hillshade, IsTheSameForARasterStoredSouthUp) {
  const Scratch scratch;
  RenderOptions options;
  options.panel_width = 320;
  RasterRecipe north_up = hill();
  north_up.z = [](int x, int y) { return 3.0 * x + std::sin(y * 0.3) * 20; };
  RasterRecipe south_up = north_up;
  south_up.geotransform = {400000, 10, 0, 5100000 - 480, 0, 10};
  south_up.z = [&](int x, int y) { return north_up.z(x, 47 - y); };
  const Picture a = draw(scratch, north_up, options);
  const Picture b = draw(scratch, south_up, options);
  for (int y = 0; y < a.height(); y += 7)
    for (int x = 0; x < a.width(); x += 7) ASSERT_TRUE(a.at(x, y) == b.at(x, y)) << x << " " << y;
}

TEST(Wireframe, DarkensThePictureAlongEdges) {
  const Scratch scratch;
  const RasterRecipe flat{33, 33, [](int, int) { return 5.0; }};
  write_mesh(scratch.path("flat.ply"), test::thinned_grid(flat, 16), test::frame_of(flat));
  RenderOptions options;
  options.panel_width = 330;
  options.panels = {Panel::kWireframe};
  const Picture picture = draw(scratch, flat, options, scratch.path("flat.ply"));
  // The line through column 16 against the open ground beside it, off the diagonals.
  EXPECT_LT(brightness(picture.at(kMargin + 165, kMargin + 60)),
            brightness(picture.at(kMargin + 150, kMargin + 60)) - 50);
}

// One wrong sample among many thousands is in the picture, however small that is.
TEST(ErrorMap, ShowsTheLargestErrorAtAnyDensity) {
  const Scratch scratch;
  for (const double turn : {0.0, 0.3}) {
    for (const auto& wrong : {std::array{0, 0}, {299, 199}, {173, 91}, {0, 199}, {150, 100}}) {
      RasterRecipe recipe{300, 200, [](int x, int y) { return 10.0 + x + 2 * y; }};
      recipe.geotransform = {0, 10 * std::cos(turn), 10 * std::sin(turn),
                             0, 10 * std::sin(turn), -10 * std::cos(turn)};
      const TerrainMesh mesh = test::thinned_grid(recipe, 50);
      write_mesh(scratch.path("plane.ply"), mesh, test::frame_of(recipe));
      const auto plane = recipe.z;
      recipe.z = [&](int x, int y) { return plane(x, y) + (x == wrong[0] && y == wrong[1] ? 7.5 : 0); };
      test::write_raster(scratch.path("dem.tif"), recipe);
      const RasterField field({scratch.path("dem.tif")}, {});
      const Tin tin = read_mesh(scratch.path("plane.ply"));
      for (const int width : {16, 77, 300, 777}) {
        const View view = make_view(field.frame(), grid_extent(field.frame(), 300, 200), width);
        const PixelGrid errors = largest_errors(view, field, tin, {&silent, 0, 1});
        double lowest = 0;
        for (const double e : errors.value) lowest = std::min(lowest, std::isnan(e) ? 0 : e);
        EXPECT_NEAR(lowest, -7.5, 1e-6) << wrong[0] << " " << wrong[1] << " width " << width << " turn " << turn;
      }
    }
  }
}

TEST(ErrorMap, IsBlueWhereTheMeshIsTooLowAndRedWhereItIsTooHigh) {
  const Scratch scratch;
  const RasterRecipe flat{33, 33, [](int, int) { return 5.0; }};
  write_mesh(scratch.path("flat.ply"), test::thinned_grid(flat, 16), test::frame_of(flat));
  RasterRecipe uneven = flat;
  uneven.z = [](int x, int) { return x < 11 ? 7.0 : x < 22 ? 5.0 : 3.0; };
  RenderOptions options;
  options.panel_width = 330;
  options.panels = {Panel::kError};
  const Picture picture = draw(scratch, uneven, options, scratch.path("flat.ply"));
  const Rgb low = picture.at(kMargin + 50, kMargin + 160);
  const Rgb none = picture.at(kMargin + 165, kMargin + 160);
  const Rgb high = picture.at(kMargin + 280, kMargin + 160);
  EXPECT_GT(low.b, low.r + 80);
  EXPECT_GT(std::min({none.r, none.g, none.b}), 240);
  EXPECT_GT(high.r, high.b + 80);
}

TEST(Render, DrawsAMeshInItsColours) {
  const Scratch scratch;
  const RasterRecipe flat{33, 33, [](int, int) { return 5.0; }};
  TerrainMesh mesh = test::thinned_grid(flat, 4);
  mesh.n_channels = 3;
  for (const LatticePoint& place : mesh.position)
    mesh.colour.push_back(place.x <= 16 * kLatticePerCell ? Levels{200, 40, 10} : Levels{10, 60, 220});
  RenderOptions options;
  options.panel_width = 320;
  for (const std::string name : {"flat.ply", "flat.glb"}) {
    write_mesh(scratch.path(name), mesh, test::frame_of(flat));
    render({}, scratch.path(name), scratch.path("out.png"), options);
    const Picture picture = Picture::load(scratch.path("out.png"));
    EXPECT_EQ(picture.at(kMargin + 80, kMargin + 160), (Rgb{200, 40, 10})) << name;
    EXPECT_EQ(picture.at(kMargin + 240, kMargin + 160), (Rgb{10, 60, 220})) << name;
  }
}

TEST(Render, DrawsEveryPanelThatTheInputsAllow) {
  const Scratch scratch;
  const RasterRecipe recipe = hill();
  test::write_raster(scratch.path("dem.tif"), recipe);
  write_mesh(scratch.path("dem.glb"), test::thinned_grid(recipe, 4), test::frame_of(recipe));
  RenderOptions options;
  options.panel_width = 200;
  const auto width = [&](const std::vector<std::string>& rasters, const std::string& mesh) {
    render(rasters, mesh, scratch.path("out.png"), options);
    return Picture::load(scratch.path("out.png")).width();
  };
  const int one = width({scratch.path("dem.tif")}, "");
  EXPECT_GE(one, 200);
  EXPECT_GE(width({}, scratch.path("dem.glb")), 2 * 200);
  EXPECT_GE(width({scratch.path("dem.tif")}, scratch.path("dem.glb")), 3 * 200);
  EXPECT_EQ(scratch.n_files(), 3U) << "nothing but the inputs and the picture is left";
}

TEST(Render, DrawsTheSmallestRasters) {
  const Scratch scratch;
  for (const auto& [width, height] : {std::array{1, 1}, {1, 500}, {500, 1}, {2, 2}}) {
    RenderOptions options;
    options.panel_width = 100;
    const Picture picture = draw(scratch, {width, height, [](int x, int y) { return 1.0 * x + y; }}, options);
    EXPECT_TRUE(picture.is_valid()) << width << " x " << height;
  }
}

TEST(Render, DrawsTheSamePictureEachTime) {
  const Scratch scratch;
  RenderOptions options;
  options.panel_width = 150;
  const auto bytes = [&] {
    draw(scratch, hill(), options);
    std::ifstream file(scratch.path("out.png"), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(Render, RefusesWhatMakesNoSense) {
  const Scratch scratch;
  test::write_raster(scratch.path("dem.tif"), hill());
  const std::vector<std::string> dem{scratch.path("dem.tif")};
  RenderOptions options;
  EXPECT_THROW(render({}, "", scratch.path("a.png"), options), UsageError);
  EXPECT_THROW(render(dem, "", scratch.path("a.jpg"), options), UsageError);
  options.panels = {Panel::kError};
  EXPECT_THROW(render(dem, "", scratch.path("a.png"), options), UsageError);
  options.panels = {Panel::kWireframe};
  EXPECT_THROW(render(dem, "", scratch.path("a.png"), options), UsageError);
  options.panels = {};
  for (const int width : {-1, 0, 100000}) {
    options.panel_width = width;
    EXPECT_THROW(render(dem, "", scratch.path("a.png"), options), UsageError);
  }
  options.panel_width = 100;
  options.scale = std::nan("");
  EXPECT_THROW(render(dem, "", scratch.path("a.png"), options), UsageError);
  EXPECT_EQ(scratch.n_files(), 1U);
}

TEST(Render, LeavesTheOldPictureWhenItIsStopped) {
  const Scratch scratch;
  test::write_raster(scratch.path("dem.tif"), hill());
  std::ofstream(scratch.path("old.png")) << "old";
  RenderOptions options;
  options.progress = [](double, std::string_view) { return false; };
  EXPECT_THROW(render({scratch.path("dem.tif")}, "", scratch.path("old.png"), options), Interrupted);
  EXPECT_THROW(render({scratch.path("no.tif")}, "", scratch.path("old.png"), {}), InputError);
  EXPECT_THROW(render({scratch.path("dem.tif")}, "", scratch.path("no/folder.png"), {}), OutputError);
  std::ifstream file(scratch.path("old.png"));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), "old");
  EXPECT_EQ(scratch.n_files(), 2U);
}

}  // namespace
}  // namespace tinsmith
