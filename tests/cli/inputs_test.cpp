// Inputs as a user names them: lists, overlaps, files that can't be read.

#include <nlohmann/json.hpp>

#include "run_program.hpp"

namespace tinsmith::test {
namespace {

using CliInputs = CliTest;

TEST_F(CliInputs, AListStandsForItsFilesInEveryVerb) {
  const std::string west = hill("west.tif", 20);
  const std::string east = hill("east.tif", 20, {.geotransform = {{400600, 30, 0, 5100000, 0, -30}}});
  const std::string list = "@" + write_text("list.txt", west + "\n" + east + "\n");
  const Outcome by_list = run({"compress", list, path("list.ply"), "--max-error", "1"});
  ASSERT_EQ(by_list.exit_code, 0) << by_list.err;
  ASSERT_EQ(run({"compress", west, east, path("named.ply"), "--max-error", "1"}).exit_code, 0);
  EXPECT_EQ(text_of(path("list.ply")), text_of(path("named.ply")));
  EXPECT_EQ(run({"verify", list, path("list.ply"), "--max-error", "1"}).exit_code, 0);
  expect_unusable("@" + path("none.txt"), {"none.txt", "list of inputs", "check the path"});
  const Outcome info = run({"info", list});
  EXPECT_EQ(info.exit_code, 0) << info.err;
  for (const char* part : {"list of 2 inputs", "40 x 20 samples", "800 samples, 100 %"})
    EXPECT_NE(info.out.find(part), std::string::npos) << part << " in: " << info.out;
  for (const char* verb : {"compress", "verify"})
    expect_complaint({verb, list, path("list.ply"), "--max-error", "1", "--json", east}, 2,
                     {"east.tif", "is an input too"});
}

TEST_F(CliInputs, TheOverlapThatCountsIsChosenAndADisagreementIsTold) {
  const std::string a = hill("a.tif", 20);
  const std::string b = hill("b.tif", 20, {.geotransform = {{400300, 30, 0, 5100000, 0, -30}}});
  const Outcome first = run({"compress", a, b, path("first.ply"), "--max-error", "1"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_NE(first.err.find("a.tif and"), std::string::npos) << first.err;
  EXPECT_NE(first.err.find("200 of 200 samples"), std::string::npos) << first.err;
  const Outcome told = run({"compress", a, b, path("first.ply"), "--max-error", "1", "--quiet", "--json", "-"});
  EXPECT_EQ(nlohmann::json::parse(told.out)["remarks"].size(), 1U) << told.out;
  ASSERT_EQ(run({"compress", b, a, path("swapped.ply"), "--max-error", "1", "--overlap", "last"}).exit_code, 0);
  EXPECT_EQ(text_of(path("first.ply")), text_of(path("swapped.ply")));
  expect_complaint({"compress", a, b, path("no.ply"), "--max-error", "1", "--overlap", "best"}, 2,
                   {"--overlap best", "first, last, mean"});
}

TEST_F(CliInputs, WhatCannotBeReadEndsTheRunUnlessItIsSkipped) {
  const std::string dem = hill("dem.tif", 20);
  const std::string text = write_text("text.tif", "no raster");
  const Outcome stopped = run({"compress", dem, text, path("dem.ply"), "--max-error", "1"});
  EXPECT_EQ(stopped.exit_code, 3);
  EXPECT_NE(stopped.err.find("text.tif: not a raster"), std::string::npos) << stopped.err;
  const Outcome skipped = run({"compress", dem, text, path("dem.ply"), "--max-error", "1", "--skip-unreadable"});
  EXPECT_EQ(skipped.exit_code, 0) << skipped.err;
  EXPECT_NE(skipped.err.find("1 input can't be read"), std::string::npos) << skipped.err;
  EXPECT_NE(skipped.err.find("text.tif"), std::string::npos) << skipped.err;
}

// The program knows GeoTIFF's driver before all others, this test's process knows all of them.
TEST_F(CliInputs, WhatLiesBesideAGeoTiffAndOtherFormatsAreRead) {
  const RasterRecipe placeless{.crs = "", .geotransform = std::nullopt};
  const std::string tiff = write("dem.tif", placeless);
  write("dem.aux", {.creation = {"AUX=YES", "DEPENDENT_FILE=dem.tif"}}, "HFA");
  const Outcome of_tiff = run({"info", tiff});
  EXPECT_EQ(of_tiff.exit_code, 0) << of_tiff.err;
  EXPECT_NE(of_tiff.out.find("UTM zone 32N"), std::string::npos) << of_tiff.out;
  for (const char* driver : {"ENVI", "HFA"}) {
    const std::string other = write(std::string("dem.") + driver, {}, driver);
    const Outcome of_other = run({"info", other});
    EXPECT_EQ(of_other.exit_code, 0) << of_other.err;
    EXPECT_NE(of_other.out.find("UTM zone 32N"), std::string::npos) << driver << ": " << of_other.out;
  }
}

}  // namespace
}  // namespace tinsmith::test
