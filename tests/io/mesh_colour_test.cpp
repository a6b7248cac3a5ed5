// Vertex colours in mesh files: every format that holds them gives them back to the byte.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "io/mesh_cases.hpp"
#include "io/mesh_file.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {
namespace {

/// Enough vertices for several blocks.
TerrainMesh coloured_mesh(int n_channels) {
  TerrainMesh mesh = random_mesh(21, 80, 60);
  std::mt19937_64 random(22);
  mesh.n_channels = n_channels;
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    Levels colour{};
    for (int c = 0; c < n_channels; ++c)
      colour[static_cast<std::size_t>(c)] = static_cast<float>(random() % 25501) / 100.0F;
    mesh.colour.push_back(colour);
  }
  return mesh;
}

struct ReadColours {
  std::vector<Levels> colours;
  int n_channels = 0;
  std::size_t n_vertices = 0;
};

ReadColours read_colours(const std::string& path) {
  ReadColours result;
  MeshVisitor visitor;
  visitor.colours = [&](std::span<const Levels> colours, int n_channels) {
    EXPECT_EQ(result.colours.size(), result.n_vertices);  // before the block's vertices
    result.colours.insert(result.colours.end(), colours.begin(), colours.end());
    result.n_channels = n_channels;
  };
  visitor.vertices = [&](std::span<const std::array<double, 3>> vertices) { result.n_vertices += vertices.size(); };
  visitor.triangles = [](std::span<const std::array<std::uint64_t, 3>>) {};
  visit_mesh(path, visitor);
  return result;
}

/// Red, green, blue and alpha of a colour, by what the channels mean.
Levels expected(const Levels& c, int n_channels) {
  switch (n_channels) {
    case 1:
      return {c[0], c[0], c[0], 0};
    case 2:
      return {c[0], c[0], c[0], c[1]};
    default:
      return c;
  }
}

std::vector<std::string> extensions_for(int n_channels) {
  if (n_channels % 2 == 0) return {".ply", ".glb"};
  return {".ply", ".glb", ".obj"};
}

TEST(MeshColour, ComesBackWithinHalfALevelFromEveryFormat) {
  const ScratchFolder folder;
  for (int n_channels = 1; n_channels <= 4; ++n_channels) {
    const TerrainMesh mesh = coloured_mesh(n_channels);
    for (const std::string& extension : extensions_for(n_channels)) {
      SCOPED_TRACE(std::to_string(n_channels) + extension);
      const std::string path = folder.file("mesh" + extension);
      write_mesh(path, mesh, frames()[0]);
      const ReadColours read = read_colours(path);
      ASSERT_EQ(read.colours.size(), mesh.colour.size());
      EXPECT_EQ(read.n_channels, n_channels % 2 == 1 ? 3 : 4);
      for (std::size_t v = 0; v < mesh.colour.size(); ++v)
        for (std::size_t c = 0; c < 4; ++c)
          ASSERT_NEAR(read.colours[v][c], expected(mesh.colour[v], n_channels)[c], 0.501) << v;
    }
  }
}

TEST(MeshColour, ChangesNoPlaceAndNoTriangle) {
  const ScratchFolder folder;
  const TerrainMesh mesh = coloured_mesh(3);
  TerrainMesh plain = mesh;
  plain.n_channels = 0;
  plain.colour.clear();
  for (const std::string& extension : extensions_for(3)) {
    write_mesh(folder.file("colour" + extension), mesh, frames()[0]);
    write_mesh(folder.file("plain" + extension), plain, frames()[0]);
    const Tin coloured = read_mesh(folder.file("colour" + extension));
    const Tin uncoloured = read_mesh(folder.file("plain" + extension));
    EXPECT_EQ(coloured.vertices, uncoloured.vertices) << extension;
    EXPECT_EQ(coloured.triangles, uncoloured.triangles) << extension;
    EXPECT_TRUE(read_colours(folder.file("plain" + extension)).colours.empty()) << extension;
  }
}

TEST(MeshColour, OtherReadersFindIt) {
  const ScratchFolder folder;
  const TerrainMesh mesh = coloured_mesh(3);
  for (const std::string& extension : extensions_for(3)) {
    write_mesh(folder.file("mesh" + extension), mesh, frames()[0]);
    const Surface surface = read_surface(folder.file("mesh" + extension));
    const SurfaceAttribute* const colour = surface.find(AttributeKind::kColour);
    ASSERT_NE(colour, nullptr) << extension;
    ASSERT_EQ(colour->values.size(), 3 * mesh.colour.size());
    for (std::size_t i = 0; i < colour->values.size(); ++i)
      ASSERT_NEAR(colour->values[i] * 255, mesh.colour[i / 3][i % 3], 0.501) << extension;
  }
}

