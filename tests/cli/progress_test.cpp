// What a scheduler is told of a run, and the plan of one.

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <sstream>

#include "run_program.hpp"

namespace tinsmith::test {
namespace {

using nlohmann::json;

using CliProgress = CliTest;

std::vector<json> lines_of(const std::string& text) {
  std::vector<json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
  return lines;
}

// Each line is an object with every key; no stage falls, and the last one is whole.
void expect_progress(const std::vector<json>& lines, const std::string& last_stage) {
  ASSERT_GE(lines.size(), 2U);
  double told = 0;
  double elapsed = 0;
  std::string stage;
  for (const json& line : lines) {
    if (line.at("stage") != stage) told = 0;
    stage = line["stage"];
    EXPECT_GE(line.at("fraction").get<double>(), told);
    told = line["fraction"];
    EXPECT_LE(told, 1);
    EXPECT_GE(line.at("samples_per_second").get<double>(), 0);
    EXPECT_TRUE(line.at("seconds_left").is_null() || line["seconds_left"].get<double>() >= 0);
    EXPECT_GT(line.at("memory_bytes").get<double>(), 1e6);
    EXPECT_GE(line.at("elapsed_seconds").get<double>(), elapsed);
    elapsed = line["elapsed_seconds"];
  }
  EXPECT_EQ(stage, last_stage);
  EXPECT_EQ(told, 1);
  EXPECT_LE(static_cast<double>(lines.size()), 2 * elapsed + 2) << "twice a second at most";
}

TEST_F(CliProgress, JsonLinesNeverFallAndEndWithOne) {
  const std::string dem = std::string(TINSMITH_SOURCE_DIR) + "/data/matterhorn.tif";
  const Outcome compressed =
      run({"compress", dem, path("dem.ply"), "--max-error", "50", "--window", "64", "--progress", "json"});
  ASSERT_EQ(compressed.exit_code, 0) << compressed.err;
  expect_progress(lines_of(compressed.err), "verify");
  const Outcome verified = run({"verify", dem, path("dem.ply"), "--max-error", "50", "--progress", "json"});
  ASSERT_EQ(verified.exit_code, 0) << verified.err;
  expect_progress(lines_of(verified.err), "verify");
}

TEST_F(CliProgress, IsSilentWhenNotAsked) {
  EXPECT_EQ(run({"compress", hill("dem.tif", 40), path("a.ply"), "--max-error", "5", "--progress", "none"}).err,
            "");
  EXPECT_EQ(run({"verify", path("dem.tif"), path("a.ply"), "--progress", "bar"}).err, "") << "no terminal";
  expect_complaint({"verify", path("dem.tif"), path("a.ply"), "--progress", "dots"}, 2,
                   {"--progress dots", "bar, json, none"});
}

TEST_F(CliProgress, AResumedRunBeginsWhereItWas) {
  const std::string dem = std::string(TINSMITH_SOURCE_DIR) + "/data/matterhorn.tif";
  const std::vector<std::string> words{"compress",   dem,   path("dem.ply"), "--max-error", "1",
                                       "--window",   "32",  "--no-verify",   "--threads",   "1",
                                       "--progress", "json"};
  const auto has_told = [&](const Running& running) {
    return text_of(said(running.name, "err")).find('\n') != std::string::npos;
  };
  const Outcome stopped = run_until(has_told, words);
  ASSERT_EQ(stopped.exit_code, 130) << stopped.err;
  std::vector<json> before;
  std::istringstream stream(stopped.err);
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with('{')) before.push_back(json::parse(line));
  const Outcome resumed = run(words);
  ASSERT_EQ(resumed.exit_code, 0) << resumed.err;
  ASSERT_FALSE(before.empty());
  const double reached = before.back()["fraction"].get<double>();
  EXPECT_GE(lines_of(resumed.err).front()["fraction"], reached);
}

TEST_F(CliProgress, ThePlanSaysWhatTheRunThenTakes) {
  const std::string dem = std::string(TINSMITH_SOURCE_DIR) + "/data/matterhorn.tif";
  const Outcome planned = run({"compress", dem, path("dem.ply"), "--max-error", "30", "--plan", "--json", "-"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_TRUE(files().empty()) << "nothing was written";
  const json plan = json::parse(planned.out);
  const Outcome ran = run({"compress", dem, path("dem.ply"), "--max-error", "30", "--no-verify", "--json", "-"});
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const json report = json::parse(ran.out);
  EXPECT_EQ(plan["windows"], report["windows"]);
  EXPECT_EQ(plan["threads"], report["threads"]);
  EXPECT_EQ(plan["tried_windows"], 9);
  EXPECT_NEAR(plan["expected_triangles"].get<double>() / report["triangles"].get<double>(), 1, 0.25);
  EXPECT_NEAR(plan["expected_bytes"].get<double>() / report["bytes"].get<double>(), 1, 0.25);
  EXPECT_NEAR(plan["expected_peak_memory_bytes"].get<double>() / report["peak_memory_bytes"].get<double>(), 1, 0.4);
  EXPECT_GT(plan["expected_seconds"], 0);
  const Outcome shown = run({"compress", dem, path("dem.ply"), "--max-error", "30", "--plan"});
  for (const char* part :
       {"estimated from 9 windows", "triangles", "scratch", "peak memory", "nothing was written"})
    EXPECT_NE(shown.out.find(part), std::string::npos) << part;
}

TEST_F(CliProgress, ThePlanRefusesWhatCannotFit) {
  const std::string dem = hill("dem.tif", 300);
  expect_complaint({"compress", dem, path("dem.ply"), "--max-error", "1", "--plan", "--memory", "64M"}, 5,
                   {"64M", "for 1 window of", "--memory"});
  expect_complaint({"compress", dem, path("dem.ply"), "--max-error", "1", "--memory", "3"}, 5, {"3 bytes"});
}

// A quarter of a billion samples of noise, none of which can be left out: known from a few windows.
TEST_F(CliProgress, AFormatThatCannotHoldTheResultIsRefusedAtTheStart) {
  RasterRecipe noise;
  noise.width = noise.height = 512;
  noise.values.clear();
  for (std::uint32_t i = 0; i < 512 * 512; ++i) noise.values.push_back((i * 2654435761U >> 7) % 1000);
  const std::string tile = write("noise.tif", noise);
  std::string vrt =
      "<VRTDataset rasterXSize='16384' rasterYSize='16384'><SRS>EPSG:32632</SRS>"
      "<GeoTransform>400000, 30, 0, 5100000, 0, -30</GeoTransform>"
      "<VRTRasterBand dataType='Int16' band='1'>";
  for (int i = 0; i < 32 * 32; ++i)
    vrt += fmt::format(
        "<SimpleSource><SourceFilename>{}</SourceFilename><SourceBand>1</SourceBand>"
        "<SrcRect xOff='0' yOff='0' xSize='512' ySize='512'/>"
        "<DstRect xOff='{}' yOff='{}' xSize='512' ySize='512'/></SimpleSource>",
        tile, i % 32 * 512, i / 32 * 512);
  const std::string dem = write_text("noise.vrt", vrt + "</VRTRasterBand></VRTDataset>");
  for (const std::vector<std::string>& plan : {std::vector<std::string>{}, {"--plan"}}) {
    std::vector<std::string> words{"compress", dem, path("out.glb"), "--max-error", "0.1", "--effort", "fast"};
    words.insert(words.end(), plan.begin(), plan.end());
    expect_complaint(words, 5, {"out.glb", "4 GiB", ".ply"});
  }
  EXPECT_EQ(files(), (std::vector<std::string>{"noise.tif", "noise.vrt"}));
}

}  // namespace
}  // namespace tinsmith::test
