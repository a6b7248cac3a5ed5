// What the program does when all is well.

#include <cmath>
#include <nlohmann/json.hpp>

#include "run_program.hpp"

namespace tinsmith::test {
namespace {

using nlohmann::json;

class Program : public CliTest {};

TEST_F(Program, ExplainsItself) {
  for (const auto& words : std::vector<std::vector<std::string>>{
           {"--help"}, {"compress", "--help"}, {"verify", "--help"}, {"render", "--help"}, {"info", "--help"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_EQ(outcome.err, "");
    for (const char* part : {"usage: tinsmith", "example", "exit code", "130"})
      if (words.front() != "info" || std::string(part) != "130")
        EXPECT_NE(outcome.out.find(part), std::string::npos) << words.front() << ": " << part;
  }
  EXPECT_TRUE(run({"--version"}).out.starts_with("tinsmith "));
}

// The contract's keys, measured; and nothing else on standard output.
TEST_F(Program, CompressReportsEveryKeyAsJson) {
  const Outcome outcome =
      run({"compress", hill("dem.tif", 80), path("out.ply"), "--max-error", "2", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "") << "no bar when it is no terminal";
  const json report = json::parse(outcome.out);
  for (const char* key : {"samples",   "covered",    "uncovered", "vertices", "triangles",          "max_error",
                          "rmse",      "mean_error", "p99_error", "folded",   "non_manifold_edges", "t_junctions",
                          "area_plan", "components", "bytes",     "seconds",  "peak_memory_bytes",  "threads",
                          "windows",   "tolerance"})
    EXPECT_TRUE(report.at(key).is_number()) << key;
  for (const char* key : {"max_error_column", "max_error_row"})
    EXPECT_TRUE(report.at(key).is_number_integer()) << key;
  EXPECT_EQ(report["samples"], 6400);
  EXPECT_EQ(report["covered"], 6400);
  EXPECT_EQ(report["tolerance"], 2);
  EXPECT_LE(report["max_error"].get<double>(), 2);
  EXPECT_EQ(report["full_triangles"], 2 * 79 * 79);
  EXPECT_LT(report["triangles"].get<int>(), 79 * 79);
  EXPECT_EQ(report["bytes"], std::filesystem::file_size(path("out.ply")));
  EXPECT_EQ(report["holds"], true);
  EXPECT_EQ(report["output"], path("out.ply"));
}

TEST_F(Program, WritesTheReportToAFile) {
  const Outcome outcome =
      run({"compress", hill("dem.tif", 40), path("out.2dm"), "--max-error", "5", "--json", path("report.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("certified"), std::string::npos);
  EXPECT_EQ(json::parse(text_of(path("report.json")))["samples"], 1600);
  EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "out.2dm", "out.prj", "report.json"}));
}

TEST_F(Program, CompressStopsAtTrianglesAndRatio) {
  const std::string dem = hill("dem.tif", 80);
  const Outcome by_count = run({"compress", dem, path("n.ply"), "--triangles", "500", "--json", "-"});
  ASSERT_EQ(by_count.exit_code, 0) << by_count.err;
  EXPECT_LE(json::parse(by_count.out)["triangles"].get<int>(), 500);
  const Outcome by_ratio = run({"compress", dem, path("r.ply"), "--ratio", "0.05", "--json", "-"});
  ASSERT_EQ(by_ratio.exit_code, 0) << by_ratio.err;
  EXPECT_LE(json::parse(by_ratio.out)["triangles"].get<double>(), 0.05 * 2 * 79 * 79);
  EXPECT_EQ(json::parse(by_ratio.out)["holds"], true);
}

// A tolerance of 0 is one: only exact planes get fewer triangles.
TEST_F(Program, CompressKeepsAToleranceOfZero) {
  RasterRecipe plane;
  plane.width = plane.height = 30;
  plane.values.clear();
  for (int i = 0; i < 900; ++i) plane.values.push_back(std::floor(i / 30.0) * 2 + i % 30);
  const Outcome outcome =
      run({"compress", write("plane.tif", plane), path("out.ply"), "--max-error", "0", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["triangles"], 2);
}

TEST_F(Program, CompressTakesTheSmallestAndTheLargestIntegers) {
  RasterRecipe recipe;
  recipe.width = recipe.height = 2;
  recipe.type = GDT_Int32;
  recipe.values = {2147483647, -2147483647, -2147483648.0, 2147483646};
  const Outcome outcome =
      run({"compress", write("dem.tif", recipe), path("out.ply"), "--max-error", "1", "--json", "-"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["triangles"], 2);
  EXPECT_LE(json::parse(outcome.out)["max_error"].get<double>(), 1);
}

TEST_F(Program, SaysOnceThatMetresAreAssumedWithoutACrs) {
  RasterRecipe recipe;
  recipe.crs = "";
  const std::string dem = hill("dem.tif", 30, recipe);
  const Outcome outcome = run({"compress", dem, path("out.ply"), "--max-error", "5"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("metres"), std::string::npos);
  EXPECT_EQ(run({"compress", dem, path("out.ply"), "--max-error", "5", "--quiet"}).err, "");
}

TEST_F(Program, CompressUsesFewerThreadsWhereTheMemoryHoldsFewerWindows) {
  const std::string dem = hill("dem.tif", 300);
  const std::vector<std::string> words{"compress", dem,        path("out.ply"), "--max-error", "5", "--memory",
                                       "130M",     "--window", "256",           "--json",      "-"};
  const Outcome one = run(words);
  ASSERT_EQ(one.exit_code, 0) << one.err;
  EXPECT_EQ(json::parse(one.out)["threads"], 1);
  std::vector<std::string> two = words;
  two.insert(two.end(), {"--threads", "2"});
  expect_complaint(two, 5, {"130M", "2 windows", "fewer --threads"});
}

TEST_F(Program, VerifyHoldsForAGoodMeshAndNotForATighterTolerance) {
  const std::string dem = hill("dem.tif", 80);
  ASSERT_EQ(run({"compress", dem, path("out.glb"), "--max-error", "3"}).exit_code, 0);
  const Outcome good = run({"verify", dem, path("out.glb"), "--max-error", "3"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  EXPECT_NE(good.out.find("verdict                holds\n"), std::string::npos) << good.out;
  const Outcome bad = run({"verify", dem, path("out.glb"), "--max-error", "0.1"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_NE(bad.err.find("does not hold"), std::string::npos) << bad.err;
  EXPECT_EQ(std::count(bad.err.begin(), bad.err.end(), '\n'), 1);
}

TEST_F(Program, VerifySaysWhenTheMeshIsOfAnotherTerrain) {
  RasterRecipe elsewhere;
  elsewhere.geotransform = {500000, 30, 0, 5200000, 0, -30};
  ASSERT_EQ(run({"compress", hill("a.tif", 40), path("a.ply"), "--max-error", "3"}).exit_code, 0);
  const Outcome outcome = run({"verify", hill("b.tif", 40, elsewhere), path("a.ply")});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.out.find("uncovered              1600"), std::string::npos) << outcome.out;
}

TEST_F(Program, RenderTakesRasterAndMeshInAnyOrder) {
  const std::string dem = hill("dem.tif", 40);
  const std::string mesh = path("m.obj");
  ASSERT_EQ(run({"compress", dem, mesh, "--max-error", "3"}).exit_code, 0);
  ASSERT_EQ(run({"render", dem, mesh, path("a.png"), "--width", "120"}).exit_code, 0);
  ASSERT_EQ(run({"render", mesh, dem, path("b.png"), "--width", "120"}).exit_code, 0);
  EXPECT_EQ(text_of(path("a.png")), text_of(path("b.png")));
  EXPECT_EQ(run({"render", mesh, path("c.png"), "--panels", "wireframe,hillshade", "--width", "120"}).exit_code, 0);
}

TEST_F(Program, InfoDescribesAsTextAndAsJson) {
  const std::string dem = hill("dem.tif", 40);
  EXPECT_NE(run({"info", dem}).out.find("40 x 40 samples"), std::string::npos);
  EXPECT_EQ(json::parse(run({"info", dem, "--json"}).out)["size"], "40 x 40 samples");
}

TEST_F(Program, InterruptedGoesOnWithTheSameCommand) {
  const std::string dem = hill("dem.tif", 800);
  const std::vector<std::string> words{"compress", dem,  path("out.ply"), "--max-error", "0.01",
                                       "--window", "32", "--no-verify"};
  const auto has_finished_windows = [&](const Running&) {
    const auto kept = work_files(path(".out.ply.tinsmith"));
    return !kept.empty() && std::filesystem::file_size(kept.front()) > 4000;
  };
  const Outcome outcome = run_until(has_finished_windows, words);
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_NE(outcome.err.find("the same command goes on"), std::string::npos) << outcome.err;
  EXPECT_EQ(files(), (std::vector<std::string>{".out.ply.tinsmith", "dem.tif"}));
  ASSERT_EQ(run(words).exit_code, 0);
  const std::string resumed = text_of(path("out.ply"));
  EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "out.ply"}));
  ASSERT_EQ(run(words).exit_code, 0);
  EXPECT_EQ(text_of(path("out.ply")), resumed);
}

TEST_F(Program, SaysWhenItsResultsCantBePrinted) {
  const std::string command =
      std::string(TINSMITH_BINARY_DIR "/tinsmith info ") + write("dem.tif", {}) + " >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
}

}  // namespace
}  // namespace tinsmith::test
