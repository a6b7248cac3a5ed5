// PLY, OBJ and STL as other programs write them.

#include "io/surface_cases.hpp"

namespace tinsmith {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

std::string ply_header(const std::string& format) {
  return "ply\nformat " + format +
         " 1.0\nobj_info made by hand\nelement camera 2\nproperty float view\nproperty list short int what\n"
         "element vertex 4\nproperty uchar blue\nproperty double z\nproperty short x\nproperty float y\n"
         "property uchar green\nproperty list int uchar neighbours\nproperty uchar red\nproperty float quality\n"
         "element face 2\nproperty uchar flags\nproperty list ushort short vertex_index\nproperty int group\n"
         "element nothing 9000000000000\nelement edge 1\nproperty int vertex1\nend_header\n";
}

struct Values {
  std::string bytes;
  bool is_big = false;

  template <class T>
  void add(T value) {
    append_bytes(bytes, value, is_big);
  }
};

/// The same surface as in the text of PlyReadsAnyPropertiesInAnyOrder.
std::string binary_ply(bool is_big) {
  Values v{ply_header(is_big ? "binary_big_endian" : "binary_little_endian"), is_big};
  for (int camera = 0; camera < 2; ++camera) {
    v.add(1.5F);
    v.add(std::int16_t{2});
    v.add(std::int32_t{7});
    v.add(std::int32_t{8});
  }
  for (int i = 0; i < 4; ++i) {
    v.add(static_cast<std::uint8_t>(255 - i));
    v.add(0.1 * i);
    v.add(static_cast<std::int16_t>(i == 1 || i == 2 ? -300 : 0));
    v.add(i >= 2 ? 2.5F : 0);
    v.add(static_cast<std::uint8_t>(i));
    v.add(std::int32_t{i});
    for (int k = 0; k < i; ++k) v.add(std::uint8_t{9});
    v.add(std::uint8_t{51});
    v.add(0.5F * static_cast<float>(i));
  }
  v.add(std::uint8_t{0});
  v.add(std::uint16_t{4});
  for (int k = 0; k < 4; ++k) v.add(static_cast<std::int16_t>(k));
  v.add(std::int32_t{-1});
  v.add(std::uint8_t{0});
  v.add(std::uint16_t{3});
  for (int k = 3; k > 0; --k) v.add(static_cast<std::int16_t>(k));
  v.add(std::int32_t{-1});
  v.add(std::int32_t{5});
  return v.bytes;
}

TEST(SurfacePly, ReadsAnyPropertiesInAnyOrder) {
  const ScratchFolder folder;
  const std::string text = ply_header("ascii") +
                           "1.5 2 7 8\n1.5 2 7 8\n"
                           "255 0 0 0 0 0 51 0\n254 0.1 -300 0 1 1 9 51 0.5\n253 0.2 -300 2.5 2 2 9 9 51 1\n"
                           "252 0.30000000000000004 0 2.5 3 3 9 9 9 51 +1.5e0\n"
                           "0 4 0 1 2 3 -1\n\n0 3 3 2 1\n-1\n5";
  for (const std::string& bytes : {text, binary_ply(false), binary_ply(true)}) {
    const Surface surface = read_bytes(folder, ".ply", bytes);
    ASSERT_EQ(surface.position.size(), 4U);
    EXPECT_EQ(surface.position[3], (std::array<double, 3>{0, 2.5, 0.1 * 3}));
    EXPECT_EQ(surface.position[1], (std::array<double, 3>{-300, 0, 0.1}));
    EXPECT_EQ(surface.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {3, 2, 1}})) << "polygons are cut into fans";
    ASSERT_EQ(surface.attributes.size(), 2U);
    EXPECT_EQ(surface.attributes[0].kind, AttributeKind::kColour);
    EXPECT_EQ(surface.attributes[0].values[9], 0.2F);
    EXPECT_EQ(surface.attributes[0].values[10], 3 / 255.0F);
    EXPECT_EQ(surface.attributes[0].values[11], 252 / 255.0F);
    EXPECT_EQ(surface.attributes[1].name, "quality");
    EXPECT_EQ(surface.attributes[1].values, (std::vector<float>{0, 0.5F, 1, 1.5F}));
  }
}

TEST(SurfacePly, ReadsColoursByAllTheirNames) {
  const ScratchFolder folder;
  const auto colour = [&](const std::string& type, const std::array<std::string, 3>& names,
                          const std::string& full) {
    std::string text =
        "ply\r\nformat ascii 1.0\r\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
    for (const std::string& name : names) text.append("property ").append(type).append(" ").append(name) += '\n';
    text += "element face 1\nproperty list uint8 uint32 vertex_indices\nend_header\n";
    for (const char* place : {"0 0 0", "1 0 0", "0 1 0"}) text.append(place).append(" 0 0 ").append(full) += '\n';
    const Surface surface = read_bytes(folder, ".ply", text + "3 0 1 2\n");
    return surface.find(AttributeKind::kColour)->values.at(2);
  };
  EXPECT_EQ(colour("uchar", {"red", "green", "blue"}, "255"), 1);
  EXPECT_EQ(colour("uint16", {"r", "g", "b"}, "65535"), 1);
  EXPECT_EQ(colour("float", {"r", "g", "b"}, "0.25"), 0.25F);
  EXPECT_EQ(colour("int", {"diffuse_red", "diffuse_green", "diffuse_blue"}, "51"), 0.2F);
}

