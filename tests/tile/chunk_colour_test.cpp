#include <gtest/gtest.h>

#include <utility>

#include "support/colours.hpp"
#include "support/mesh_drawings.hpp"
#include "support/random_grid.hpp"
#include "tile/chunk.hpp"

namespace tinsmith {
namespace {

using namespace test;

TEST(ChunkColour, FollowsItsVertexThroughSplitAndWeld) {
  const HeightGrid grid = mountains(40, 33, 411, Mask::kSparse);
  WindowMesh mesh = full_mesh(grid);
  paint(mesh, colours_of(grid.rect, 3, noise));
  Chunk chunk = chunk_of(std::move(mesh));
  std::vector<const Chunk*> parts;
  const std::vector<ChunkPart> split_parts = split(chunk, window_grid(40, 33, 8, 0));
  for (const ChunkPart& part : split_parts) parts.push_back(&part.chunk);
  ASSERT_GT(parts.size(), 10U);
  const WindowMesh again = mesh_of(weld(parts));
  ASSERT_EQ(again.colour.size(), again.position.size());
  for (std::size_t v = 0; v < again.position.size(); ++v) {
    const LatticePoint p = again.position[v];
    EXPECT_EQ(again.colour[v], noise(p.x / kLatticePerCell, p.y / kLatticePerCell));
  }
}

TEST(ChunkColour, IsNoneWhereTheMeshHasNone) {
  WindowMesh mesh = full_mesh(mountains(9, 9, 412, Mask::kNone));
  const Chunk chunk = chunk_of(std::move(mesh));
  EXPECT_TRUE(chunk.colour.empty());
  EXPECT_TRUE(weld({&chunk}).colour.empty());
}

}  // namespace
}  // namespace tinsmith
