// tinsmith compress --color and verify --color as a user has them.

#include <nlohmann/json.hpp>

#include "run_program.hpp"
#include "support/colour_file.hpp"

namespace tinsmith::test {
namespace {

class CliColour : public CliTest {
 protected:
  std::string ortho(int bands, const std::string& crs = "EPSG:32632", double west = 400000) const {
    return write_colours(path("ortho.tif"), {80,
                                             80,
                                             bands,
                                             [](int band, int x, int y) { return (x * band + 2 * y) % 256; },
                                             crs,
                                             {west, 15, 0, 5100000, 0, -15}});
  }
};

TEST_F(CliColour, ReportsTheSameErrorAsVerify) {
  const std::string dem = hill("dem.tif", 40);
  const std::string colours = ortho(3);
  const Outcome made = run({"compress", dem, path("dem.glb"), "--max-error", "1", "--color", colours, "--json", "-",
                            "--color-tolerance", "20"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome verified = run({"verify", dem, path("dem.glb"), "--color", colours, "--json", "-"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  const auto report = nlohmann::json::parse(made.out);
  const auto again = nlohmann::json::parse(verified.out);
  EXPECT_GT(report["color_rmse"].get<double>(), 0);
  EXPECT_LE(report["color_rmse"].get<double>(), report["color_max_error"].get<double>());
  for (const char* key : {"color_samples", "color_rmse", "color_max_error", "max_error"})
    EXPECT_EQ(report[key], again[key]) << key;
  EXPECT_NE(run({"verify", dem, path("dem.glb"), "--color", colours}).out.find("color_rmse"), std::string::npos);
  EXPECT_TRUE(
      nlohmann::json::parse(run({"verify", dem, path("dem.glb"), "--json", "-"}).out)["color_rmse"].is_null());
  const Outcome said = run({"compress", dem, path("dem.ply"), "--max-error", "1", "--color", colours});
  EXPECT_NE(said.out.find("of 255 levels"), std::string::npos) << said.out;
}

TEST_F(CliColour, SaysWhatIsWrongWithTheColours) {
  const std::string dem = hill("dem.tif", 40);
  const auto complains = [&](const std::string& colours, const std::string& output, int exit_code,
                             const std::vector<std::string>& says) {
    expect_complaint({"compress", dem, path(output), "--max-error", "1", "--color", colours}, exit_code, says);
  };
  complains(ortho(3), "dem.2dm", 2, {".2dm", "no colours"});
  complains(ortho(2), "dem.obj", 2, {".obj", "alpha"});
  complains(ortho(5), "dem.ply", 3, {"5 bands"});
  complains(ortho(3, "EPSG:32632", 500000), "dem.ply", 3, {"no colours where the terrain lies"});
  complains(path("none.tif"), "dem.ply", 3, {"none.tif"});
  expect_complaint({"compress", dem, path("dem.ply"), "--max-error", "1", "--color-tolerance", "3"}, 2,
                   {"--color FILE"});
  expect_complaint(
      {"compress", dem, path("dem.ply"), "--max-error", "1", "--color", ortho(3), "--color-tolerance", "0"}, 2,
      {"above 0"});
  EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "ortho.tif"}));
}

TEST_F(CliColour, WithoutAValueAreWhiteWithoutAWordOfTheLibrary) {
  RasterRecipe empty{.type = GDT_Float32, .values = std::vector<double>(6, -1)};
  empty.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-1); };
  const Outcome outcome = run(
      {"compress", hill("dem.tif", 40), path("dem.ply"), "--max-error", "1", "--color", write("void.tif", empty)});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(CliColour, TellsThatACrsIsMissing) {
  const std::string dem = hill("dem.tif", 40);
  const Outcome made = run({"compress", dem, path("dem.ply"), "--max-error", "1", "--color", ortho(3, "")});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("ortho.tif: has no CRS"), std::string::npos) << made.err;
}

}  // namespace
}  // namespace tinsmith::test
