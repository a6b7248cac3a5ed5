#include "io/mesh_file.hpp"

#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "io/mesh_cases.hpp"
#include "io/output_file.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::array kExtensions{".ply", ".obj", ".glb", ".2dm"};

double signed_area(const Tin& tin, const std::array<std::uint32_t, 3>& triangle) {
  const auto& [a, b, c] = triangle;
  const auto& v = tin.vertices;
  return (v[b][0] - v[a][0]) * (v[c][1] - v[a][1]) - (v[b][1] - v[a][1]) * (v[c][0] - v[a][0]);
}

TEST(MeshFile, ReadsBackWhatWasWritten) {
  const TerrainMesh mesh = random_mesh(11, 40, 30);
  const auto [lowest, highest] = std::minmax_element(mesh.height.begin(), mesh.height.end());
  for (const GridFrame& frame : frames())
    for (const std::string extension : kExtensions) {
      const ScratchFolder folder;  // its own, for the .prj
      const std::string path = folder.file("mesh" + extension);
      write_mesh(path, mesh, frame);
      const Tin tin = read_mesh(path);
      ASSERT_EQ(tin.vertices.size(), mesh.position.size()) << extension;
      ASSERT_EQ(tin.triangles.size(), mesh.triangles.size()) << extension;
      const double rounding = height_rounding(path, *lowest, *highest);
      for (std::size_t v = 0; v < tin.vertices.size(); ++v) {
        const auto [x, y] = frame.to_crs(mesh.position[v].x / 16.0, mesh.position[v].y / 16.0);
        ASSERT_EQ(tin.vertices[v][0], x) << extension;
        ASSERT_EQ(tin.vertices[v][1], y) << extension;
        ASSERT_LE(std::abs(tin.vertices[v][2] - mesh.height[v]), rounding) << extension;
      }
      for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
        ASSERT_EQ(tin.triangles[t][0], mesh.triangles[t][0]);
        ASSERT_GT(signed_area(tin, tin.triangles[t]), 0) << extension << ": counter-clockwise seen from above";
      }
    }
}

TEST(MeshFile, RoundsHeightsInGlbOnly) {
  EXPECT_EQ(height_rounding("a.ply", -10, 9000), 0);
  EXPECT_EQ(height_rounding("a.OBJ", -10, 9000), 0);
  EXPECT_EQ(height_rounding("a.2dm", -10, 9000), 0);
  EXPECT_GT(height_rounding("a.glb", -10, 9000), 0);
  EXPECT_LT(height_rounding("a.glb", -10, 9000), 3e-4);
  EXPECT_LT(height_rounding("a.glb", 1000000, 1000001), 1e-7);
}

TEST(MeshFile, WritesTheSameBytesUnderAnyName) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(5, 7, 9);
  for (const std::string extension : kExtensions) {
    write_mesh(folder.file("one" + extension), mesh, frames()[0]);
    write_mesh(folder.file("two" + extension), mesh, frames()[0]);
    EXPECT_EQ(bytes_of(folder.file("one" + extension)), bytes_of(folder.file("two" + extension)));
  }
}

TEST(MeshFile, CarriesTheCrs) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(5, 2, 2);
  OGRSpatialReference expected;
  expected.importFromWkt(kUtm32);
  for (const std::string extension : kExtensions) {
    write_mesh(folder.file("a" + extension), mesh, frames()[0]);
    OGRSpatialReference read;
    ASSERT_EQ(read.SetFromUserInput(read_mesh(folder.file("a" + extension)).crs_wkt.c_str()), OGRERR_NONE);
    EXPECT_EQ(read.GetUTMZone(), 32) << extension;
    EXPECT_EQ(read.GetLinearUnits(), 1) << extension;
  }
}

TEST(MeshFile, NeitherReplacesNorRemovesNorFollowsAPrjOfAnotherCrs) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(5, 2, 2);
  const std::string prj = folder.file("a.prj");
  for (const std::string extension : {".obj", ".2dm"}) {
    const std::string path = folder.file("a" + extension);
    write_mesh(path, mesh, frames()[0]);
    const std::string own = bytes_of(prj);
    const std::string written = bytes_of(path);
    EXPECT_THROW(write_mesh(path, mesh, GridFrame{}), OutputError) << "it would be read with the CRS of the .prj";
    EXPECT_EQ(bytes_of(prj), own);
    EXPECT_EQ(bytes_of(path), written);
    std::ofstream(prj) << R"(LOCAL_CS["of roads"])";
    EXPECT_THROW(require_place_for_crs(path, frames()[0].crs_wkt), OutputError);
    EXPECT_THROW(write_mesh(path, mesh, frames()[0]), OutputError);
    EXPECT_EQ(bytes_of(prj), R"(LOCAL_CS["of roads"])");
    std::filesystem::remove(prj);
  }
}

TEST(MeshFile, LeavesAPrjOfTheSameCrsAsItIs) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(5, 2, 2);
  OGRSpatialReference crs;
  crs.importFromWkt(frames()[0].crs_wkt.c_str());
  char* wkt = nullptr;
  crs.exportToPrettyWkt(&wkt);
  const std::string other_words = wkt;
  CPLFree(wkt);
  std::ofstream(folder.file("a.prj")) << other_words;
  for (const std::string extension : {".obj", ".2dm"}) {
    write_mesh(folder.file("a" + extension), mesh, frames()[0]);
    EXPECT_EQ(bytes_of(folder.file("a.prj")), other_words);
  }
}

