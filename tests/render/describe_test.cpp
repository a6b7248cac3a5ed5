#include "tinsmith/describe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "scratch.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/progressive.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {
namespace {

using test::RasterRecipe;
using test::Scratch;

std::string entry(const std::string& path, const std::string& name) {
  const auto entries = describe(path);
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const auto& e) { return e.first == name; });
  return found == entries.end() ? "(no such entry)" : found->second;
}

RasterRecipe half_void() {
  return {40, 20, [](int x, int y) { return x < 10 ? test::kNodata : 100.0 + x + y; }};
}

TEST(Describe, SaysWhatIsInARaster) {
  const Scratch scratch;
  const std::string path = scratch.path("dem.tif");
  test::write_raster(path, half_void());
  EXPECT_EQ(entry(path, "format"), "GeoTIFF");
  EXPECT_EQ(entry(path, "size"), "40 x 20 samples");
  EXPECT_EQ(entry(path, "type"), "Float64 (band 1)");
  EXPECT_EQ(entry(path, "nodata"), "-9999");
  EXPECT_EQ(entry(path, "CRS"), "WGS 84 / UTM zone 32N (EPSG:32632)");
  EXPECT_EQ(entry(path, "step"), "10 x 10 units, 10 x 10 m in the middle");
  EXPECT_EQ(entry(path, "extent"), "west 400000, south 5099800, east 400400, north 5100000");
  EXPECT_EQ(entry(path, "heights"), "110 to 158 m");
  EXPECT_EQ(entry(path, "valid"), "600 samples, 75 %");
}

TEST(Describe, SaysWhatIsInAMeshOfAnyFormat) {
  const Scratch scratch;
  const RasterRecipe plane{9, 5, [](int x, int y) { return 100.0 + x + y; }};
  for (const char* name : {"m.ply", "m.obj", "m.glb", "m.2dm"}) {
    const std::string path = scratch.path(name);
    write_mesh(path, test::thinned_grid(plane, 4), test::frame_of(plane));
    EXPECT_EQ(entry(path, "vertices"), "6") << name;
    EXPECT_EQ(entry(path, "triangles"), "4") << name;
    EXPECT_EQ(entry(path, "components"), "1") << name;
    EXPECT_EQ(entry(path, "heights"), "100 to 112 m") << name;
    EXPECT_EQ(entry(path, "extent"), "west 400005, south 5099955, east 400085, north 5099995") << name;
  }
}

TEST(Describe, CountsTheComponents) {
  const Scratch scratch;
  const RasterRecipe plane{9, 5, [](int x, int y) { return 100.0 + x + y; }};
  TerrainMesh mesh;
  for (const int column : {0, 1, 0, 5, 6, 5}) {
    mesh.position.push_back({column * 16, static_cast<int>(mesh.height.size() % 3) / 2 * 16});
    mesh.height.push_back(1);
  }
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  write_mesh(scratch.path("two.ply"), mesh, test::frame_of(plane));
  EXPECT_EQ(entry(scratch.path("two.ply"), "components"), "2");
}

TEST(Describe, SaysHeightsInMetresWhateverTheirUnitAndThatOfTheCrs) {
  const Scratch scratch;
  const RasterRecipe plane{9, 5, [](int x, int y) { return 100.0 + x + y; }};
  GridFrame frame = test::frame_of(plane);
  frame.crs_wkt = R"(LOCAL_CS["of feet",UNIT["US survey foot",0.3048006096012192]])";
  frame.metres_per_horizontal_unit = 0.3048006096012192;
  for (const double metres : {1.0, 0.5}) {
    frame.metres_per_vertical_unit = metres;
    for (const char* extension : {".ply", ".obj", ".glb", ".2dm"}) {
      const std::string path = scratch.path((metres == 1 ? "metres" : "halves") + std::string(extension));
      write_mesh(path, test::thinned_grid(plane, 4), frame);
      EXPECT_EQ(entry(path, "heights"), metres == 1 ? "100 to 112 m" : "100 to 112 units of 0.5 m: 50 to 56 m")
          << extension;
    }
  }
}

TEST(Describe, ClaimsNoUnitThatAFileDoesNotSay) {
  const Scratch scratch;
  const std::string path = scratch.path("other.obj");
  std::ofstream(path) << "v 0 0 1\nv 1 0 2\nv 0 1 3\nf 1 2 3\n";
  EXPECT_TRUE(entry(path, "heights").starts_with("1 to 3, in a unit that the file does not say"));
  InputOptions feet;
  feet.vertical_unit = 0.5;
  const auto entries = describe(path, feet);
  EXPECT_EQ(entries.back().second, "1 to 3 units of 0.5 m: 0.5 to 1.5 m");
}

TEST(Describe, SaysWhatIsInEverySurfaceThatSimplifyReadsOrWrites) {
  const Scratch scratch;
  Surface surface;
  surface.position = {{0, 0, 0}, {2, 0, 0}, {0, 3, 0}, {0, 0, 4}};
  surface.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  const auto expect_described = [&](const std::string& path) {
    EXPECT_EQ(entry(path, "vertices"), "4") << path;
    EXPECT_EQ(entry(path, "triangles"), "4") << path;
  };
  for (const char* name : {"s.ply", "s.obj", "s.stl", "s.glb"}) {
    write_surface(scratch.path(name), surface);
    expect_described(scratch.path(name));
  }
  EXPECT_EQ(entry(scratch.path("s.stl"), "format"), "surface, .stl");
  EXPECT_EQ(entry(scratch.path("s.stl"), "z"), "0 to 4");
  SimplifySurfaceReport report;
  write_progressive(scratch.path("s.tspm"), make_progressive(surface, {}, report));
  expect_described(scratch.path("s.tspm"));
  std::ofstream(scratch.path("ascii.ply")) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                                              "property float y\nproperty float z\nproperty float heat\n"
                                              "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
                                              "0 0 0 1\n2 0 0 1\n0 3 0 1\n0 0 4 1\n"
                                              "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  expect_described(scratch.path("ascii.ply"));
  EXPECT_EQ(entry(scratch.path("ascii.ply"), "values"), "heat");
}

TEST(Describe, RefusesDamageInItsOwnWords) {
  const Scratch scratch;
  const std::string json = "{}  ";
  std::string glb = "glTF";
  for (const std::uint32_t word : {2U, 12U + 8U + 4U, 4U, 0x4E4F534AU})
    glb.append(reinterpret_cast<const char*>(&word), sizeof word);
  std::ofstream(scratch.path("bad.glb"), std::ios::binary) << glb << json;
  try {
    describe(scratch.path("bad.glb"));
    ADD_FAILURE() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("exception"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("bad.glb"), std::string::npos) << error.what();
  }
}

TEST(Describe, RefusesWhatIsNeither) {
  const Scratch scratch;
  std::ofstream(scratch.path("text.tif")) << "not a raster";
  std::ofstream(scratch.path("text.ply")) << "not a mesh";
  EXPECT_THROW(describe(scratch.path("text.tif")), InputError);
  EXPECT_THROW(describe(scratch.path("text.ply")), InputError);
  EXPECT_THROW(describe(scratch.path("none.tif")), InputError);
}

}  // namespace
}  // namespace tinsmith
