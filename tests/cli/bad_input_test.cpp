// What a user can get wrong: one line that says what, where and what to do, the documented exit code, and
// nothing half-written.

#include <cmath>
#include <limits>

#include "run_program.hpp"

namespace tinsmith::test {
namespace {

class BadInput : public CliTest {};

TEST_F(BadInput, MissingFile) { expect_unusable(path("none.tif"), {"none.tif", "no such file"}); }

TEST_F(BadInput, NotARaster) {
  expect_unusable(write_text("notes.md", "# heights\n"), {"notes.md"});
  expect_unusable(write_text("text.tif", "just text\n"), {"text.tif"});
  expect_unusable(write_text("empty.tif", ""), {"empty.tif"});
  expect_unusable(path(""), {});
}

TEST_F(BadInput, TruncatedTiff) {
  const std::string raster = hill("dem.tif", 300);
  std::filesystem::resize_file(raster, std::filesystem::file_size(raster) / 2);
  expect_unusable(raster, {"dem.tif"});
}

TEST_F(BadInput, NoValidSample) {
  RasterRecipe recipe;
  recipe.values.assign(6, -32768);
  recipe.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-32768); };
  expect_unusable(write("void.tif", recipe), {"valid"});
}

TEST_F(BadInput, RastersWithoutACell) {
  for (const auto& [width, height] : {std::array{1, 1}, {1, 40}, {40, 1}}) {
    RasterRecipe recipe;
    recipe.width = width;
    recipe.height = height;
    recipe.values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 7);
    expect_unusable(write("thin.tif", recipe), {"2 x 2"});
  }
}

TEST_F(BadInput, InfiniteAndAbsurdHeights) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double height : {infinity, -infinity, 1e30}) {
    RasterRecipe recipe;
    recipe.type = GDT_Float32;
    recipe.values = {1, 2, 3, 4, height, 6};
    expect_unusable(write("dem.tif", recipe), {"dem.tif", "--nodata"});
  }
}

TEST_F(BadInput, MismatchedGridsAndCrs) {
  RasterRecipe other;
  const std::string a = write("a.tif", other);
  const auto expect_mismatch = [&](const RasterRecipe& recipe) {
    const std::string b = write("b.tif", recipe);
    expect_complaint({"compress", a, b, path("out.ply"), "--max-error", "1"}, 3, {"b.tif"});
    expect_complaint({"verify", a, b, write_text("m.ply", "x")}, 3, {"b.tif"});
  };
  other.geotransform = {400090, 31, 0, 5100000, 0, -30};
  expect_mismatch(other);
  other.geotransform = {400077, 30, 0, 5100000, 0, -30};
  expect_mismatch(other);
  other.geotransform = {400090, 30, 0, 5100000, 0, -30};
  other.crs = "EPSG:32633";
  expect_mismatch(other);
  EXPECT_EQ(files(), (std::vector<std::string>{"a.tif", "b.tif", "m.ply"}));
}

TEST_F(BadInput, ABandThatIsNotThere) {
  expect_unusable(write("dem.tif", {}), {"dem.tif", "band"}, {"--band", "7"});
}

TEST_F(BadInput, UnknownUnits) {
  // GeoTIFF would write metres for them.
  expect_unusable(write_text("dem.vrt", R"(<VRTDataset rasterXSize="3" rasterYSize="2">
      <SRS>LOCAL_CS["site",UNIT["unknown",1]]</SRS><GeoTransform>0,1,0,0,0,-1</GeoTransform>
      <VRTRasterBand dataType="Float32" band="1"/></VRTDataset>)"),
                  {"dem.vrt", "unit"});
}

TEST_F(BadInput, Tolerances) {
  const std::string dem = write("dem.tif", {});
  for (const char* tolerance : {"-1", "nan", "inf", "-inf", "five"})
    expect_complaint({"compress", dem, path("out.ply"), "--max-error", tolerance}, 2, {"--max-error"});
  EXPECT_EQ(files(), std::vector<std::string>{"dem.tif"});
}

TEST_F(BadInput, StopsAreExactlyOne) {
  const std::string dem = write("dem.tif", {});
  expect_complaint({"compress", dem, path("out.ply")}, 2, {"--max-error 5", "--triangles", "--ratio"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "5", "--ratio", "0.1"}, 2, {"only one"});
  expect_complaint({"compress", dem, path("out.ply"), "--ratio", "1.5"}, 2, {"ratio"});
  expect_complaint({"compress", dem, path("out.ply"), "--triangles", "-4"}, 2, {"triangles"});
}

