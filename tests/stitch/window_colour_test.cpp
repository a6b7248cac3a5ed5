#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "stitch/window_task.hpp"
#include "support/colours.hpp"
#include "support/random_grid.hpp"
#include "support/surface_check.hpp"
#include "tile/windows.hpp"

namespace tinsmith {
namespace {

using namespace test;

// The checker, but nothing right of a column.
class DrawnColours : public ColourField {
 public:
  explicit DrawnColours(std::int32_t end) : end_(end) {}
  int n_channels() const override { return 3; }
  ColourGrid read(const GridRect& rect) const override {
    constexpr float kNo = std::numeric_limits<float>::quiet_NaN();
    return colours_of(rect, 3, [&](std::int32_t x, std::int32_t y) {
      return x < end_ ? checker(std::max(x, 0), std::max(y, 0)) : Levels{kNo, kNo, kNo, 0};
    });
  }

 private:
  std::int32_t end_;
};

constexpr std::int32_t kSide = 16;
constexpr WindowOptions kOptions{25, 1, Placement::kOptimal, Effort::kDefault, {20, 1}};

std::vector<Chunk> first_round(const GridField& field, const ColourField* colours) {
  const WindowGrid windows = window_grid(field.width(), field.height(), kSide, 0);
  std::vector<Chunk> chunks;
  for (std::int64_t w = 0; w < windows.count(); ++w)
    chunks.push_back(
        first_chunk(field, windows.samples(w, field.width(), field.height()), kOptions, colours).chunk);
  return chunks;
}

std::vector<Chunk> seam_round(const GridField& field, const std::vector<Chunk>& earlier, int round,
                              const ColourField* colours) {
  const WindowGrid windows = window_grid(field.width(), field.height(), kSide, round);
  std::vector<std::vector<ChunkPart>> parts;
  for (const Chunk& chunk : earlier) parts.push_back(split(chunk, windows));
  std::vector<Chunk> chunks;
  for (std::int64_t w = 0; w < windows.count(); ++w) {
    std::vector<const Chunk*> own;
    for (const auto& of_chunk : parts) {
      for (const ChunkPart& part : of_chunk) {
        if (part.window == w) own.push_back(&part.chunk);
      }
    }
    chunks.push_back(seam_chunk(field, own, kOptions, colours));
  }
  return chunks;
}

// How many places belong to several chunks; fails where they disagree.
int count_shared(const std::vector<Chunk>& chunks) {
  std::map<LatticePoint, std::pair<double, Levels>> known;
  std::set<LatticePoint> shared;
  for (const Chunk& chunk : chunks) {
    EXPECT_EQ(chunk.colour.size(), chunk.position.size());
    for (std::size_t v = 0; v < chunk.position.size(); ++v) {
      const std::pair here(chunk.height[v], chunk.colour[v]);
      const auto [entry, is_new] = known.emplace(chunk.position[v], here);
      if (is_new) continue;
      shared.insert(chunk.position[v]);
      EXPECT_EQ(entry->second, here) << chunk.position[v].x << ", " << chunk.position[v].y;
    }
  }
  return static_cast<int>(shared.size());
}

Chunk whole(const std::vector<Chunk>& chunks) {
  std::vector<const Chunk*> parts;
  for (const Chunk& chunk : chunks) parts.push_back(&chunk);
  return weld(parts);
}

TEST(WindowColour, IsTheSameOnBothSidesOfEverySeamAndTheHeightsHold) {
  const DrawnColours colours(1000);
  int n_shared = 0;
  for (const Mask mask : kMasks) {
    SCOPED_TRACE(name_of(mask));
    const GridField field(mountains(70, 52, 421, mask));
    std::vector<Chunk> chunks = first_round(field, &colours);
    n_shared += count_shared(chunks);
    for (int round = 1; round < kRounds; ++round) {
      chunks = seam_round(field, chunks, round, &colours);
      n_shared += count_shared(chunks);
    }
    const Chunk surface = whole(chunks);
    SurfaceCheck check = check_surface(surface, field.grid());
    check.non_manifold_vertices = 0;  // pinches are one vertex again
    EXPECT_EQ(complaints(check, 25), "");
    EXPECT_LT(colour_rmse(soup_of(surface), surface.colour, colours.read(field.grid().rect)), 20);
  }
  EXPECT_GT(n_shared, 2000);
}

TEST(WindowColour, IsWhiteWhereTheFieldHasNone) {
  const DrawnColours colours(0);
  const GridField field(mountains(40, 33, 422, Mask::kNone));
  const Chunk surface = whole(seam_round(field, first_round(field, &colours), 1, &colours));
  ASSERT_FALSE(surface.colour.empty());
  for (const Levels& colour : surface.colour) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colour[c], 255, 0.01);
  }
}

TEST(WindowColour, IsNoneWithoutAField) {
  const GridField field(mountains(40, 33, 423, Mask::kNone));
  EXPECT_TRUE(whole(first_round(field, nullptr)).colour.empty());
}

}  // namespace
}  // namespace tinsmith
