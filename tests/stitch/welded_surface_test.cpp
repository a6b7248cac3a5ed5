// Chunks welded one after the other equal all chunks welded at once.

#include "stitch/welded_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/random_grid.hpp"
#include "support/surface_check.hpp"
#include "triangulate/triangulate.hpp"

namespace tinsmith {
namespace {

using namespace test;

using Corner3 = std::pair<LatticePoint, double>;

// Triangles as places and heights, in an order that does not depend on numbers.
template <class Mesh>
std::vector<std::array<Corner3, 3>> geometry_of(const Mesh& mesh) {
  std::vector<std::array<Corner3, 3>> all;
  for (const auto& triangle : mesh.triangles) {
    std::array<Corner3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(triangle[k]);
      corners[k] = {mesh.position[v], mesh.height[v]};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// The chunks of the last round as they would be without any simplification: the triangles of the whole grid, each
// in the window of its centroid.
std::vector<Chunk> chunks_of(const HeightGrid& grid, const WindowGraph& graph) {
  const Chunk whole = chunk_of(triangulate(around(grid, grid.rect), grid.rect, {20, 1}));
  const WindowGrid& windows = graph.windows(graph.last_round());
  std::vector<Chunk> chunks(static_cast<std::size_t>(windows.count()));
  for (ChunkPart& part : split(whole, windows)) {
    // As after a window task: every vertex of a chunk has one fan.
    chunks[static_cast<std::size_t>(part.window)] = chunk_of(mesh_of(weld({&part.chunk})));
  }
  return chunks;
}

TEST(WeldedSurface, EqualsAllChunksWeldedAtOnce) {
  std::size_t n_pinched = 0;
  for (const Mask mask : kMasks) {
    for (const std::int32_t side : {4, 8, 16}) {
      SCOPED_TRACE(testing::Message() << name_of(mask) << ", side " << side);
      const HeightGrid grid = mountains(61, 47, 31, mask);
      const WindowGraph graph(61, 47, side);
      const std::vector<Chunk> chunks = chunks_of(grid, graph);
      WeldedSurface surface(graph, [&](std::int64_t w) -> std::shared_ptr<const Chunk> {
        const Chunk& chunk = chunks[static_cast<std::size_t>(w)];
        return chunk.is_empty() ? nullptr : std::make_shared<const Chunk>(chunk);
      });
      for (std::size_t w = 0; w < chunks.size(); ++w) surface.add_next();
      const TerrainMesh mesh = mesh_of(surface);
      EXPECT_EQ(mesh.position.size(), surface.extent().n_vertices);
      EXPECT_EQ(mesh.triangles.size(), surface.extent().n_triangles);
      EXPECT_EQ(complaints(check_surface(mesh, grid), 20), "");
      std::vector<const Chunk*> all;
      for (const Chunk& chunk : chunks) all.push_back(&chunk);
      const WindowMesh at_once = mesh_of(weld(all));  // pinched vertices parted
      EXPECT_EQ(mesh.position.size(), at_once.position.size());
      EXPECT_TRUE(geometry_of(mesh) == geometry_of(weld(all)));
      n_pinched +=
          at_once.position.size() - std::set<LatticePoint>(at_once.position.begin(), at_once.position.end()).size();
    }
  }
  EXPECT_GT(n_pinched, 500U);
}

}  // namespace
}  // namespace tinsmith
