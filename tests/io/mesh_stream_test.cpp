// Meshes that go through files block by block.

#include <fmt/format.h>

#include <cmath>
#include <fstream>

#include "io/mesh_cases.hpp"
#include "io/mesh_file.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::array kExtensions{".ply", ".obj", ".glb", ".2dm"};

/// Squares of two triangles in rows, made when they are asked for.
class PlaneSurface : public TerrainSurface {
 public:
  explicit PlaneSurface(std::int32_t side) : side_(side) {
    const auto n = static_cast<std::uint64_t>(side);
    extent_ = {(n + 1) * (n + 1), 2 * n * n, {0, 0}, {16 * side, 16 * side}, 0, static_cast<double>(side)};
  }
  const TerrainExtent& extent() const override { return extent_; }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const override {
    std::vector<TerrainVertex> row;
    for (std::int32_t j = 0; j <= side_; ++j) {
      row.clear();
      for (std::int32_t i = 0; i <= side_; ++i) row.push_back({{16 * i, 16 * j}, static_cast<double>(j)});
      visit(row);
    }
  }
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const override {
    std::vector<std::array<std::uint64_t, 3>> row;
    const auto n = static_cast<std::uint64_t>(side_);
    for (std::uint64_t j = 0; j < n; ++j) {
      row.clear();
      for (std::uint64_t at = j * (n + 1); at < j * (n + 1) + n; ++at) {
        row.push_back({at, at + 1, at + n + 2});
        row.push_back({at, at + n + 2, at + n + 1});
      }
      visit(row);
    }
  }

 private:
  std::int32_t side_;
  TerrainExtent extent_;
};

/// A mesh that says it has more vertices and triangles than it brings.
class ClaimingSurface : public TerrainSurface {
 public:
  ClaimingSurface(const TerrainMesh& mesh, std::uint64_t n_vertices, std::uint64_t n_triangles) : mesh_(mesh) {
    extent_ = mesh_.extent();
    extent_.n_vertices = n_vertices;
    extent_.n_triangles = n_triangles;
  }
  const TerrainExtent& extent() const override { return extent_; }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const override {
    mesh_.for_each_vertex_block(visit);
  }
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const override {
    mesh_.for_each_triangle_block(visit);
  }

 private:
  MeshSurface mesh_;
  TerrainExtent extent_;
};

/// The peak of this process's memory, in kB; begun anew by forget_peak().
std::size_t peak() {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;)
    if (word == "VmHWM:") {
      std::size_t kilobytes = 0;
      status >> kilobytes;
      return kilobytes;
    }
  return 0;
}

void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

TEST(MeshStream, BringsAllVerticesThenAllTriangles) {
  const ScratchFolder folder;
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    write_mesh(path, PlaneSurface(100), frames()[0]);
    const Tin expected = read_mesh(path);
    Tin tin;
    std::array<std::uint64_t, 2> counts{};
    MeshVisitor visitor;
    visitor.counts = [&](std::uint64_t n_vertices, std::uint64_t n_triangles) {
      counts = {n_vertices, n_triangles};
    };
    visitor.vertices = [&](std::span<const std::array<double, 3>> block) {
      ASSERT_TRUE(tin.triangles.empty()) << extension;
      ASSERT_LE(block.size(), 4096U);
      tin.vertices.insert(tin.vertices.end(), block.begin(), block.end());
    };
    visitor.triangles = [&](std::span<const std::array<std::uint64_t, 3>> block) {
      ASSERT_LE(block.size(), 4096U);
      for (const auto& [a, b, c] : block)
        tin.triangles.push_back(
            {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
    };
    EXPECT_EQ(visit_mesh(path, visitor), expected.crs_wkt);
    EXPECT_EQ(counts, (std::array<std::uint64_t, 2>{101 * 101, 20000})) << extension;
    EXPECT_EQ(tin.vertices, expected.vertices) << extension;
    EXPECT_EQ(tin.triangles, expected.triangles) << extension;
  }
}

// Sanitizers keep what was freed.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(MeshStream, NeedsAFewMegabytesForAnyMesh) {
  const ScratchFolder folder;
  const PlaneSurface surface(700);  // 980 000 triangles: 24 MB as a Tin
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    forget_peak();
    const std::size_t before = peak();
    std::uint64_t n_triangles = 0;
    write_mesh(path, surface, GridFrame{});
    visit_mesh(path, {[](auto) {}, [&](auto block) { n_triangles += block.size(); }});
    EXPECT_EQ(n_triangles, surface.extent().n_triangles);
    EXPECT_LT(peak() - before, 6000U) << extension;
  }
}
#endif

TEST(MeshStream, WritesASurfaceAsTheMeshInMemory) {
  const PlaneSurface plane(70);
  TerrainMesh mesh;
  plane.for_each_vertex_block([&](TerrainSurface::VertexBlock block) {
    for (const TerrainVertex& vertex : block) {
      mesh.position.push_back(vertex.position);
      mesh.height.push_back(vertex.height);
    }
  });
  plane.for_each_triangle_block([&](TerrainSurface::TriangleBlock block) {
    for (const auto& [a, b, c] : block)
      mesh.triangles.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  });
  for (const GridFrame& frame : frames())
    for (const std::string extension : kExtensions) {
      const ScratchFolder folder;  // its own, for the .prj
      write_mesh(folder.file("surface" + extension), plane, frame);
      write_mesh(folder.file("mesh" + extension), mesh, frame);
      EXPECT_TRUE(bytes_of(folder.file("surface" + extension)) == bytes_of(folder.file("mesh" + extension)))
          << extension;
    }
}