TEST(MeshColour, OfGlbIsAlignedAsTheFormatWants) {
  const ScratchFolder folder;
  for (const int n_channels : {3, 4}) {
    write_mesh(folder.file("mesh.glb"), coloured_mesh(n_channels), frames()[0]);
    const std::string bytes = bytes_of(folder.file("mesh.glb"));
    std::uint32_t size = 0;
    std::copy(bytes.begin() + 12, bytes.begin() + 16, reinterpret_cast<char*>(&size));
    const auto json = nlohmann::json::parse(bytes.substr(20, size));
    const auto& attributes = json["meshes"][0]["primitives"][0]["attributes"];
    const auto& colours = json["accessors"][attributes["COLOR_0"].get<std::size_t>()];
    EXPECT_EQ(colours["type"], n_channels == 3 ? "VEC3" : "VEC4");
    EXPECT_EQ(colours["componentType"], 5123);
    EXPECT_EQ(colours["normalized"], true);
    EXPECT_EQ(colours["byteOffset"].get<int>() % 4, 0);
    EXPECT_EQ(json["bufferViews"][0]["byteStride"].get<int>() % 4, 0);
    EXPECT_EQ(json["bufferViews"][1]["byteOffset"].get<std::uint64_t>() % 4, 0U);
  }
}

TEST(MeshColour, OfGlbIsLinearAsViewersExpect) {
  const ScratchFolder folder;
  TerrainMesh mesh = coloured_mesh(4);
  mesh.colour[0] = {255, 128, 10, 128};
  write_mesh(folder.file("mesh.glb"), mesh, frames()[0]);
  const std::string bytes = bytes_of(folder.file("mesh.glb"));
  std::uint32_t json_size = 0;
  std::copy(bytes.begin() + 12, bytes.begin() + 16, reinterpret_cast<char*>(&json_size));
  std::array<std::uint16_t, 4> shares{};
  const std::size_t first = 20 + json_size + 8 + 3 * sizeof(float);
  std::copy_n(bytes.data() + first, sizeof shares, reinterpret_cast<char*>(shares.data()));
  EXPECT_EQ(shares[0], 65535);
  EXPECT_NEAR(shares[1] / 65535.0, 0.21586, 1e-5);
  EXPECT_NEAR(shares[2] / 65535.0, 0.003035, 1e-5);
  EXPECT_EQ(shares[3], 128 * 257) << "alpha is no light";
}

TEST(MeshColour, CountsInTheSizeThatIsForeseen) {
  const ScratchFolder folder;
  const TerrainMesh mesh = coloured_mesh(3);
  TerrainMesh plain = mesh;
  plain.n_channels = 0;
  for (const std::string& extension : extensions_for(3)) {
    const auto written = [&](const TerrainMesh& what) {
      write_mesh(folder.file("mesh" + extension), what, frames()[0]);
      return static_cast<double>(bytes_of(folder.file("mesh" + extension)).size());
    };
    const auto foreseen = [&](int n_channels) {
      return static_cast<double>(
          expected_mesh_bytes("a" + extension, mesh.position.size(), mesh.triangles.size(), n_channels));
    };
    EXPECT_NEAR((foreseen(3) - foreseen(0)) / (written(mesh) - written(plain)), 1, 0.1) << extension;
  }
}

TEST(MeshColour, IsRefusedWhereAFormatHasNoPlaceForIt) {
  const ScratchFolder folder;
  EXPECT_THROW(write_mesh(folder.file("mesh.2dm"), coloured_mesh(3), frames()[0]), UsageError);
  EXPECT_THROW(write_mesh(folder.file("mesh.obj"), coloured_mesh(2), frames()[0]), UsageError);
  EXPECT_THROW(write_mesh(folder.file("mesh.obj"), coloured_mesh(4), frames()[0]), UsageError);
  EXPECT_EQ(folder.n_files(), 0U);
  EXPECT_NO_THROW(require_format_holds_colour("mesh.2dm", 0));
}

TEST(MeshColour, ThatIsNoneIsAnInputError) {
  const ScratchFolder folder;
  const std::string path = folder.file("mesh.obj");
  const std::string good = "v 0 0 0 1 0 0.5\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n";
  put_bytes(path, good);
  EXPECT_EQ(read_colours(path).colours.size(), 3U);
  for (const std::string vertex : {"v 0 0 0", "v 0 0 0 1", "v 0 0 0 1 0 2", "v 0 0 0 1 0 nan", "v 0 0 0 1 0 0 1"}) {
    put_bytes(path, good + vertex + "\n");
    EXPECT_THROW(read_colours(path), InputError) << vertex;
  }
  write_mesh(folder.file("mesh.ply"), coloured_mesh(3), frames()[0]);
  std::string ply = bytes_of(folder.file("mesh.ply"));
  ply.erase(ply.find("property uchar green\n"), 21);
  put_bytes(folder.file("mesh.ply"), ply);
  EXPECT_THROW(read_colours(folder.file("mesh.ply")), InputError);
}

}  // namespace
}  // namespace tinsmith