TEST(MeshFile, KnowsItsExtensions) {
  for (const std::string extension : kExtensions) EXPECT_NO_THROW(require_mesh_extension("a" + extension));
  EXPECT_NO_THROW(require_mesh_extension("a.PLY"));
  for (const char* path : {"a", "a.stl", "a.ply.gz", ".ply", ""}) {
    EXPECT_THROW(require_mesh_extension(path), UsageError) << path;
    EXPECT_THROW(read_mesh(path), InputError) << path;
  }
}

// Anything but a whole file is refused, whatever is missing.
TEST(MeshFile, RefusesEveryTruncation) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(3, 3, 2);
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    write_mesh(path, mesh, frames()[0]);
    const std::string whole = bytes_of(path);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      put_bytes(path, whole.substr(0, length));
      ASSERT_THROW(read_mesh(path), InputError) << extension << " cut at " << length << " of " << whole.size();
    }
    if (extension == ".ply" || extension == ".glb") {
      put_bytes(path, whole + '\0');
      EXPECT_THROW(read_mesh(path), InputError) << extension << " with a byte more";
    }
  }
}

// A damaged file is refused or gives sound numbers; it never crashes (sanitizers watch) or asks for much memory.
TEST(MeshFile, SurvivesFlippedBits) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(3, 3, 2);
  std::mt19937_64 random(20240607);
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    write_mesh(path, mesh, frames()[0]);
    const std::string whole = bytes_of(path);
    int n_refused = 0;
    for (int trial = 0; trial < 2000; ++trial) {
      std::string damaged = whole;
      for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips)
        damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
      put_bytes(path, damaged);
      try {
        const Tin tin = read_mesh(path);
        for (const auto& triangle : tin.triangles)
          for (const std::uint32_t corner : triangle) ASSERT_LT(corner, tin.vertices.size());
        for (const auto& vertex : tin.vertices)
          for (const double coordinate : vertex) ASSERT_TRUE(std::isfinite(coordinate));
      } catch (const InputError& error) {
        ++n_refused;
        ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
      }
    }
    EXPECT_GT(n_refused, 200) << extension;
  }
}

TEST(MeshFile, RefusesGarbage) {
  const ScratchFolder folder;
  std::mt19937_64 random(7);
  std::string noise(5000, ' ');
  for (char& c : noise) c = static_cast<char>(random());
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    for (const std::string& bytes : {std::string(), std::string("\n"), noise, std::string(3 << 20, 'v')}) {
      put_bytes(path, bytes);
      EXPECT_THROW(read_mesh(path), InputError) << extension;
    }
    EXPECT_THROW(read_mesh(folder.file("missing" + extension)), InputError);
    std::filesystem::create_directory(folder.file("folder" + extension));
    EXPECT_THROW(read_mesh(folder.file("folder" + extension)), InputError);
    EXPECT_THROW(write_mesh(folder.file("folder" + extension), random_mesh(1, 1, 1), {}), OutputError);
  }
}

TEST(MeshFile, RefusesHugeCountsWithoutAskingForMemory) {
  const ScratchFolder folder;
  const std::string path = folder.file("a.ply");
  put_bytes(path,
            "ply\nformat binary_little_endian 1.0\nelement vertex 18446744073709551615\nproperty double x\n"
            "property double y\nproperty double z\nelement face 4611686018427387904\n"
            "property list uchar int vertex_indices\nend_header\n");
  EXPECT_THROW(read_mesh(path), InputError);
}

TEST(MeshFile, NamesTheReasonWhenAFolderCannotBeWritten) {
  const ScratchFolder folder;
  for (const std::string extension : kExtensions) try {
      write_mesh(folder.file("nowhere/a" + extension), random_mesh(1, 1, 1), {});
      FAIL() << extension;
    } catch (const OutputError& error) {
      EXPECT_NE(std::string(error.what()).find("nowhere/a" + extension), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("No such file or directory"), std::string::npos) << error.what();
    }
}

TEST(OutputFile, AppearsOnlyWhenCommitted) {
  const ScratchFolder folder;
  put_bytes(folder.file("a"), "old");
  {
    OutputFile file(folder.file("a"));
    file.write("new");
    file.finish();
    EXPECT_EQ(bytes_of(folder.file("a")), "old");
  }
  EXPECT_EQ(bytes_of(folder.file("a")), "old");
  EXPECT_EQ(folder.n_files(), 1U);
  OutputFile file(folder.file("a"));
  file.write("new");
  file.commit();
  EXPECT_EQ(bytes_of(folder.file("a")), "new");
  EXPECT_EQ(folder.n_files(), 1U);
}

TEST(OutputFile, FollowsLinksAndRefusesDevices) {
  const ScratchFolder folder;
  put_bytes(folder.file("a"), "old");
  std::filesystem::create_symlink("a", folder.file("link"));
  OutputFile file(folder.file("link"));
  file.write("new");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(bytes_of(folder.file("a")), "new");
  EXPECT_THROW(OutputFile("/dev/full"), OutputError);
}

}  // namespace
}  // namespace tinsmith
