// Files that can't be used, and files that many threads use at once.

#include <sys/resource.h>

#include <atomic>
#include <random>
#include <thread>

#include "raster_fixture.hpp"

namespace tinsmith {
namespace {

using RasterFiles = RasterTest;

void expect_refused(const std::string& path, const std::vector<std::string>& words) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  expect_error<InputError>([&] { read_all(path); }, words);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(RasterFiles, EachFileThatIsNoRasterIsRefusedInOneQuietLine) {
  expect_refused(path("missing.tif"), {"missing.tif", "no such file"});
  expect_refused(write_text("text.tif", "these are no heights\n"), {"text.tif", "not a raster"});
  expect_refused(write_text("empty.tif", ""), {"empty.tif", "empty"});
  expect_refused(path(""), {"folder"});
  expect_refused("", {"empty"});
  expect_refused(write_text("damaged.tif", std::string("II*\0\x08\0\0\0\xff\xff\xff\xff", 12)), {"damaged.tif"});
  expect_refused(write_text("points.geojson", R"({"type":"FeatureCollection","features":[{"type":"Feature",
    "properties":{},"geometry":{"type":"Point","coordinates":[1,2]}}]})"),
                 {"points.geojson", "vector", "gdal_grid"});
  EXPECT_THROW(RasterField({}, {}), UsageError);
}

TEST_F(RasterFiles, AContainerOfRastersNamesTheFirst) {
  auto* netcdf = GetGDALDriverManager()->GetDriverByName("netCDF");
  if (netcdf == nullptr) GTEST_SKIP() << "GDAL has no netCDF here";
  const GDALDatasetUniquePtr two(
      GetGDALDriverManager()->GetDriverByName("MEM")->Create("", 3, 2, 2, GDT_Int16, nullptr));
  GDALClose(netcdf->CreateCopy(path("two.nc").c_str(), two.get(), 0, nullptr, nullptr, nullptr));
  expect_refused(path("two.nc"), {"two.nc", "holds 2 rasters", "NETCDF:", ":Band1"});
}

TEST_F(RasterFiles, ACutFileFailsWithTheFileAndThePlace) {
  RasterRecipe recipe{.width = 300, .height = 200};
  recipe.values.assign(300 * 200, 5);
  for (const std::vector<std::string>& creation : {std::vector<std::string>{},
                                                   {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=64"},
                                                   {"BIGTIFF=YES", "BLOCKYSIZE=1"}}) {
    recipe.creation = creation;
    const std::string dem = write("cut.tif", recipe);
    std::filesystem::resize_file(dem, std::filesystem::file_size(dem) * 2 / 3);
    expect_refused(dem, {"cut.tif", "rows 0 to 199", "cut short"});
    const RasterField field({dem}, {});
    EXPECT_EQ(field.read({0, 0, 60, 20}).at(0, 0), 5) << "what is whole can be read";
  }
}

TEST_F(RasterFiles, RandomDamageNeverCrashes) {
  RasterRecipe recipe{.width = 60, .height = 40, .creation = {"COMPRESS=DEFLATE"}};
  recipe.values.resize(60 * 40);
  std::mt19937_64 random(77);
  for (double& z : recipe.values) z = static_cast<double>(random() % 3000);
  const std::string dem = write("dem.tif", recipe);
  std::ifstream file(dem, std::ios::binary);
  const std::string whole((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  int n_refused = 0;
  testing::internal::CaptureStderr();
  for (int i = 0; i < 300; ++i) {
    std::string damaged = whole;
    const std::size_t range = i % 2 == 0 ? 400 : damaged.size();  // the header, anywhere
    for (int k = 0; k < 4; ++k) damaged[random() % range] = static_cast<char>(random());
    try {
      const RasterField field({write_text("damaged.tif", damaged)}, {});
      if (field.width() <= 4096 && field.height() <= 4096) read_all(field);
    } catch (const Error&) {
      ++n_refused;
    }
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_GT(n_refused, 100);
}

TEST_F(RasterFiles, ManyThreadsReadTheSameHeights) {
  constexpr int kSide = 257;
  constexpr int kRect = 40;
  std::vector<std::string> tiles;
  for (int t = 0; t < 4; ++t) {
    RasterRecipe recipe{.width = kSide,
                        .height = kSide,
                        .creation = {"TILED=YES", "COMPRESS=DEFLATE", "BLOCKXSIZE=64", "BLOCKYSIZE=64"}};
    const int c0 = t % 2 * (kSide - 1);
    const int r0 = t / 2 * (kSide - 1);
    recipe.geotransform = {30.0 * c0, 30, 0, -30.0 * r0, 0, -30};
    recipe.values.clear();
    for (int i = 0; i < kSide * kSide; ++i) {
      const int row = i / kSide;
      recipe.values.push_back((c0 + i % kSide) * 7 % 1000 + r0 + row);
    }
    tiles.push_back(write("tile" + std::to_string(t) + ".tif", recipe));
  }
  const RasterField field(tiles, {});
  std::atomic<int> n_wrong = 0;
  std::atomic<int> n_read = 0;
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 8; ++seed) {
    threads.emplace_back([&, seed] {
      std::mt19937 random(seed);
      for (int i = 0; i < 100; ++i) {
        const auto x0 = static_cast<std::int32_t>(random() % (field.width() - kRect));
        const auto y0 = static_cast<std::int32_t>(random() % (field.height() - kRect));
        const HeightGrid grid = field.read({x0, y0, kRect, kRect});
        for (std::int32_t y = y0; y < y0 + kRect; ++y) {
          for (std::int32_t x = x0; x < x0 + kRect; ++x) n_wrong += grid.at(x, y) == x * 7 % 1000 + y ? 0 : 1;
        }
        ++n_read;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(n_wrong, 0);
  EXPECT_EQ(n_read, 800);
}

TEST_F(RasterFiles, MoreTilesThanTheSystemLetsOpenMakeOneGrid) {
  constexpr int kTiles = 200;
  std::vector<std::string> tiles;
  for (int t = 0; t < kTiles; ++t) {
    RasterRecipe recipe{.width = 1, .height = 1, .values = {static_cast<double>(t)}};
    recipe.geotransform = {30.0 * t, 30, 0, 0, 0, -30};
    tiles.push_back(write("tile" + std::to_string(t) + ".tif", recipe));
  }
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_NOFILE, &usual), 0);
  rlimit few = usual;
  few.rlim_cur = kTiles / 2;
  ASSERT_EQ(setrlimit(RLIMIT_NOFILE, &few), 0);
  const HeightGrid grid = read_all(RasterField(tiles, {}));
  setrlimit(RLIMIT_NOFILE, &usual);
  ASSERT_EQ(grid.z.size(), kTiles);
  for (int t = 0; t < kTiles; ++t) EXPECT_EQ(grid.at(t, 0), t);
}

}  // namespace
}  // namespace tinsmith
