#include "mesh/terrain_mesh.hpp"

#include <gtest/gtest.h>

namespace tinsmith {
namespace {

/// A strip of so many triangles that goes up and down.
TerrainMesh strip(std::uint32_t n_triangles) {
  TerrainMesh mesh;
  for (std::uint32_t v = 0; v < n_triangles + 2; ++v) {
    mesh.position.push_back({static_cast<std::int32_t>(v) - 7, static_cast<std::int32_t>(v % 2) * 3 - 1});
    mesh.height.push_back(v % 5 - 2.5);
  }
  for (std::uint32_t t = 0; t < n_triangles; ++t) mesh.triangles.push_back({t, t + 1 + t % 2, t + 2 - t % 2});
  return mesh;
}

TEST(MeshSurface, BringsTheMeshInOrderAndTwiceAlike) {
  for (const std::uint32_t n_triangles : {1U, 4094U, 4096U, 10000U}) {
    const TerrainMesh mesh = strip(n_triangles);
    const MeshSurface surface(mesh);
    for (int pass = 0; pass < 2; ++pass) {
      std::size_t v = 0;
      surface.for_each_vertex_block([&](TerrainSurface::VertexBlock block) {
        ASSERT_FALSE(block.empty());
        ASSERT_LE(block.size(), 4096U);
        for (const TerrainVertex& vertex : block) {
          ASSERT_EQ(vertex.position, mesh.position[v]);
          ASSERT_EQ(vertex.height, mesh.height[v++]);
        }
      });
      EXPECT_EQ(v, mesh.position.size());
      std::size_t t = 0;
      surface.for_each_triangle_block([&](TerrainSurface::TriangleBlock block) {
        ASSERT_FALSE(block.empty());
        ASSERT_LE(block.size(), 4096U);
        for (const auto& triangle : block) {
          for (std::size_t k = 0; k < 3; ++k) ASSERT_EQ(triangle[k], mesh.triangles[t][k]);
          ++t;
        }
      });
      EXPECT_EQ(t, mesh.triangles.size());
    }
  }
}

TEST(MeshSurface, KnowsTheExactExtent) {
  const TerrainMesh mesh = strip(100);
  const MeshSurface surface(mesh);
  EXPECT_EQ(surface.extent().n_vertices, 102U);
  EXPECT_EQ(surface.extent().n_triangles, 100U);
  EXPECT_EQ(surface.extent().low, (LatticePoint{-7, -1}));
  EXPECT_EQ(surface.extent().high, (LatticePoint{94, 2}));
  EXPECT_EQ(surface.extent().lowest, -2.5);
  EXPECT_EQ(surface.extent().highest, 1.5);
}

TEST(MeshSurface, OfNothingBringsNothing) {
  const TerrainMesh mesh;
  const MeshSurface surface(mesh);
  EXPECT_EQ(surface.extent().n_vertices, 0U);
  EXPECT_EQ(surface.extent().n_triangles, 0U);
  surface.for_each_vertex_block([](TerrainSurface::VertexBlock) { FAIL(); });
  surface.for_each_triangle_block([](TerrainSurface::TriangleBlock) { FAIL(); });
}

}  // namespace
}  // namespace tinsmith
