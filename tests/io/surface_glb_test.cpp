// GLB as other programs write it, and as glTF's rules want it.

#include <nlohmann/json.hpp>

#include "io/surface_cases.hpp"

namespace tinsmith {
namespace {

using Json = nlohmann::json;
using Place = std::array<double, 3>;

std::string glb(const Json& json, const std::string& binary) {
  std::string text = json.dump();
  text.resize((text.size() + 3) / 4 * 4, ' ');
  std::string bytes = "glTF";
  append_bytes(bytes, std::uint32_t{2});
  append_bytes(bytes, static_cast<std::uint32_t>(28 + text.size() + binary.size()));
  append_bytes(bytes, static_cast<std::uint32_t>(text.size()));
  bytes += "JSON" + text;
  append_bytes(bytes, static_cast<std::uint32_t>(binary.size()));
  return bytes + std::string("BIN\0", 4) + binary;
}

/// A triangle at 0 0 0, 1 0 0, 0 1 0; normals along z; a colour of bytes with alpha; indices of bytes.
struct Scene {
  Scene() {
    for (const float coordinate : {0, 0, 0, 1, 0, 0, 0, 1, 0}) append_bytes(binary, coordinate);
    for (const float coordinate : {0, 0, 1, 0, 0, 1, 0, 0, 1}) append_bytes(binary, coordinate);
    for (const int channel : {255, 0, 51, 9, 0, 0, 0, 9, 0, 255, 0, 9})
      append_bytes(binary, static_cast<std::uint8_t>(channel));
    binary += std::string("\0\1\2\0", 4);
    json["asset"]["version"] = "2.0";
    json["scenes"] = {{{"nodes", {0}}}};
    json["nodes"] = {{{"mesh", 0}}};
    json["meshes"] = {
        {{"primitives",
          {{{"attributes", {{"POSITION", 0}, {"NORMAL", 1}, {"COLOR_0", 2}}}, {"indices", 3}, {"material", 7}}}}}};
    json["accessors"] = {
        {{"bufferView", 0}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", 0}, {"byteOffset", 36}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}},
        {{"bufferView", 1}, {"componentType", 5121}, {"count", 3}, {"type", "VEC4"}, {"normalized", true}},
        {{"bufferView", 2}, {"componentType", 5121}, {"count", 3}, {"type", "SCALAR"}}};
    json["bufferViews"] = {{{"buffer", 0}, {"byteLength", 72}},
                           {{"buffer", 0}, {"byteOffset", 72}, {"byteLength", 12}},
                           {{"buffer", 0}, {"byteOffset", 84}, {"byteLength", 3}}};
    json["buffers"] = {{{"byteLength", 88}}};
  }
  Json& primitive() { return json["meshes"][0]["primitives"][0]; }
  std::string bytes() const { return glb(json, binary); }

  Json json;
  std::string binary;
};

// sRGB of light.
constexpr float kFifthOfLight = 0.4845292F, kOne65535thOfLight = 12.92F / 65535;

void expect_near(const std::vector<float>& values, const std::vector<float>& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], expected[k], 1e-6) << k;
}

TEST(SurfaceGlb, ReadsBytesShortsAndStrides) {
  const ScratchFolder folder;
  Scene scene;
  const Surface surface = read_bytes(folder, ".glb", scene.bytes());
  EXPECT_EQ(surface.position, (std::vector<Place>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(surface.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}));
  expect_near(surface.find(AttributeKind::kColour)->values, {1, 0, kFifthOfLight, 0, 0, 0, 0, 1, 0});
  EXPECT_EQ(surface.find(AttributeKind::kNormal)->values, (std::vector<float>{0, 0, 1, 0, 0, 1, 0, 0, 1}));
  // Colours as shorts, every second one skipped.
  scene.json["accessors"][2] = {
      {"bufferView", 1}, {"componentType", 5123}, {"count", 1}, {"type", "VEC3"}, {"normalized", true}};
  EXPECT_NE(complaint_about(folder, ".glb", scene.bytes()).find("differ in number"), std::string::npos);
  for (const int channel : {65535, 1, 0, 9, 9, 9, 0, 65535, 0, 9, 9, 9, 0, 0, 13107})
    append_bytes(scene.binary, static_cast<std::uint16_t>(channel));
  scene.json["accessors"][2]["count"] = 3;
  scene.json["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", 88}, {"byteLength", 30}, {"byteStride", 12}};
  expect_near(read_bytes(folder, ".glb", scene.bytes()).find(AttributeKind::kColour)->values,
              {1, kOne65535thOfLight, 0, 0, 1, 0, 0, 0, kFifthOfLight});
}

