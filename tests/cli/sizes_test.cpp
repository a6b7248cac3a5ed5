// Rasters of odd sizes and mostly nothing.

#include <algorithm>
#include <nlohmann/json.hpp>

#include "run_program.hpp"

namespace tinsmith::test {
namespace {

using nlohmann::json;

struct Island {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

class CliSizes : public CliTest {
 protected:
  /// A sparse GeoTIFF of tiles, of which only the islands are there: slopes with waves.
  std::string sparse(const std::string& name, int width, int height, const std::vector<Island>& islands) const {
    CPLStringList creation;
    for (const char* option : {"TILED=YES", "SPARSE_OK=TRUE", "BIGTIFF=YES", "BLOCKXSIZE=512"})
      creation.AddString(option);
    creation.SetNameValue("BLOCKYSIZE", height < 512 ? "32" : "512");
    GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
        path(name).c_str(), width, height, 1, GDT_Float32, creation.List()));
    std::array<double, 6> geotransform{400000, 1, 0, 5100000, 0, -1};
    dataset->SetGeoTransform(geotransform.data());
    OGRSpatialReference crs;
    crs.importFromEPSG(32632);
    dataset->SetSpatialRef(&crs);
    GDALRasterBand& band = *dataset->GetRasterBand(1);
    band.SetNoDataValue(-9999);
    for (const Island& island : islands) {
      std::vector<float> z = heights(island.width, island.height);
      EXPECT_EQ(band.RasterIO(GF_Write, island.x, island.y, island.width, island.height, z.data(), island.width,
                              island.height, GDT_Float32, 0, 0, nullptr),
                CE_None);
    }
    return path(name);
  }

  static std::vector<float> heights(int width, int height) {
    std::vector<float> z;
    z.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        z.push_back(static_cast<float>(0.2 * (x % 1000) + 20 * std::sin(x * 0.02) * std::cos(y * 0.05)));
    return z;
  }

  /// Certified, and reported.
  json compressed(const std::vector<std::string>& inputs, const std::vector<std::string>& options) const {
    std::vector<std::string> words{"compress"};
    words.insert(words.end(), inputs.begin(), inputs.end());
    words.push_back(path("out.ply"));
    words.insert(words.end(), options.begin(), options.end());
    for (const char* word : {"--json", "-"}) words.emplace_back(word);
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    if (outcome.exit_code != 0) return {};
    json report = json::parse(outcome.out);
    EXPECT_EQ(report["holds"], true);
    return report;
  }

  json planned(const std::string& input, const std::vector<std::string>& options) const {
    std::vector<std::string> words{"compress", input, path("out.ply"), "--plan", "--json", "-"};
    words.insert(words.end(), options.begin(), options.end());
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
  }
};

// A single row of samples has no surface: that is said at once. Two rows have one.
TEST_F(CliSizes, AStripOfAMillionColumns) {
  const std::string row = sparse("row.tif", 1000000, 1, {{0, 0, 1000000, 1}});
  expect_unusable(row, {"no 2 x 2 block of valid samples"});
  const json report = compressed({sparse("two.tif", 1000000, 2, {{0, 0, 1000000, 2}})}, {"--max-error", "5"});
  EXPECT_EQ(report["samples"], 2000000);
}

TEST_F(CliSizes, AStripOfAMillionRows) {
  const json report = compressed({sparse("tall.tif", 3, 1000000, {{0, 400000, 3, 1000}})}, {"--max-error", "5"});
  EXPECT_EQ(report["samples"], 3000);
}

TEST_F(CliSizes, TenMillionColumnsOfWhichAFewAreThere) {
  const std::string dem = sparse("wide.tif", 10000000, 20, {{0, 0, 3000, 20}, {9990000, 0, 10000, 20}});
  const json report = compressed({dem}, {"--max-error", "1"});
  EXPECT_EQ(report["samples"], 260000);
  EXPECT_LT(report["peak_memory_bytes"], 300e6);
}

TEST_F(CliSizes, NothingButACornerOfTenBillionSamples) {
  const std::string dem = sparse("corner.tif", 100000, 100000, {{99700, 99800, 300, 200}});
  const json plan = planned(dem, {"--max-error", "1"});
  EXPECT_LT(plan["windows"], 20);
  EXPECT_GT(plan["all_windows"], 150000);
  const json report = compressed({dem}, {"--max-error", "1"});
  EXPECT_EQ(report["samples"], 60000);
  EXPECT_EQ(report["components"], 1);
  EXPECT_LT(report["peak_memory_bytes"], 300e6);
}

TEST_F(CliSizes, NinetyBillionSamplesNearlyAllVoid) {
  const std::string dem =
      sparse("90g.tif", 300000, 300000,
             {{1000, 2000, 2000, 2000}, {150000, 150000, 1500, 1500}, {299000, 299500, 1000, 500}});
  const json plan = planned(dem, {"--max-error", "1", "--window", "256"});
  EXPECT_GT(plan["all_windows"], 1300000);
  EXPECT_LT(plan["windows"], 300);
  const json report = compressed({dem}, {"--max-error", "1"});
  EXPECT_EQ(report["samples"], 2000 * 2000 + 1500 * 1500 + 1000 * 500);
  EXPECT_EQ(report["components"], 3);
  EXPECT_LT(report["peak_memory_bytes"], 500e6);
}

// Of a square of 2 x 2 tiles one is missing.
TEST_F(CliSizes, AnLShapedMosaic) {
  std::vector<std::string> tiles;
  for (const int i : {0, 2, 3}) {
    const double x = 400000 + 2700 * (i % 2);
    const double y = 5100000 - 2700 * (i >= 2 ? 1 : 0);
    tiles.push_back(hill(std::to_string(i) + ".tif", 90, {.geotransform = {{x, 30, 0, y, 0, -30}}}));
  }
  const json report = compressed(tiles, {"--max-error", "2", "--window", "32"});
  EXPECT_EQ(report["samples"], 3 * 90 * 90);
  EXPECT_EQ(report["components"], 1);
  EXPECT_EQ(report["area_plan"], report["area_valid"]);
}

}  // namespace
}  // namespace tinsmith::test
