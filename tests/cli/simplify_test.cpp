// tinsmith simplify, as a user runs it: what can go wrong says so in one line and leaves the old file; what goes
// well is reported.

#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "run_program.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith::test {
namespace {

using nlohmann::json;

constexpr std::array kExtensions{".ply", ".obj", ".stl", ".glb"};

/// Ascii PLY of a cube's 12 triangles; each side has its own 4 vertices, with the side's normal.
std::string cube_text() {
  std::string vertices;
  std::string triangles;
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const int end = side % 2;
    for (const auto& [i, j] : {std::array{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      std::array<int, 6> line{};
      line[axis] = end;
      line[(axis + 1) % 3] = end == 1 ? i : j;
      line[(axis + 2) % 3] = end == 1 ? j : i;
      line[3 + axis] = 2 * end - 1;
      vertices += fmt::format("{}\n", fmt::join(line, " "));
    }
    const int v = 4 * side;
    triangles += fmt::format("3 {} {} {}\n3 {} {} {}\n", v, v + 1, v + 2, v, v + 2, v + 3);
  }
  return "ply\nformat ascii 1.0\nelement vertex 24\nproperty float x\nproperty float y\nproperty float z\n"
         "property float nx\nproperty float ny\nproperty float nz\nelement face 12\n"
         "property list uchar int vertex_indices\nend_header\n" +
         vertices + triangles;
}

/// Ascii PLY of size x size vertices of a wavy sheet with colours; 2 (size - 1)^2 triangles, 4 (size - 1) border
/// edges.
std::string sheet_text(int size, const std::vector<std::string>& more_triangles = {}) {
  const int n_triangles = 2 * (size - 1) * (size - 1) + static_cast<int>(more_triangles.size());
  std::string text = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
      size * size, n_triangles);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      text += fmt::format("{} {} {:.17g} {} {} 128\n", x, y, std::sin(x * 0.3) * std::cos(y * 0.2), 255 * x / size,
                          255 * y / size);
  for (int y = 0; y + 1 < size; ++y)
    for (int x = 0; x + 1 < size; ++x) {
      const int v = y * size + x;
      text += fmt::format("3 {} {} {}\n3 {} {} {}\n", v, v + 1, v + size, v + 1, v + size + 1, v + size);
    }
  for (const std::string& triangle : more_triangles) text += "3 " + triangle + "\n";
  return text;
}

class SimplifyTest : public CliTest {
 protected:
  std::string sheet(int size, const std::vector<std::string>& more_triangles = {}) const {
    return write_text("sheet.ply", sheet_text(size, more_triangles));
  }

  /// Runs simplify and expects it to say nothing but the report.
  json report(std::vector<std::string> words) const {
    words.insert(words.begin(), "simplify");
    words.insert(words.end(), {"--json", "-"});
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "") << "no bar when it is no terminal";
    return outcome.exit_code == 0 ? json::parse(outcome.out) : json();
  }

  /// Wrong options for a good mesh: exit code 2, and the folder stays as it was.
  void expect_wrong_usage(const std::vector<std::string>& options, const std::vector<std::string>& says) const {
    const std::string mesh = sheet(4);
    const std::string output = write_text("old.ply", "old");
    const auto before = files();
    std::vector<std::string> words{"simplify", mesh, output};
    words.insert(words.end(), options.begin(), options.end());
    expect_complaint(words, 2, says);
    EXPECT_EQ(text_of(output), "old");
    EXPECT_EQ(files(), before);
  }

  /// An input that can't be used: exit code 3, and the folder stays as it was.
  void expect_unusable_mesh(const std::string& mesh, const std::vector<std::string>& says,
                            const std::vector<std::string>& options = {}) const {
    const std::string output = write_text("old.ply", "old");
    const auto before = files();
    std::vector<std::string> words{"simplify", mesh, output};
    words.insert(words.end(), options.begin(), options.end());
    expect_complaint(words, 3, says);
    EXPECT_EQ(text_of(output), "old");
    EXPECT_EQ(files(), before);
  }
};

class BadSurface : public SimplifyTest {};

TEST_F(BadSurface, MissingFile) {
  for (const char* extension : kExtensions)
    expect_unusable_mesh(path(std::string("none") + extension), {std::string("none") + extension});
}