TEST(MeshStream, ReadsTextInAnyOrder) {
  const ScratchFolder folder;
  put_bytes(folder.file("a.obj"), "f 1 2 3\nv 0 0 1\n# words\nv 1 0 2\nf 1 3 4\n\nv 1 1 3\nv 0 1 4\n");
  put_bytes(folder.file("a.2dm"),
            "MESH2D\nND 1 0 0 1\nE3T 1 1 2 3 1\nND 2 1 0 2\nE3T 2 1 3 4 7\nND 3 1 1 3\nND 4 0 1 4\n");
  for (const char* name : {"a.obj", "a.2dm"}) {
    const Tin tin = read_mesh(folder.file(name));
    EXPECT_EQ(tin.vertices, (std::vector<std::array<double, 3>>{{0, 0, 1}, {1, 0, 2}, {1, 1, 3}, {0, 1, 4}}))
        << name;
    EXPECT_EQ(tin.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}, {0, 2, 3}})) << name;
  }
}

TEST(MeshStream, RefusesCornersOutOfRange) {
  const ScratchFolder folder;
  for (const char* corner : {"0", "4", "-1", "4294967297", "18446744073709551615", "18446744073709551616", "1.5"}) {
    put_bytes(folder.file("a.obj"), fmt::format("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 {}\n", corner));
    EXPECT_THROW(read_mesh(folder.file("a.obj")), InputError) << corner;
  }
}

/// The PLY of a mesh that claims this many vertices, with the true number put back.
std::string ply_as_of(const ScratchFolder& folder, const TerrainMesh& mesh, std::uint64_t n_vertices) {
  write_mesh(folder.file("a.ply"), ClaimingSurface(mesh, n_vertices, mesh.triangles.size()), frames()[0]);
  std::string bytes = bytes_of(folder.file("a.ply"));
  const std::string claim = fmt::format("element vertex {}\n", n_vertices);
  return bytes.replace(bytes.find(claim), claim.size(), fmt::format("element vertex {}\n", mesh.position.size()));
}

TEST(MeshStream, PlyHasIndicesForAnyNumberOfVertices) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(1, 3, 3);
  write_mesh(folder.file("a.ply"), mesh, frames()[0]);
  const Tin expected = read_mesh(folder.file("a.ply"));
  const auto expect = [&](std::uint64_t n_vertices, const std::string& index) {
    const std::string bytes = ply_as_of(folder, mesh, n_vertices);
    EXPECT_NE(bytes.find("property list uchar " + index + " vertex_indices\n"), std::string::npos) << index;
    put_bytes(folder.file("a.ply"), bytes);
    EXPECT_EQ(read_mesh(folder.file("a.ply")).triangles, expected.triangles) << index;
  };
  expect(std::uint64_t{1} << 31, "int");
  expect((std::uint64_t{1} << 31) + 1, "uint");
  expect(std::uint64_t{1} << 32, "uint");
  expect((std::uint64_t{1} << 32) + 1, "double");
}

TEST(MeshStream, RefusesPlyIndicesThatAreNoWholeNumbers) {
  const ScratchFolder folder;
  const std::string bytes = ply_as_of(folder, random_mesh(1, 1, 1), std::uint64_t{1} << 33);
  for (const double index : {-1.0, 0.5, 4.0, 1e300, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    std::string damaged = bytes;
    damaged.replace(damaged.size() - sizeof index, sizeof index, reinterpret_cast<const char*>(&index),
                    sizeof index);
    put_bytes(folder.file("a.ply"), damaged);
    EXPECT_THROW(read_mesh(folder.file("a.ply")), InputError) << index;
  }
}

TEST(MeshStream, RefusesWhatGlbCannotHoldBeforeAByteIsWritten) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(1, 3, 3);
  constexpr std::uint64_t kMany = std::uint64_t{1} << 63;
  // 12 bytes for a vertex and 12 for a triangle.
  for (const auto& [n_vertices, n_triangles] :
       {std::pair<std::uint64_t, std::uint64_t>{120000000, 240000000}, {kMany, 1}, {1, kMany}, {kMany, kMany}}) {
    try {
      write_mesh(folder.file("a.glb"), ClaimingSurface(mesh, n_vertices, n_triangles), frames()[0]);
      FAIL() << "written";
    } catch (const ResourceError& error) {
      EXPECT_NE(std::string(error.what()).find("write .ply instead"), std::string::npos) << error.what();
    }
    EXPECT_EQ(folder.n_files(), 0U);
    EXPECT_THROW(require_format_holds("a.glb", n_vertices, n_triangles), ResourceError);
    for (const char* path : {"a.ply", "a.obj", "a.2dm"})
      EXPECT_NO_THROW(require_format_holds(path, n_vertices, n_triangles)) << path;
  }
  EXPECT_NO_THROW(require_format_holds("a.GLB", 119000000, 238000000));
  EXPECT_NO_THROW(require_format_holds("a.glb", 0, 0));
}

}  // namespace
}  // namespace tinsmith
