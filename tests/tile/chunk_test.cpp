#include "tile/chunk.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>
#include <utility>

#include "support/random_grid.hpp"
#include "support/surface_check.hpp"
#include "triangulate/triangulate.hpp"

namespace tinsmith {
namespace {

using namespace test;

Chunk chunk_from(const HeightGrid& grid, double tolerance) {
  Chunk chunk = chunk_of(triangulate(around(grid, grid.rect), grid.rect, {tolerance, 1}));
  std::mt19937 random(181);
  for (std::uint8_t& is_settled : chunk.is_settled) is_settled = random() % 2;
  return chunk;
}

// A chunk as places and heights alone, in an order that does not depend on numbers: each triangle from its
// smallest corner.
using Corner3 = std::tuple<LatticePoint, double, std::uint8_t>;
std::vector<std::array<Corner3, 3>> geometry_of(const Chunk& chunk) {
  std::vector<std::array<Corner3, 3>> all;
  for (const auto& t : chunk.triangles) {
    std::array<Corner3, 3> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = static_cast<std::size_t>(t[k]);
      corners[k] = {chunk.position[v], chunk.height[v], chunk.is_settled[v]};
    }
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    all.push_back(corners);
  }
  std::sort(all.begin(), all.end());
  return all;
}

// Pinched vertices are one in a chunk that was welded, so a chunk is welded first and compared after.
TEST(Chunk, SplitAndWeldIsTheIdentity) {
  std::size_t n_parts = 0;
  for (const Mask mask : kMasks) {
    for (const std::int32_t side : {4, 16, 64}) {
      const Chunk split_up = chunk_from(mountains(50, 39, 182, mask), 20);
      const Chunk chunk = weld({&split_up});
      for (int round = 0; round < kRounds; ++round) {
        SCOPED_TRACE(testing::Message() << name_of(mask) << ", side " << side << ", round " << round);
        const std::vector<ChunkPart> parts = split(chunk, window_grid(50, 39, side, round));
        std::vector<const Chunk*> pointers;
        for (const ChunkPart& part : parts) pointers.push_back(&part.chunk);
        const Chunk again = weld(pointers);
        EXPECT_TRUE(geometry_of(again) == geometry_of(chunk));
        EXPECT_EQ(again.position, chunk.position);
        EXPECT_EQ(again.height, chunk.height);
        n_parts += parts.size();
      }
    }
  }
  EXPECT_GT(n_parts, 2'000U);
}

TEST(Chunk, EveryTriangleIsInThePartOfItsWindowOnly) {
  const Chunk chunk = chunk_from(mountains(70, 60, 183), 30);
  const WindowGrid windows = window_grid(70, 60, 16, 1);
  const std::vector<ChunkPart> parts = split(chunk, windows);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end(),
                             [](const ChunkPart& a, const ChunkPart& b) { return a.window < b.window; }));
  std::size_t n = 0;
  for (const auto& [window, part] : parts) {
    EXPECT_FALSE(part.is_empty());
    n += part.triangles.size();
    for (const auto& [a, b, c] : part.triangles) {
      const auto p = [&part = part](std::int32_t v) { return part.position[static_cast<std::size_t>(v)]; };
      EXPECT_EQ(windows.window_of(p(a), p(b), p(c)), window);
    }
  }
  EXPECT_EQ(n, chunk.triangles.size());
}

TEST(Chunk, WeldDoesNotDependOnTheOrderOfItsParts) {
  const Chunk pinched = chunk_from(mountains(40, 40, 184, Mask::kDense), 10);
  const Chunk chunk = weld({&pinched});
  const std::vector<ChunkPart> parts = split(chunk, window_grid(40, 40, 8, 0));
  std::vector<const Chunk*> pointers;
  for (const ChunkPart& part : parts) pointers.push_back(&part.chunk);
  const Chunk forwards = weld(pointers);
  std::reverse(pointers.begin(), pointers.end());
  const Chunk backwards = weld(pointers);
  EXPECT_EQ(forwards.position, backwards.position);
  EXPECT_EQ(forwards.height, backwards.height);
  EXPECT_TRUE(geometry_of(forwards) == geometry_of(backwards));
}

TEST(Chunk, OfAMeshHoldsItsLiveTrianglesAndSettlesWhatHasFreeNeighboursOnly) {
  const HeightGrid grid = mountains(33, 33, 185);
  WindowMesh mesh = triangulate(around(grid, grid.rect), grid.rect, {50, 1});
  std::fill(mesh.kind.begin(), mesh.kind.end(), VertexKind::kInterior);
  std::vector<LatticePoint> locked;
  for (std::size_t v = 0; v < mesh.kind.size(); v += 40) {
    mesh.kind[v] = VertexKind::kLocked;
    locked.push_back(mesh.position[v]);
  }
  const std::size_t n_triangles = soup_of(mesh).triangles.size();
  const Chunk chunk = chunk_of(std::move(mesh));
  EXPECT_EQ(soup_of(chunk).triangles.size(), n_triangles);
  EXPECT_EQ(complaints(check_surface(chunk, grid), 50), "");
  const auto is_locked = [&](std::int32_t v) {
    return std::find(locked.begin(), locked.end(), chunk.position[static_cast<std::size_t>(v)]) != locked.end();
  };
  std::vector<std::uint8_t> expected(chunk.position.size(), 1);
  for (const auto& t : chunk.triangles) {
    if (std::none_of(t.begin(), t.end(), is_locked)) continue;
    for (const std::int32_t v : t) expected[static_cast<std::size_t>(v)] = 0;
  }
  EXPECT_GT(std::count(expected.begin(), expected.end(), 1), 10);
  EXPECT_EQ(chunk.is_settled, expected);
}

TEST(Chunk, OfNothingIsEmpty) {
  EXPECT_TRUE(weld({}).is_empty());
  EXPECT_TRUE(split(Chunk{}, window_grid(9, 9, 4, 0)).empty());
  EXPECT_TRUE(chunk_of(WindowMesh{}).is_empty());
}

}  // namespace
}  // namespace tinsmith