TEST_F(BadInput, WordsThatAreNoneOfOurs) {
  const std::string dem = write("dem.tif", {});
  expect_complaint({}, 2, {"compress", "--help"});
  expect_complaint({"squash", dem}, 2, {"squash", "compress"});
  expect_complaint({"compress", dem}, 2, {"INPUT... OUTPUT"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "1", "--fast"}, 2, {"--fast"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "1", "--placement", "best"}, 2, {"subset"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "1", "--nodata", "x"}, 2, {"--nodata"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "1", "--vertical-unit", "ell"}, 2, {"us-ft"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "1", "--bbox", "3", "2", "1", "4"}, 2,
                   {"--bbox"});
  expect_complaint({"render", dem, path("out.png"), "--panels", "map"}, 2, {"map", "wireframe"});
  expect_complaint({"render", dem, path("out.jpg")}, 2, {"out.jpg", ".png"});
}

class BadOutput : public CliTest {};

TEST_F(BadOutput, UnknownExtension) {
  expect_complaint({"compress", write("dem.tif", {}), path("out.stl"), "--max-error", "1"}, 2, {".stl", ".ply"});
}

TEST_F(BadOutput, IsAnInput) {
  const std::string dem = write("dem.ply", {});  // a raster, whatever its name says
  const std::string before = text_of(dem);
  const Outcome outcome = run({"compress", dem, dem, "--max-error", "1"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(text_of(dem), before);
}

TEST_F(BadOutput, IsAnotherOutputOrAListOfInputs) {
  const std::string dem = write("dem.tif", {});
  const std::string list = write_text("list.txt", dem + "\n");
  const std::string out = path("out.ply");
  expect_complaint({"compress", dem, out, "--max-error", "1", "--json", out}, 2, {out, "two outputs"});
  expect_complaint({"compress", dem, out, "--max-error", "1", "--json", path("./out.ply")}, 2, {"two outputs"});
  expect_complaint({"compress", "@" + list, out, "--max-error", "1", "--json", list}, 2, {list, "input"});
  expect_complaint({"info", "@" + list, "--json", list}, 2, {list, "input"});
  EXPECT_EQ(text_of(list), dem + "\n");
}

TEST_F(BadOutput, FolderThatCantBeWritten) {
  const std::string dem = write("dem.tif", {});
  expect_complaint({"compress", dem, path("none/out.ply"), "--max-error", "1"}, 4,
                   {"none/out.ply", "make the folder"});
  expect_complaint({"compress", dem, "/proc/out.ply", "--max-error", "1"}, 4, {"/proc/out.ply"});
  expect_complaint({"compress", dem, path("dem.tif/out.ply"), "--max-error", "1"}, 4, {"out.ply"});
  expect_complaint({"compress", dem, path("out.ply"), "--max-error", "1", "--json", path("none/r.json")}, 4,
                   {"r.json"});
  expect_complaint({"render", dem, path("none/out.png")}, 4, {"none/out.png"});
  EXPECT_EQ(files(), std::vector<std::string>{"dem.tif"});
}

// Every format, with the old file still there.
TEST_F(BadOutput, FullDisk) {
  const std::string dem = hill("dem.tif", 60);
  for (const char* extension : {".ply", ".obj", ".glb", ".2dm"}) {
    const std::string output = write_text(std::string("old") + extension, "old");
    const auto before = files();
    const std::vector<std::string> words{"compress", dem, output, "--max-error", "0.5"};
    expect_complaint(words, 4, {path(""), std::string("old") + extension, "make room"}, {4096, 0});
    EXPECT_EQ(text_of(output), "old");
    EXPECT_EQ(run(words).exit_code, 0) << "goes on when there is room";
    EXPECT_NE(text_of(output), "old");
    auto after = files();
    std::erase_if(after, [](const std::string& name) { return name.ends_with(".prj"); });
    EXPECT_EQ(after, before) << "nothing half-written, no unfinished work";
    for (const std::string& name : files())
      if (name.ends_with(".prj")) std::filesystem::remove(path(name));
  }
  const std::string picture = write_text("old.png", "old");
  expect_complaint({"render", dem, picture}, 4, {picture}, {4096, 0});
  EXPECT_EQ(text_of(picture), "old");
}

}  // namespace
}  // namespace tinsmith::test