TEST_F(BadSurface, Garbage) {
  for (const char* extension : kExtensions) {
    expect_unusable_mesh(write_text(std::string("words") + extension, "just words\n"), {"words"});
    expect_unusable_mesh(write_text(std::string("empty") + extension, ""), {"empty"});
  }
  expect_unusable_mesh(path(""), {});
}

TEST_F(BadSurface, CutShort) {
  const std::string whole = sheet_text(20);
  expect_unusable_mesh(write_text("half.ply", whole.substr(0, whole.size() / 2)), {"half.ply"});
}

TEST_F(BadSurface, TrianglesThatAreNone) {
  const std::string points =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";
  expect_unusable_mesh(write_text("none.ply", points + "3 0 1 0\n3 2 2 2\n"), {"none.ply", "no triangle is left"});
}

TEST_F(BadSurface, UnknownExtension) {
  expect_unusable_mesh(write_text("mesh.off", "OFF\n"), {"mesh.off", ".ply"});
  expect_complaint({"simplify", sheet(4), path("out.2dm")}, 2, {"out.2dm", ".2dm", ".stl"});
  expect_complaint({"simplify", sheet(4), path("out")}, 2, {"out", ".stl"});
  EXPECT_EQ(files(), (std::vector<std::string>{"mesh.off", "old.ply", "sheet.ply"}));
}

TEST_F(BadSurface, OptionsOutOfRange) {
  for (const char* value : {"-1", "nan", "inf", "many"})
    for (const char* option : {"--triangles", "--max-cost", "--attribute-weight"})
      expect_wrong_usage({option, value}, {option});
  for (const char* value : {"0", "-0.5", "1.01", "nan"}) expect_wrong_usage({"--ratio", value}, {"--ratio"});
  for (const char* value : {"-1", "181", "nan"}) expect_wrong_usage({"--crease", value}, {"--crease", "180"});
  expect_wrong_usage({"--placement", "best"}, {"best", "subset"});
  expect_wrong_usage({"--quadric", "both"}, {"both", "combined"});
  expect_wrong_usage({"--fast"}, {"--fast"});
  expect_complaint({"simplify", path("one.ply")}, 2, {"OUTPUT"});
}

TEST_F(BadSurface, OptionsThatContradictEachOther) {
  expect_wrong_usage({"--drop-attributes", "--attribute-weight", "2"}, {"--drop-attributes", "--attribute-weight"});
  for (const char* placement : {"optimal", "segment"})
    expect_wrong_usage({"--progressive", path("kept.tspm"), "--placement", placement},
                       {"--progressive", "--placement subset"});
}

TEST_F(BadSurface, FeatureEdgesThatAreNone) {
  const std::string mesh = sheet(4);
  for (const char* text :
       {"0 16\n", "0 99999999999999999999\n", "0\n", "0 1 2\n", "3 3\n", "-1 2\n", "a b\n", "0 1.5\n"}) {
    const std::string edges = write_text("edges.txt", std::string("# border\n\n0 1 # first\n") + text);
    expect_unusable_mesh(mesh, {"edges.txt", "line 4"}, {"--feature-edges", edges});
  }
  expect_unusable_mesh(mesh, {"none.txt"}, {"--feature-edges", path("none.txt")});
  expect_unusable_mesh(mesh, {}, {"--feature-edges", path("")});
}

TEST_F(BadSurface, OutputsThatAreInputs) {
  const std::string mesh = sheet(4);
  const std::string edges = write_text("edges.ply", "0 1\n");
  const std::string output = path("out.ply");
  const auto before = files();
  expect_complaint({"simplify", mesh, mesh}, 2, {mesh, "input"});
  expect_complaint({"simplify", mesh, path("./sheet.ply")}, 2, {"input"});
  expect_complaint({"simplify", mesh, edges, "--feature-edges", edges}, 2, {edges, "input"});
  expect_complaint({"simplify", mesh, output, "--json", mesh}, 2, {mesh});
  expect_complaint({"simplify", mesh, output, "--json", output}, 2, {output, "two outputs"});
  const std::string steps = path("steps.tspm");
  expect_complaint({"simplify", mesh, output, "--progressive", steps, "--json", steps}, 2, {steps, "two outputs"});
  expect_complaint({"simplify", mesh, output, "--progressive", steps, "--json", path("./steps.tspm")}, 2,
                   {"steps.tspm", "two outputs"});
  EXPECT_EQ(text_of(mesh), sheet_text(4));
  EXPECT_EQ(text_of(edges), "0 1\n");
  EXPECT_EQ(files(), before);
}