TEST(SurfaceGlb, ReadsColoursOfFloatsAsLinearToo) {
  const ScratchFolder folder;
  Scene scene;
  for (const double light : {1.0, 0.2, 0.0, -0.5, 1.5, 1 / 65535.0, 0.2, 0.2, 0.2})
    append_bytes(scene.binary, static_cast<float>(light));
  scene.json["accessors"][2] = {{"bufferView", 1}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};
  scene.json["bufferViews"][1] = {{"buffer", 0}, {"byteOffset", 88}, {"byteLength", 36}};
  expect_near(read_bytes(folder, ".glb", scene.bytes()).find(AttributeKind::kColour)->values,
              {1, kFifthOfLight, 0, 0, 1, kOne65535thOfLight, kFifthOfLight, kFifthOfLight, kFifthOfLight});
}

TEST(SurfaceGlb, AppliesTransformsOfNodes) {
  const ScratchFolder folder;
  Scene scene;
  const double half = std::sqrt(0.5);
  // The inner node doubles x, the outer one turns x to y about z and moves; a third mirrors by a matrix.
  scene.json["nodes"] = {{{"children", {1}}, {"rotation", {0, 0, half, half}}, {"translation", {10, 20, 30}}},
                         {{"mesh", 0}, {"scale", {2, 1, 1}}},
                         {{"mesh", 0}, {"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 0, 5, 5, 5, 1}}}};
  scene.json["scenes"] = {{{"nodes", Json::array()}}, {{"nodes", {0, 2}}}};
  scene.json["scene"] = 1;
  const Surface surface = read_bytes(folder, ".glb", scene.bytes());
  const std::vector<Place> expected{{10, 20, 30}, {10, 22, 30}, {9, 20, 30}, {5, 5, 5}, {6, 5, 5}, {5, 6, 5}};
  ASSERT_EQ(surface.position.size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(surface.position[v][k], expected[v][k], 1e-12) << v;
  EXPECT_EQ(surface.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 5, 4}}))
      << "a mirrored mesh is turned over";
  EXPECT_EQ(surface.find(AttributeKind::kNormal)->values[2], 1);
  EXPECT_EQ(surface.find(AttributeKind::kNormal)->values[11], -1) << "and its normals follow";
}

TEST(SurfaceGlb, JoinsMeshesWithAndWithoutAttributes) {
  const ScratchFolder folder;
  Scene scene;
  const Json plain = {{"attributes", {{"POSITION", 0}}}};
  Json& primitives = scene.json["meshes"][0]["primitives"];
  primitives = {plain, scene.primitive(), plain, {{"attributes", {{"POSITION", 0}}}, {"mode", 0}}};
  const Surface surface = read_bytes(folder, ".glb", scene.bytes());
  EXPECT_EQ(surface.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}}));
  EXPECT_EQ(surface.find(AttributeKind::kColour)->values[0], 1);
  EXPECT_EQ(surface.find(AttributeKind::kColour)->values[10], 0);
  EXPECT_EQ(surface.find(AttributeKind::kColour)->values[26], 1) << "white where there is none";
  EXPECT_EQ(surface.find(AttributeKind::kNormal)->values[2], 0);
  EXPECT_EQ(surface.find(AttributeKind::kNormal)->values[11], 1);
}

