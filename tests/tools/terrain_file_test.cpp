// The program make_terrain writes the terrain of the library, whatever the type, and says what it refuses.

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrain.hpp"

namespace tinsmith {
namespace {

using File = std::unique_ptr<GDALDataset>;

class MakeTerrain : public testing::Test {
 protected:
  void SetUp() override {
    GDALAllRegister();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("make_terrain_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string path() const { return (folder_ / "t.tif").string(); }

  /// Runs the program; its exit code.
  int run(const std::string& options) const {
    const std::string command = TINSMITH_BINARY_DIR "/make_terrain " + path() + " " + options + " 2>/dev/null";
    const int status = std::system(command.c_str());  // NOLINT(cert-env33-c): the test's own program
    return WEXITSTATUS(status);
  }

  File open() const { return File(GDALDataset::FromHandle(GDALOpen(path().c_str(), GA_ReadOnly))); }

  bool is_folder_empty() const { return std::filesystem::is_empty(folder_); }

 private:
  std::filesystem::path folder_;
};

std::vector<double> values_of(GDALDataset& file) {
  const int width = file.GetRasterXSize();
  const int height = file.GetRasterYSize();
  std::vector<double> z(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  EXPECT_EQ(file.GetRasterBand(1)->RasterIO(GF_Read, 0, 0, width, height, z.data(), width, height, GDT_Float64, 0,
                                            0, nullptr),
            CE_None);
  return z;
}

TEST_F(MakeTerrain, WritesTheTerrainOfTheLibraryInEveryType) {
  const Terrain terrain{.voids = VoidKind::kHoles, .seed = 9, .width = 700, .height = 530};
  const HeightGrid expected = heights_of(terrain, {0, 0, 700, 530});
  for (const auto& [type, step] : {std::pair{"int16", 0.5}, {"int32", 0.5}, {"float32", 1e-3}, {"float64", 0.0}}) {
    ASSERT_EQ(run(std::string("--size 700x530 --seed 9 --voids holes --type ") + type), 0);
    const File file = open();
    ASSERT_TRUE(file);
    const double nodata = file->GetRasterBand(1)->GetNoDataValue();
    const std::vector<double> z = values_of(*file);
    for (std::size_t i = 0; i < z.size(); ++i) {
      const bool is_void = std::isnan(nodata) ? std::isnan(z[i]) : z[i] == nodata;
      ASSERT_EQ(is_void, std::isnan(expected.z[i])) << type;
      ASSERT_TRUE(is_void || std::abs(z[i] - expected.z[i]) <= step) << type;
    }
  }
}

TEST_F(MakeTerrain, BlocksThatAreAllVoidTakeNoSpace) {
  ASSERT_EQ(run("--size 6144x6144 --kind flat --voids square --type int16"), 0);
  const File file = open();
  ASSERT_TRUE(file);
  EXPECT_EQ(file->GetRasterBand(1)->GetMetadataItem("BLOCK_OFFSET_6_6", "TIFF"), nullptr);
  EXPECT_NE(file->GetRasterBand(1)->GetMetadataItem("BLOCK_OFFSET_0_0", "TIFF"), nullptr);
  double middle = 0;
  ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Read, 3072, 3072, 1, 1, &middle, 1, 1, GDT_Float64, 0, 0, nullptr),
            CE_None);
  EXPECT_EQ(middle, -32768);
}

TEST_F(MakeTerrain, GeoreferencesInMetresDegreesOrNothing) {
  ASSERT_EQ(run("--size 10x10 --cell 25"), 0);
  double transform[6];
  ASSERT_EQ(open()->GetGeoTransform(transform), CE_None);
  EXPECT_EQ(transform[1], 25);
  EXPECT_EQ(transform[5], -25);
  ASSERT_EQ(run("--size 10x10 --cell 111319.49079327358 --crs 4326"), 0);
  ASSERT_EQ(open()->GetGeoTransform(transform), CE_None);
  EXPECT_EQ(transform[1], 1);
  ASSERT_EQ(run("--size 10x10 --crs none"), 0);
  EXPECT_EQ(open()->GetSpatialRef(), nullptr);
}

TEST_F(MakeTerrain, RefusesWhatItCannotMakeAndLeavesNothing) {
  for (const char* options :
       {"--size 12", "--size 0x5", "--size 5x5x5", "--kind hill", "--voids all", "--type int8", "--cell 0",
        "--cell nan", "--crs UTM", "--amplitude inf", "--nonsense"}) {
    EXPECT_EQ(run(options), 2) << options;
  }
  EXPECT_EQ(run("--crs 99999"), 4);
  EXPECT_TRUE(is_folder_empty());
}

}  // namespace
}  // namespace tinsmith
