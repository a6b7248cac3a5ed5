#include <array>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>

#include "io/mesh_cases.hpp"
#include "io/mesh_file.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

struct Glb {
  nlohmann::json json;
  std::string binary;
};

Glb split(const std::string& bytes) {
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  return {nlohmann::json::parse(bytes.substr(20, size)), bytes.substr(28 + size)};
}

std::array<float, 3> position(const Glb& glb, std::size_t v) {
  std::array<float, 3> p;
  std::memcpy(p.data(), glb.binary.data() + v * sizeof p, sizeof p);
  return p;
}

/// v + 2 q x (q x v + w v), the rotation of a vector by a quaternion as in any textbook.
std::array<double, 3> rotate(const std::array<double, 4>& q, const std::array<double, 3>& v) {
  const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
    return std::array{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const std::array<double, 3> axis{q[0], q[1], q[2]};
  auto inner = cross(axis, v);
  for (std::size_t k = 0; k < 3; ++k) inner[k] += q[3] * v[k];
  const auto outer = cross(axis, inner);
  return {v[0] + 2 * outer[0], v[1] + 2 * outer[1], v[2] + 2 * outer[2]};
}

// A viewer that knows nothing of extras puts every vertex at east, up, -north in metres.
TEST(MeshGlb, StandsWhereTheNodePutsIt) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(4, 20, 15);
  for (const GridFrame& frame : frames()) {
    write_mesh(folder.file("a.glb"), mesh, frame);
    const Glb glb = split(bytes_of(folder.file("a.glb")));
    const auto& node = glb.json["nodes"][0];
    const auto translation = node["translation"].get<std::array<double, 3>>();
    const auto rotation = node["rotation"].get<std::array<double, 4>>();
    const auto scale = node["scale"].get<std::array<double, 3>>();
    const auto metres = node["extras"]["metres_per_unit"].get<std::array<double, 3>>();
    EXPECT_EQ(node["extras"]["crs_wkt"], frame.crs_wkt);
    for (double s : scale) EXPECT_GT(s, 0) << "a mirroring node would turn the winding over";
    for (std::size_t v = 0; v < mesh.position.size(); ++v) {
      const auto p = position(glb, v);
      const auto turned = rotate(rotation, {scale[0] * p[0], scale[1] * p[1], scale[2] * p[2]});
      const auto [x, y] = frame.to_crs(mesh.position[v].x / 16.0, mesh.position[v].y / 16.0);
      ASSERT_NEAR(turned[0] + translation[0], x * metres[0], 1e-6);
      ASSERT_NEAR(turned[1] + translation[1], mesh.height[v] * metres[2], 2e-4);
      ASSERT_NEAR(turned[2] + translation[2], -y * metres[1], 1e-6);
    }
  }
}

TEST(MeshGlb, KeepsPlanPositionsExactInFloat32) {
  const ScratchFolder folder;
  TerrainMesh mesh = random_mesh(4, 1, 1);
  mesh.position = {{3, 5}, {33554403, 5}, {33554403, 7}, {3, 9}};
  write_mesh(folder.file("a.glb"), mesh, frames()[0]);
  const Tin tin = read_mesh(folder.file("a.glb"));
  for (std::size_t v = 0; v < 4; ++v) {
    const auto [x, y] = frames()[0].to_crs(mesh.position[v].x / 16.0, mesh.position[v].y / 16.0);
    EXPECT_EQ(tin.vertices[v][0], x);
    EXPECT_EQ(tin.vertices[v][1], y);
  }
}

TEST(MeshGlb, RefusesWhatItCannotHold) {
  const ScratchFolder folder;
  const auto expect_refused = [&](const TerrainMesh& mesh, const GridFrame& frame) {
    try {
      write_mesh(folder.file("a.glb"), mesh, frame);
      FAIL() << "written";
    } catch (const ResourceError& error) {
      EXPECT_NE(std::string(error.what()).find(".ply"), std::string::npos) << error.what();
    }
    EXPECT_EQ(folder.n_files(), 0U);
  };
  const TerrainMesh mesh = random_mesh(4, 1, 1);
  GridFrame sheared = frames()[0];
  sheared.geotransform[2] = 3;
  expect_refused(mesh, sheared);
  TerrainMesh wide = mesh;
  wide.position[1].x = (1 << 25) + 16;
  expect_refused(wide, frames()[0]);
  TerrainMesh high = mesh;
  high.height[1] = 1e39;
  expect_refused(high, frames()[0]);
  high.height = {-1.7e308, 1.7e308, 1e30, 0};
  expect_refused(high, frames()[0]);
  expect_refused(TerrainMesh{}, frames()[0]);
}

TEST(MeshGlb, RefusesANodeThatContradictsItsExtras) {
  const ScratchFolder folder;
  write_mesh(folder.file("a.glb"), random_mesh(4, 4, 4), frames()[0]);
  std::string bytes = bytes_of(folder.file("a.glb"));
  const std::size_t scale = bytes.find("\"scale\":[30.0");
  ASSERT_NE(scale, std::string::npos);
  bytes[scale + 9] = '6';
  put_bytes(folder.file("a.glb"), bytes);
  EXPECT_THROW(read_mesh(folder.file("a.glb")), InputError);
}

// The narrow indices end at 65535 vertices, since 65535 itself is no index in glTF.
TEST(MeshGlb, ReadsBothIndexWidths) {
  const ScratchFolder folder;
  for (const int n_rows : {254, 255, 256}) {
    const TerrainMesh mesh = random_mesh(4, 255, n_rows);
    write_mesh(folder.file("a.glb"), mesh, GridFrame{});
    EXPECT_EQ(read_mesh(folder.file("a.glb")).triangles, mesh.triangles);
    const int wide = split(bytes_of(folder.file("a.glb"))).json["accessors"][1]["componentType"];
    EXPECT_EQ(wide, mesh.position.size() < 65536 ? 5123 : 5125);
  }
}

}  // namespace
}  // namespace tinsmith