TEST(SurfaceGlb, SaysWhatItCannotRead) {
  const ScratchFolder folder;
  const auto complaint = [&](auto change) {
    Scene scene;
    change(scene);
    return complaint_about(folder, ".glb", scene.bytes());
  };
  const auto expect = [&](const char* words, auto change) {
    const std::string text = complaint(change);
    EXPECT_NE(text.find(words), std::string::npos) << words << ": " << text;
  };
  EXPECT_EQ(complaint([](Scene&) {}), "");
  expect("sparse", [](Scene& s) { s.json["accessors"][0]["sparse"] = Json::object(); });
  expect("has no bufferView", [](Scene& s) { s.json["accessors"][0].erase("bufferView"); });
  expect("KHR_draco", [](Scene& s) { s.json["extensionsRequired"] = {"KHR_draco_mesh_compression"}; });
  expect("Draco", [](Scene& s) { s.primitive()["extensions"]["KHR_draco_mesh_compression"] = Json::object(); });
  expect("compressed", [](Scene& s) { s.json["bufferViews"][0]["extensions"] = Json::object(); });
  expect("outside", [](Scene& s) { s.json["buffers"][0]["uri"] = "mesh.bin"; });
  expect("outside", [](Scene& s) { s.json["bufferViews"][0]["buffer"] = 1; });
  expect("strips", [](Scene& s) { s.primitive()["mode"] = 5; });
  expect("not three floats", [](Scene& s) { s.json["accessors"][0]["componentType"] = 5123; });
  expect("COLOR_0", [](Scene& s) { s.json["accessors"][2]["normalized"] = false; });
  expect("beyond its bufferView", [](Scene& s) { s.json["accessors"][0]["count"] = 7; });
  expect("beyond its bufferView", [](Scene& s) { s.json["accessors"][0]["count"] = ~std::uint64_t{0}; });
  expect("beyond its bufferView", [](Scene& s) { s.json["accessors"][1]["byteOffset"] = ~std::uint64_t{0}; });
  expect("beyond its bufferView", [](Scene& s) { s.json["bufferViews"][0]["byteStride"] = ~std::uint64_t{0}; });
  expect("beyond the binary", [](Scene& s) { s.json["bufferViews"][0]["byteLength"] = ~std::uint64_t{0}; });
  expect("not whole", [](Scene& s) { s.json["accessors"][0]["count"] = -3; });
  expect("names vertex 3 of 3", [](Scene& s) { s.binary[84] = 3; });
  expect("two parents", [](Scene& s) { s.json["nodes"][0]["children"] = {0}; });
  expect("no element 4", [](Scene& s) { s.json["scenes"][0]["nodes"] = {4}; });
  expect("no valid glTF", [](Scene& s) { s.json.erase("meshes"); });
  expect("no valid glTF", [](Scene& s) { s.json = 5; });
  expect("no triangles", [](Scene& s) { s.json["nodes"][0].erase("mesh"); });
  expect("not finite", [](Scene& s) {
    s.json["nodes"][0]["scale"] = {1e308, 1e308, 1e308}, s.json["nodes"][0]["translation"] = {1.7e308, 1.7e308, 0};
  });
}

TEST(SurfaceGlb, RefusesDeepJson) {
  const ScratchFolder folder;
  Scene scene;
  for (int depth = 0; depth < 100; ++depth) scene.json["extras"] = Json::array({scene.json["extras"]});
  EXPECT_NE(complaint_about(folder, ".glb", scene.bytes()).find("nested"), std::string::npos);
}

// 30 000 nodes of 30 000 vertices each would fill 30 GB.
TEST(SurfaceGlb, RefusesScenesThatUnfoldWithoutEnd) {
  const ScratchFolder folder;
  Scene scene;
  scene.binary.resize(12 * 30000);
  scene.json["bufferViews"][0]["byteLength"] = scene.binary.size();
  scene.json["accessors"][0]["count"] = 30000;
  scene.primitive() = {{"attributes", {{"POSITION", 0}}}};
  for (int node = 1; node < 30000; ++node) {
    scene.json["nodes"].push_back(scene.json["nodes"][0]);
    scene.json["scenes"][0]["nodes"].push_back(node);
  }
  EXPECT_NE(complaint_about(folder, ".glb", scene.bytes()).find("more vertices than"), std::string::npos);
}

TEST(SurfaceGlb, WritesWhatGltfWants) {
  const ScratchFolder folder;
  const Surface surface = torus(5, 1e6 / 3);
  write_surface(folder.file("a.glb"), surface);
  const std::string bytes = bytes_of(folder.file("a.glb"));
  EXPECT_EQ(bytes.size() % 4, 0U);
  std::uint32_t size = 0;
  std::memcpy(&size, bytes.data() + 12, 4);
  const Json json = Json::parse(bytes.substr(20, size));
  const std::string binary = bytes.substr(28 + size);
  EXPECT_EQ(json["buffers"][0]["byteLength"], binary.size());
  for (const Json& view : json["bufferViews"]) EXPECT_EQ(view["byteOffset"].get<int>() % 4, 0);
  const Json& attributes = json["meshes"][0]["primitives"][0]["attributes"];
  EXPECT_EQ(attributes.size(), 3U);
  const Json& places = json["accessors"][attributes["POSITION"].get<std::size_t>()];
  const auto low = places["min"].get<std::array<float, 3>>();
  const auto high = places["max"].get<std::array<float, 3>>();
  std::array<bool, 6> is_touched{};
  for (std::size_t v = 0; v < surface.position.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k) {
      float coordinate = 0;
      std::memcpy(&coordinate, binary.data() + 12 * v + 4 * k, 4);
      ASSERT_TRUE(coordinate >= low[k] && coordinate <= high[k]);
      is_touched[k] = is_touched[k] || coordinate == low[k];
      is_touched[3 + k] = is_touched[3 + k] || coordinate == high[k];
    }
  EXPECT_EQ(is_touched, (std::array<bool, 6>{true, true, true, true, true, true}));
  EXPECT_NEAR(json["nodes"][0]["translation"][0].get<double>(), 1e6 / 3, 5);
}

}  // namespace
}  // namespace tinsmith
