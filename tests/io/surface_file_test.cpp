// What holds for all formats of surfaces.

#include <array>
#include <random>

#include "io/surface_cases.hpp"

namespace tinsmith {
namespace {

constexpr std::array kExtensions{".ply", ".obj", ".stl", ".glb"};

std::string written(const ScratchFolder& folder, const std::string& extension, const Surface& surface) {
  write_surface(folder.file("a" + extension), surface);
  return bytes_of(folder.file("a" + extension));
}

Surface reread(const ScratchFolder& folder, const std::string& extension, const Surface& surface) {
  return read_bytes(folder, extension, written(folder, extension, surface));
}

double farthest(const Surface& a, const Surface& b) {
  double distance = 0;
  for (std::size_t v = 0; v < a.position.size(); ++v)
    for (std::size_t k = 0; k < 3; ++k)
      distance = std::max(distance, std::abs(a.position[v][k] - b.position[v][k]));
  return distance;
}

TEST(SurfaceFile, PlyReadsBackExactly) {
  const ScratchFolder folder;
  const Surface surface = torus(40, 4e6 / 7);
  const Surface read = reread(folder, ".ply", surface);
  EXPECT_EQ(read.position, surface.position);
  EXPECT_EQ(read.triangles, surface.triangles);
  ASSERT_EQ(read.attributes.size(), 3U);
  for (std::size_t a = 0; a < 3; ++a) {
    EXPECT_EQ(read.attributes[a].kind, surface.attributes[a].kind);
    EXPECT_EQ(read.attributes[a].name, surface.attributes[a].name);
    EXPECT_EQ(read.attributes[a].values, surface.attributes[a].values) << a;
  }
}

TEST(SurfaceFile, ObjReadsBackExactly) {
  const ScratchFolder folder;
  const Surface surface = torus(40, 4e6 / 7);
  const Surface read = reread(folder, ".obj", surface);
  EXPECT_EQ(read.position, surface.position);
  EXPECT_EQ(read.triangles, surface.triangles);
  ASSERT_EQ(read.attributes.size(), 2U) << "OBJ holds no scalars";
  EXPECT_EQ(read.find(AttributeKind::kColour)->values, surface.attributes[0].values);
  EXPECT_EQ(read.find(AttributeKind::kNormal)->values, surface.attributes[1].values);
}

TEST(SurfaceFile, GlbReadsBackWithinFloat32OfItsSize) {
  const ScratchFolder folder;
  const Surface surface = torus(40, 4e6 / 7);
  const Surface read = reread(folder, ".glb", surface);
  EXPECT_LE(farthest(read, surface), 4 * 0x1p-24) << "half a step of float32 over half the box, not over 4e6";
  EXPECT_EQ(read.triangles, surface.triangles);
  EXPECT_EQ(read.find(AttributeKind::kColour)->values, surface.attributes[0].values);
  EXPECT_EQ(read.find(AttributeKind::kNormal)->values, surface.attributes[1].values);
  const Surface of_floats = reread(folder, ".stl", torus(9, 3));
  EXPECT_EQ(reread(folder, ".glb", of_floats).position, of_floats.position) << "what came from float32 stays";
}

TEST(SurfaceFile, GlbHoldsMoreVerticesThanAShortCounts) {
  const ScratchFolder folder;
  const Surface surface = torus(257, 1);
  EXPECT_GT(surface.position.size(), 65536U);
  EXPECT_EQ(reread(folder, ".glb", surface).triangles, surface.triangles);
}

TEST(SurfaceFile, StlReadsBackWeldedWithinFloat32) {
  const ScratchFolder folder;
  const Surface surface = torus(40, 100);
  const Surface read = reread(folder, ".stl", surface);
  EXPECT_EQ(read.position.size(), surface.position.size()) << "corners at the same place are one vertex";
  ASSERT_EQ(read.triangles.size(), surface.triangles.size());
  for (std::size_t t = 0; t < read.triangles.size(); ++t)
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_EQ(read.position[read.triangles[t][corner]][k],
                  static_cast<float>(surface.position[surface.triangles[t][corner]][k]));
  EXPECT_TRUE(read.attributes.empty());
}

TEST(SurfaceFile, KeepsTheOutsideOutside) {
  const ScratchFolder folder;
  const Surface surface = torus(30, 0);
  for (const std::string extension : kExtensions)
    EXPECT_NEAR(six_volumes(reread(folder, extension, surface)), six_volumes(surface), 1e-3) << extension;
}

TEST(SurfaceFile, WritesTheSameBytesAgain) {
  const ScratchFolder folder;
  const Surface surface = torus(12, 5);
  for (const std::string extension : kExtensions) {
    write_surface(folder.file("other" + extension), surface);
    EXPECT_TRUE(written(folder, extension, surface) == bytes_of(folder.file("other" + extension))) << extension;
  }
}

TEST(SurfaceFile, KnowsItsExtensions) {
  const ScratchFolder folder;
  EXPECT_NO_THROW(write_surface(folder.file("a.PLY"), torus(3, 0)));
  EXPECT_NO_THROW(read_surface(folder.file("a.PLY")));
  for (const char* name : {"a", "a.2dm", "a.ply.gz", ".ply"}) {
    EXPECT_THROW(write_surface(folder.file(name), torus(3, 0)), UsageError) << name;
    EXPECT_THROW(read_surface(folder.file(name)), InputError) << name;
  }
  for (const std::string extension : kExtensions) {
    EXPECT_THROW(read_surface(folder.file("missing" + extension)), InputError);
    EXPECT_THROW(write_surface(folder.file("nowhere/a" + extension), torus(3, 0)), OutputError);
  }
}

// All but the last byte of the text formats carries something; binary ones and our OBJ know how long they are.
TEST(SurfaceFile, RefusesEveryTruncation) {
  const ScratchFolder folder;
  for (const std::string extension : kExtensions) {
    const std::string whole = written(folder, extension, torus(3, 7));
    const std::size_t end = extension == ".obj" ? whole.rfind("f ") : whole.size();
    for (std::size_t length = 0; length < end; ++length)
      ASSERT_NE(complaint_about(folder, extension, whole.substr(0, length)), "")
          << extension << " cut at " << length << " of " << whole.size();
    if (extension != ".obj") EXPECT_NE(complaint_about(folder, extension, whole + '\0'), "") << extension;
  }
}

/// Damages the bytes, reads them, and returns how many of the trials were refused.
int n_refused(const ScratchFolder& folder, const std::string& extension, const std::string& whole) {
  std::mt19937_64 random(20240611);
  int refused = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    std::string damaged = whole;
    for (std::uint64_t flips = 1 + random() % 4; flips > 0; --flips)
      damaged[random() % damaged.size()] ^= static_cast<char>(1 << random() % 8);
    if (trial % 5 == 0) damaged.resize(random() % damaged.size());
    if (trial % 7 == 0) damaged.insert(random() % (damaged.size() + 1), std::string(1 + random() % 9, '9'));
    const std::string complaint = complaint_about(folder, extension, damaged);
    EXPECT_EQ(complaint.find('\n'), std::string::npos) << "one line";
    refused += complaint.empty() ? 0 : 1;
  }
  return refused;
}

TEST(SurfaceFile, SurvivesDamage) {
  const ScratchFolder folder;
  for (const std::string extension : kExtensions)
    EXPECT_GT(n_refused(folder, extension, written(folder, extension, torus(3, 7))), 300) << extension;
  const std::string text =
      "ply\nformat ascii 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty double y\nproperty int z\n"
      "property list uchar short more\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1 7\n1.5 0 0 0\n0 1e3 5 2 3 4\n3 0 1 2\n";
  EXPECT_GT(n_refused(folder, ".ply", text), 300);
  EXPECT_GT(n_refused(folder, ".ply", std::string(text).replace(text.find("ascii"), 5, "binary_big_endian")), 300);
  EXPECT_GT(n_refused(folder, ".stl",
                      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                      "endfacet\nendsolid a\n"),
            300);
}

TEST(SurfaceFile, RefusesGarbage) {
  const ScratchFolder folder;
  std::mt19937_64 random(7);
  std::string noise(5000, ' ');
  for (char& c : noise) c = static_cast<char>(random());
  for (const std::string extension : kExtensions)
    for (const std::string& bytes : {std::string(), std::string("\n"), noise, std::string(3 << 20, 'v')})
      EXPECT_NE(complaint_about(folder, extension, bytes), "") << extension;
}

TEST(SurfaceFile, RefusesValuesThatAreNone) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& vertex) {
    return complaint_about(folder, ".obj", "v 0 0 0 0 0 0\n" + vertex + "\nv 0 1 0 1 1 1\nf 1 2 3\n");
  };
  EXPECT_EQ(complaint("v 1 0 0 1 0.5 0"), "");
  EXPECT_NE(complaint("v nan 0 0 1 0.5 0").find("vertex 1 has a coordinate"), std::string::npos);
  EXPECT_NE(complaint("v 1 0 0 1 nan 0").find("vertex 1 has a colour"), std::string::npos);
  EXPECT_NE(complaint("v 1 0 0 1 128 0").find("from 0 to 1"), std::string::npos);
}

