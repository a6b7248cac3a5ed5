#include "stitch/window_task.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "support/random_grid.hpp"
#include "support/surface_check.hpp"
#include "tile/windows.hpp"

namespace tinsmith {
namespace {

using namespace test;

// The chunks of round 0 of a field.
std::vector<FirstChunk> first_round(const GridField& field, std::int32_t side, double tolerance) {
  const WindowGrid windows = window_grid(field.width(), field.height(), side, 0);
  std::vector<FirstChunk> chunks;
  for (std::int64_t w = 0; w < windows.count(); ++w)
    chunks.push_back(first_chunk(field, windows.samples(w, field.width(), field.height()), {tolerance, 1, {}}));
  return chunks;
}

std::vector<const Chunk*> pointers_to(const std::vector<FirstChunk>& chunks) {
  std::vector<const Chunk*> pointers;
  for (const FirstChunk& chunk : chunks) pointers.push_back(&chunk.chunk);
  return pointers;
}

TEST(FirstChunk, IsACertifiedSurfaceOfItsWindow) {
  std::uint64_t n_windows = 0;
  for (const Mask mask : kMasks) {
    const GridField field(mountains(50, 39, 201, mask));
    const WindowGrid windows = window_grid(50, 39, 16, 0);
    for (std::int64_t w = 0; w < windows.count(); ++w) {
      SCOPED_TRACE(testing::Message() << name_of(mask) << ", window " << w);
      const GridRect rect = windows.samples(w, 50, 39);
      const FirstChunk first = first_chunk(field, rect, {25, 1, {}});
      const SurfaceCheck check = check_surface(first.chunk, field.grid(), rect);
      // Vertices that pinch within a chunk are there for each fan.
      EXPECT_EQ(complaints(check, 25), "");
      EXPECT_EQ(first.valid_cells, check.cells);
      EXPECT_LE(first.chunk.triangles.size(), first.start_triangles);
      n_windows += check.cells > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(n_windows, 60U);
}

TEST(FirstChunk, CountsEverySampleAndCellOnceOverAllWindows) {
  for (const Mask mask : kMasks) {
    const GridField field(mountains(47, 34, 202, mask));
    std::uint64_t n_samples = 0;
    std::uint64_t n_cells = 0;
    for (const FirstChunk& chunk : first_round(field, 8, 25)) {
      n_samples += chunk.samples;
      n_cells += chunk.valid_cells;
    }
    const SurfaceCheck check = check_surface(Chunk{}, field.grid());
    EXPECT_EQ(n_cells, check.cells) << name_of(mask);
    const auto& z = field.grid().z;
    EXPECT_EQ(n_samples, static_cast<std::uint64_t>(
                             std::count_if(z.begin(), z.end(), [](double h) { return !std::isnan(h); })))
        << name_of(mask);
  }
}

TEST(FirstChunk, CountsSamplesOfWindowsWithoutACellToo) {
  const GridField stripes(grid_of(17, 17, [](int x, int) { return x % 2 == 0 ? 1.0 : kVoid; }));
  std::uint64_t n_samples = 0;
  for (const FirstChunk& chunk : first_round(stripes, 8, 1)) n_samples += chunk.samples;
  EXPECT_EQ(n_samples, 9U * 17);
}

TEST(FirstChunk, LeavesTheSeamAsItsNeighbourHasIt) {
  const GridField field(mountains(33, 33, 203));
  const std::vector<FirstChunk> chunks = first_round(field, 16, 5);
  ASSERT_EQ(chunks.size(), 4U);
  const auto on_seam = [](const Chunk& chunk) {
    std::set<std::pair<LatticePoint, double>> found;
    for (std::size_t v = 0; v < chunk.position.size(); ++v) {
      if (chunk.position[v].x != 256) continue;
      found.insert({chunk.position[v], chunk.height[v]});
      EXPECT_FALSE(chunk.is_settled[v]);
    }
    return found;
  };
  EXPECT_GT(on_seam(chunks[0].chunk).size(), 4U);
  EXPECT_EQ(on_seam(chunks[0].chunk), on_seam(chunks[1].chunk));
  EXPECT_EQ(on_seam(chunks[2].chunk), on_seam(chunks[3].chunk));
}

TEST(SeamChunk, DissolvesTheSeamsOfTheEarlierRound) {
  const GridField field(mountains(129, 129, 204));
  const std::vector<FirstChunk> chunks = first_round(field, 32, 10);
  const Chunk before = weld(pointers_to(chunks));
  const Chunk after = seam_chunk(field, pointers_to(chunks), {10, 1, {}});
  EXPECT_EQ(complaints(check_surface(after, field.grid()), 10), "");
  EXPECT_LT(after.triangles.size(), before.triangles.size() * 9 / 10);
  const auto one_window = first_chunk(field, field.grid().rect, {10, 1, {}}).chunk.triangles.size();
  EXPECT_GT(one_window, 1'000U);
  EXPECT_LE(after.triangles.size(), one_window * 21 / 20);
}

// Beyond the part that a window owns lie triangles of others: their common vertices stay.
TEST(SeamChunk, LeavesTheBorderToOtherWindowsAsItIs) {
  const GridField field(mountains(65, 65, 205, Mask::kSparse));
  const std::vector<FirstChunk> chunks = first_round(field, 16, 30);
  const Chunk whole = weld(pointers_to(chunks));
  std::vector<Chunk> results;
  for (const ChunkPart& part : split(whole, window_grid(65, 65, 16, 1)))
    results.push_back(seam_chunk(field, {&part.chunk}, {30, 1, {}}));
  std::vector<const Chunk*> pointers;
  for (const Chunk& chunk : results) pointers.push_back(&chunk);
  const Chunk together = weld(pointers);
  const SurfaceCheck check = check_surface(together, field.grid());
  EXPECT_EQ(check.stray_border_edges, 0U);
  EXPECT_EQ(check.area2, check.cells_area2);
  EXPECT_EQ(check.uncovered + check.overlapped + check.over_void + check.folded, 0U);
  EXPECT_LE(check.max_error, 30);
  EXPECT_LT(together.triangles.size(), whole.triangles.size() * 19 / 20);
}

TEST(SeamChunk, OfNothingIsNothing) {
  const GridField field(mountains(9, 9, 206));
  EXPECT_TRUE(seam_chunk(field, {}, {1, 1, {}}).is_empty());
  const Chunk empty;
  EXPECT_TRUE(seam_chunk(field, {&empty}, {1, 1, {}}).is_empty());
}

}  // namespace
}  // namespace tinsmith
