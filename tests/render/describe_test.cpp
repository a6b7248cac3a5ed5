#include "tinsmith/describe.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "scratch.hpp"
#include "tinsmith/error.hpp"

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
