// VRTs whose tiles are gone: nothing of them passes for a void.

#include <gdal_utils.h>

#include <cmath>

#include "raster_fixture.hpp"

namespace tinsmith {
namespace {

class Vrt : public RasterTest {
 protected:
  static constexpr int kSide = 300;

  // Two tiles side by side.
  std::vector<std::string> two_tiles() const {
    RasterRecipe recipe{.width = kSide, .height = kSide};
    recipe.values.assign(static_cast<std::size_t>(kSide) * kSide, 7);
    recipe.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-32768); };
    const std::string left = write("left.tif", recipe);
    (*recipe.geotransform)[0] += 30.0 * kSide;
    return {left, write("right.tif", recipe)};
  }

  std::string build(const std::string& name, const std::vector<std::string>& of) const {
    std::vector<const char*> names;
    for (const std::string& one : of) names.push_back(one.c_str());
    GDALClose(
        GDALBuildVRT(path(name).c_str(), static_cast<int>(of.size()), nullptr, names.data(), nullptr, nullptr));
    return path(name);
  }

  // As gdal_translate -of VRT makes it.
  std::string wrap(const std::string& name, const std::string& tile) const {
    const GDALDatasetUniquePtr source(GDALDataset::Open(tile.c_str()));
    GDALClose(GetGDALDriverManager()->GetDriverByName("VRT")->CreateCopy(path(name).c_str(), source.get(), 0,
                                                                         nullptr, nullptr, nullptr));
    return path(name);
  }

  // Each way to lay VRTs over the two tiles, the left of which is gone then.
  std::vector<std::vector<std::string>> inputs_that_lack_a_tile() const {
    const std::vector<std::string> tiles = two_tiles();
    const std::vector<std::string> wrapped{wrap("left.vrt", tiles[0]), wrap("right.vrt", tiles[1])};
    std::vector<std::vector<std::string>> inputs{
        wrapped,
        {build("built_left.vrt", {tiles[0]}), tiles[1]},
        {build("both.vrt", tiles)},
        {build("both_wrapped.vrt", wrapped)},
        {build("both_built.vrt", {path("built_left.vrt"), tiles[1]})},
    };
    std::filesystem::remove(tiles[0]);
    return inputs;
  }
};

TEST_F(Vrt, ThatLacksATileIsRefusedByTheTilesName) {
  for (const auto& inputs : inputs_that_lack_a_tile()) {
    SCOPED_TRACE(inputs.front());
    for (const GridRect& rect : {GridRect{0, 0, 100, 100}, GridRect{200, 0, 200, 100}}) {
      const RasterField field(inputs, {});
      expect_error<UnreadableError>(
          [&] {
            if (!field.is_surely_void(rect)) field.read(rect);
          },
          {inputs.front(), "left.tif", "--skip-unreadable"});
    }
    EXPECT_EQ(RasterField(inputs, {}).read({400, 0, 100, 100}).at(450, 50), 7) << "what is there can be read";
  }
}

TEST_F(Vrt, ThatLacksATileLeavesACountedVoidWhenThatIsSkipped) {
  InputOptions options;
  options.skip_unreadable = true;
  for (const auto& inputs : inputs_that_lack_a_tile()) {
    SCOPED_TRACE(inputs.front());
    const RasterField field(inputs, options);
    EXPECT_FALSE(field.is_surely_void({0, 0, 100, 100}));
    EXPECT_TRUE(std::isnan(field.read({0, 0, 100, 100}).at(50, 50)));
    EXPECT_EQ(field.read({500, 0, 100, 100}).at(550, 50), 7);
    EXPECT_EQ(field.n_unreadable(), 1U);
  }
}

TEST_F(Vrt, OfGapsIsVoidWithoutReading) {
  const std::vector<std::string> tiles = two_tiles();
  RasterRecipe far{.width = 1, .height = 1, .values = {7}};
  far.geotransform = {400000 + 30.0 * 200000, 30, 0, 5100000 - 30.0 * 200000, 0, -30};
  far.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-32768); };
  const RasterField field({build("gaps.vrt", {tiles[0], write("far.tif", far)})}, {});
  EXPECT_TRUE(field.is_surely_void({1000, 1000, 150000, 150000}));
  EXPECT_FALSE(field.is_surely_void({0, 0, 1000, 1000}));
}

}  // namespace
}  // namespace tinsmith