TEST(SurfaceFile, MakesNormalsUnitLength) {
  const ScratchFolder folder;
  const Surface read =
      read_bytes(folder, ".obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 5\nvn 0 3 4\nvn 0 0 0\nf 1//1 2//2 3//3\n");
  EXPECT_EQ(read.find(AttributeKind::kNormal)->values, (std::vector<float>{0, 0, 1, 0, 0.6F, 0.8F, 0, 0, 0}));
}

TEST(SurfaceFile, RefusesWhatAFormatCannotHold) {
  const ScratchFolder folder;
  Surface surface = torus(3, 0);
  surface.attributes[2].name = "two words";
  EXPECT_THROW(write_surface(folder.file("a.ply"), surface), ResourceError);
  surface.attributes[2].name = "nx";
  EXPECT_THROW(write_surface(folder.file("a.ply"), surface), ResourceError);
  surface.position[0][0] = 1e39;
  surface.position[1][0] = -1e39;
  EXPECT_THROW(write_surface(folder.file("a.stl"), surface), ResourceError);
  EXPECT_THROW(write_surface(folder.file("a.glb"), surface), ResourceError);
  EXPECT_THROW(write_surface(folder.file("a.glb"), Surface{}), ResourceError);
  EXPECT_EQ(folder.n_files(), 0U);
}

}  // namespace
}  // namespace tinsmith