TEST(SurfacePly, RefusesCountsThatLieWithoutAskingForMemory) {
  const ScratchFolder folder;
  for (const std::string format : {"ascii", "binary_little_endian"})
    for (const std::string counts :
         {"9223372036854775807", "4294967295", "2000000000", "-1", "99999999999999999999"})
      for (const bool of_vertices : {true, false}) {
        const std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + (of_vertices ? counts : "1") +
                                 "\nproperty double x\nproperty double y\nproperty double z\nelement face " +
                                 (of_vertices ? "1" : counts) +
                                 "\nproperty list uchar int vertex_indices\nend_header\n";
        EXPECT_NE(complaint_about(folder, ".ply", text + std::string(40, '1')), "") << text;
      }
}

TEST(SurfaceObj, ReadsWhatIsOfUseAndIgnoresTheRest) {
  const ScratchFolder folder;
  const Surface surface = read_bytes(folder, ".obj",
                                     "# by hand\nmtllib a.mtl\no thing\r\nv 0 0 0 1\nv 1 0 0 1\n  v\t1 1 0\n"
                                     "v 0 1 0\nvt 0 0\ng a b\nusemtl red\ns off\nf 1/1 2/1 3/1 \\\n 4/1\nl 1 2\n"
                                     "v 0 0 1\nf -1 -2 -3\nf 5 1 2");
  EXPECT_EQ(surface.position.size(), 5U);
  EXPECT_EQ(surface.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 3, 2}, {4, 0, 1}}));
  EXPECT_TRUE(surface.attributes.empty());
}

TEST(SurfaceObj, SplitsAVertexWithTwoNormals) {
  const ScratchFolder folder;
  const Surface surface = read_bytes(folder, ".obj",
                                     "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 0 0 1 1 1 1\n"
                                     "vn 0 0 1\nvn 1 0 0\nvn 0 0 1\n"
                                     "f 1//1 2//1 3//1\nf 1/5/2 3//2 4//-2\nf 1//3 2//-1 4\n");
  // 1 and 3 are split; the third vn is the first again; 4 has a normal and none.
  EXPECT_EQ(surface.triangles, (Triangles{{0, 1, 2}, {4, 5, 3}, {0, 1, 6}}));
  ASSERT_EQ(surface.position.size(), 7U);
  EXPECT_EQ(surface.position[4], surface.position[0]);
  EXPECT_EQ(surface.position[5], surface.position[2]);
  EXPECT_EQ(surface.position[6], surface.position[3]);
  const auto& colour = surface.find(AttributeKind::kColour)->values;
  EXPECT_EQ(std::vector<float>(colour.begin() + 12, colour.end()), (std::vector<float>{1, 0, 0, 0, 0, 1, 1, 1, 1}));
  const auto& normal = surface.find(AttributeKind::kNormal)->values;
  EXPECT_EQ(std::vector<float>(normal.begin() + 9, normal.end()),
            (std::vector<float>{1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0}));
}

TEST(SurfaceObj, RefusesIndicesThatAreNotThere) {
  const ScratchFolder folder;
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\n";
  EXPECT_EQ(complaint_about(folder, ".obj", vertices + "f 1//1 2//1 3//1\n"), "");
  for (const char* face : {"f 1 2 4", "f 0 1 2", "f -4 1 2", "f 1//2 2//1 3//1", "f 1//0 2 3", "f 1 2",
                           "f 1 2 9999999999999999999999", "f 1 2 4294967297", "f a b c", "f /1 /2 /3"})
    EXPECT_NE(complaint_about(folder, ".obj", vertices + face + "\n"), "") << face;
  EXPECT_NE(complaint_about(folder, ".obj", "v 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").find("only some"),
            std::string::npos);
  EXPECT_NE(complaint_about(folder, ".obj", vertices).find("has no triangles"), std::string::npos);
}

const char* const tetrahedron =
    "solid  a name\n"
    "  FACET NORMAL 0 0 -1\n outer loop\n vertex 0 0 0\n vertex 0 1 0\n vertex 1 0 0\n endloop\n endfacet\n"
    "facet normal nan nan nan\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1e0\nendloop\nendfacet\n"
    "endsolid a name\nsolid\n"
    "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex -0 0 1\nvertex 0 1 0\nendloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1\nendloop\nendfacet\n"
    "endsolid\n";

TEST(SurfaceStl, ReadsText) {
  const ScratchFolder folder;
  const Surface surface = read_bytes(folder, ".stl", tetrahedron);
  EXPECT_EQ(surface.position.size(), 4U) << "-0 and 0 are the same place";
  EXPECT_EQ(surface.triangles.size(), 4U);
  EXPECT_NEAR(six_volumes(surface), 1, 1e-12);
  for (const char* end : {"endloop\nendfacet\nendsolid\n", "endfacet\nendsolid\n", "endsolid\n", "vertex 1 1 1\n"})
    EXPECT_NE(complaint_about(folder, ".stl", std::string(tetrahedron) + end), "") << end;
}

// Programs exist that write "solid" into the head of binary files.
TEST(SurfaceStl, TellsBinaryFromTextByContent) {
  const ScratchFolder folder;
  write_surface(folder.file("a.stl"), torus(5, 0));
  std::string bytes = bytes_of(folder.file("a.stl"));
  bytes.replace(0, 9, "solid abc");
  EXPECT_EQ(read_bytes(folder, ".stl", bytes).triangles.size(), 50U);
}

}  // namespace
}  // namespace tinsmith