TEST_F(BadSurface, FoldersThatCantBeWritten) {
  const std::string mesh = sheet(4);
  expect_complaint({"simplify", mesh, path("none/out.ply")}, 4, {"none/out.ply"});
  expect_complaint({"simplify", mesh, "/proc/out.glb"}, 4, {"/proc/out.glb"});
  expect_complaint({"simplify", mesh, path("out.ply"), "--json", path("none/r.json")}, 4, {"r.json"});
  EXPECT_EQ(files(), std::vector<std::string>{"sheet.ply"});
}

// Every format, with the old file still there.
TEST_F(BadSurface, FullDisk) {
  const std::string mesh = sheet(60);
  for (const char* extension : kExtensions) {
    const std::string output = write_text(std::string("old") + extension, "old");
    const auto before = files();
    expect_complaint({"simplify", mesh, output, "--ratio", "1", "--quiet"}, 4, {output}, {4096, 0});
    EXPECT_EQ(text_of(output), "old");
    EXPECT_EQ(files(), before) << "nothing half-written";
  }
}

class Simplify : public SimplifyTest {};

TEST_F(Simplify, ExplainsItself) {
  const Outcome outcome = run({"simplify", "--help"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const char* part : {"usage: tinsmith simplify", "examples", "exit codes", "--max-cost", "(default optimal)"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part;
  EXPECT_NE(run({"--help"}).out.find("simplify"), std::string::npos);
}

TEST_F(Simplify, ReportsEveryKeyAsJson) {
  const json said = report({sheet(30), path("out.ply"), "--triangles", "200"});
  for (const char* key : {"components",
                          "input_vertices",
                          "input_triangles",
                          "vertices",
                          "triangles",
                          "border_edges",
                          "feature_edges",
                          "collapses",
                          "refused_topology",
                          "refused_half_space",
                          "last_cost",
                          "duplicated_triangles",
                          "degenerate_triangles",
                          "flipped_triangles",
                          "non_manifold_edges",
                          "non_manifold_vertices",
                          "unorientable_edges",
                          "unreferenced_vertices",
                          "seconds",
                          "simplify_seconds",
                          "peak_memory_bytes",
                          "bytes"})
    EXPECT_TRUE(said.at(key).is_number()) << key;
  EXPECT_TRUE(said.at("version").is_string());
  EXPECT_TRUE(said.at("stopped_by").is_string());
  EXPECT_EQ(said["input"], path("sheet.ply"));
  EXPECT_EQ(said["output"], path("out.ply"));
  EXPECT_EQ(said["input_vertices"], 900);
  EXPECT_EQ(said["input_triangles"], 2 * 29 * 29);
  EXPECT_EQ(said["border_edges"], 4 * 29);
  EXPECT_EQ(said["bytes"], std::filesystem::file_size(path("out.ply")));
  EXPECT_GT(said["collapses"], 0);
  const Surface result = read_surface(path("out.ply"));
  EXPECT_EQ(said["triangles"], result.triangles.size());
  EXPECT_EQ(said["vertices"], result.position.size());
}

TEST_F(Simplify, StopsAtTheFirstThatIsReached) {
  const std::string mesh = sheet(30);
  const double n_triangles = 2 * 29 * 29;
  EXPECT_LE(report({mesh, path("a.ply"), "--triangles", "300"})["triangles"], 300);
  EXPECT_LE(report({mesh, path("b.ply"), "--ratio", "0.1"})["triangles"].get<double>(), 0.1 * n_triangles);
  const json both = report({mesh, path("c.ply"), "--ratio", "0.1", "--triangles", "1000"});
  EXPECT_LE(both["triangles"], 1000);
  EXPECT_GE(both["triangles"], 990);
  const json cost = report({mesh, path("d.ply"), "--ratio", "0.01", "--max-cost", "1e-4"});
  EXPECT_LE(cost["last_cost"].get<double>(), 1e-4);
  EXPECT_GT(cost["triangles"].get<double>(), 0.01 * n_triangles);
  EXPECT_LT(report({mesh, path("e.ply")})["triangles"], both["triangles"]) << "without a stop: as far as it goes";
}

TEST_F(Simplify, SaysWhyItStopped) {
  const std::string mesh = sheet(20);
  EXPECT_EQ(report({mesh, path("a.ply"), "--triangles", "300"})["stopped_by"], "triangles");
  EXPECT_EQ(report({mesh, path("b.ply"), "--ratio", "0.01", "--max-cost", "1e-6"})["stopped_by"], "cost");
  EXPECT_EQ(report({mesh, path("c.ply")})["stopped_by"], "no candidates");
  // With every edge a feature only the flat ones go; so too with what a progressive mesh begins with.
  const std::string kept = path("kept.tspm");
  report({mesh, path("base.ply"), "--triangles", "100", "--progressive", kept});
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{mesh, path("d.ply"), "--crease", "0"}, {kept, path("e.ply")}}) {
    std::vector<std::string> all{"simplify"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--triangles", "10"});
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_NE(outcome.err.find(" triangles, not the 10 asked for"), std::string::npos) << outcome.err;
    all.push_back("--quiet");
    EXPECT_EQ(run(all).err, "");
  }
}

TEST_F(Simplify, WritesEveryFormat) {
  const std::string mesh = sheet(20);
  for (const char* extension : kExtensions) {
    const std::string output = path(std::string("out") + extension);
    ASSERT_EQ(run({"simplify", mesh, output, "--triangles", "100"}).exit_code, 0) << extension;
    const std::size_t n_triangles = read_surface(output).triangles.size();
    EXPECT_LE(n_triangles, 100U) << extension;
    EXPECT_GE(n_triangles, 90U) << extension;
  }
}

TEST_F(Simplify, SaysInWordsWhatWasWrongWithTheInput) {
  const Outcome clean = run({"simplify", sheet(10), path("out.ply"), "--ratio", "0.5"});
  EXPECT_EQ(clean.exit_code, 0) << clean.err;
  EXPECT_EQ(clean.out.find("wrong with"), std::string::npos) << clean.out;
  const Outcome outcome =
      run({"simplify", sheet(10, {"0 1 10", "5 5 6"}), path("out.ply"), "--ratio", "0.5", "--verbose"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"wrong with the input", "1 triangle was there again: removed", "1 triangle had no area",
                           "duplicated_triangles   1"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << part << " in: " << outcome.out;
}

TEST_F(Simplify, CountsTheFeatureEdgesOfAFile) {
  const std::string edges =
      write_text("edges.txt", "# a line through the middle\n210 211\n211 212 # on\r\n\n212\t213");
  const std::string mesh = sheet(20);
  EXPECT_EQ(report({mesh, path("out.ply"), "--ratio", "0.5"})["feature_edges"], 0);
  EXPECT_EQ(report({mesh, path("out.ply"), "--ratio", "0.5", "--feature-edges", edges})["feature_edges"], 3);
}

TEST_F(Simplify, DropsAttributesWhenAskedOrWhenTheFormatHasNone) {
  const std::string mesh = sheet(20);
  report({mesh, path("coloured.ply"), "--ratio", "0.5"});
  EXPECT_NE(read_surface(path("coloured.ply")).find(AttributeKind::kColour), nullptr);
  report({mesh, path("plain.ply"), "--ratio", "0.5", "--drop-attributes"});
  EXPECT_TRUE(read_surface(path("plain.ply")).attributes.empty());
  const Outcome outcome = run({"simplify", mesh, path("out.stl"), "--ratio", "0.5"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("out.stl"), std::string::npos) << "says what is lost: " << outcome.err;
  EXPECT_EQ(run({"simplify", mesh, path("out.stl"), "--ratio", "0.5", "--quiet"}).err, "");
}

/// One triangle with a scalar.
std::string hot_text() {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
         "property float heat\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
         "0 0 0 7\n1 0 0 8\n0 1 0 9\n3 0 1 2\n";
}

TEST_F(Simplify, SaysWhichValuesHaveNoWeight) {
  const std::string hot = write_text("hot.ply", hot_text());
  const Outcome outcome = run({"simplify", hot, path("out.ply"), "--quadric", "combined"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("--quadric combined: none of the 1 "), std::string::npos) << outcome.err;
  for (const char* quadric : {"separate", "gradient"})
    EXPECT_EQ(run({"simplify", hot, path("out.ply"), "--quadric", quadric}).err, "");
  EXPECT_EQ(run({"simplify", sheet(4), path("out.ply"), "--quadric", "combined"}).err, "") << "one colour";
}

TEST_F(Simplify, SaysWhichValuesTheFormatLeavesOut) {
  const std::string mesh = write_text("hot.ply", hot_text());
  EXPECT_EQ(run({"simplify", mesh, path("out.ply")}).err, "");
  for (const char* extension : {".obj", ".glb", ".stl"}) {
    const std::string output = path(std::string("out") + extension);
    const std::string remark = run({"simplify", mesh, output}).err;
    EXPECT_TRUE(remark.starts_with("tinsmith: " + output)) << remark;
    EXPECT_EQ(std::count(remark.begin(), remark.end(), '\n'), 1) << remark;
    EXPECT_EQ(run({"simplify", mesh, output, "--drop-attributes"}).err, "");
  }
}

TEST_F(Simplify, SeamsGoWithTheAttributes) {
  const std::string cube = write_text("cube.ply", cube_text());
  const json kept = report({cube, path("kept.ply"), "--ratio", "1"});
  EXPECT_EQ(kept["vertices"], 24);
  EXPECT_EQ(kept["feature_edges"], 12);
  for (const char* option : {"--drop-attributes", "--no-seams"}) {
    const json dropped = report({cube, path("dropped.ply"), "--ratio", "1", option});
    EXPECT_EQ(dropped["vertices"], 8) << option;
    EXPECT_EQ(dropped["feature_edges"], 0) << option;
    EXPECT_EQ(dropped["border_edges"], 0) << option;
  }
}

TEST_F(Simplify, MakesTheSameBytesTwice) {
  const std::string mesh = sheet(40);
  for (const char* name : {"a.glb", "b.glb"}) report({mesh, path(name), "--ratio", "0.2"});
  EXPECT_EQ(text_of(path("a.glb")), text_of(path("b.glb")));
}

TEST_F(Simplify, RestoresAProgressiveMesh) {
  const std::string mesh = sheet(20);
  const std::string kept = path("kept.tspm");
  report({mesh, path("base.ply"), "--ratio", "0.1", "--progressive", kept, "--placement", "subset"});
  EXPECT_EQ(report({kept, path("full.ply")})["triangles"], 2 * 19 * 19);
  const Surface full = read_surface(path("full.ply"));
  EXPECT_EQ(full.position, read_surface(mesh).position);
  EXPECT_EQ(full.triangles, read_surface(mesh).triangles);
  const json half = report({kept, path("half.ply"), "--triangles", "361"});
  EXPECT_LE(half["triangles"], 361);
  EXPECT_GE(half["triangles"], 359);
  EXPECT_EQ(run({"simplify", kept, path("half.ply"), "--ratio", "0.5"}).exit_code, 2);
  EXPECT_EQ(run({"simplify", mesh, path("base.ply"), "--progressive", path("kept.ply")}).exit_code, 2);
}

TEST_F(Simplify, WritesTheReportToAFile) {
  const Outcome outcome = run({"simplify", sheet(20), path("out.obj"), "--ratio", "0.5", "--json", path("r.json")});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("fewer than the input's 722"), std::string::npos) << outcome.out;
  EXPECT_EQ(json::parse(text_of(path("r.json")))["input_triangles"], 722);
}

TEST_F(Simplify, InterruptedLeavesNothing) {
  const std::string mesh = sheet(500);
  const Outcome outcome = run_until(catches_interrupts, {"simplify", mesh, path("out.ply")});
  EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(files(), std::vector<std::string>{"sheet.ply"});
}

}  // namespace
}  // namespace tinsmith::test
