// The dependencies between windows, against chunks as they really come about.

#include "tile/window_graph.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace tinsmith {
namespace {

struct Size {
  std::int32_t width;
  std::int32_t height;
  std::int32_t side;
};

constexpr std::array kSizes{Size{100, 70, 16}, Size{65, 65, 64}, Size{7, 300, 5}, Size{129, 129, 64},
                            Size{33, 33, 4},   Size{2, 40, 4},   Size{90, 31, 9}};

bool has(const WindowSpan& span, std::int64_t window) {
  bool found = false;
  span.for_each([&](std::int64_t w) { found = found || w == window; });
  return found;
}

TEST(WindowGraph, NamesReadersAndInputsOfEachOtherAlike) {
  for (const auto& [width, height, side] : kSizes) {
    const WindowGraph graph(width, height, side);
    for (int round = 1; round < graph.n_rounds(); ++round) {
      for (std::int64_t w = 0; w < graph.windows(round).count(); ++w) {
        for (std::int64_t v = 0; v < graph.windows(round - 1).count(); ++v)
          ASSERT_EQ(has(graph.inputs({round, w}), v), has(graph.readers({round - 1, v}), w)) << round;
      }
    }
    EXPECT_EQ(graph.inputs({0, 0}).count(), 0);
    EXPECT_EQ(graph.readers({graph.last_round(), 0}).count(), 0);
  }
}

// The worst that can happen: what a chunk of each round covers, as the cells of all windows that fed it.
TEST(WindowGraph, KnowsAllWindowsThatATriangleCanComeFrom) {
  std::mt19937 random(5);
  for (const auto& [width, height, side] : kSizes) {
    const WindowGraph graph(width, height, side);
    if (graph.n_rounds() == 1) continue;
    std::vector<GridRect> reach;
    for (std::int64_t w = 0; w < graph.windows(0).count(); ++w) reach.push_back(graph.samples({0, w}));
    for (int round = 1; round < graph.n_rounds(); ++round) {
      std::vector<std::set<std::int64_t>> inputs(static_cast<std::size_t>(graph.windows(round).count()));
      for (std::size_t v = 0; v < reach.size(); ++v) {
        for (int i = 0; i < 200 && reach[v].width > 0; ++i) {  // triangles anywhere in what the chunk covers
          const auto point = [&] {
            const auto within = [&](std::int32_t low, std::int32_t n) {
              return low * kLatticePerCell +
                     std::uniform_int_distribution<std::int32_t>(0, (n - 1) * kLatticePerCell)(random);
            };
            return LatticePoint{within(reach[v].x0, reach[v].width), within(reach[v].y0, reach[v].height)};
          };
          const LatticePoint a = point(), b = point(), c = point();
          if (orient(a, b, c) != 0)
            inputs[static_cast<std::size_t>(graph.windows(round).window_of(a, b, c))].insert(
                static_cast<std::int64_t>(v));
        }
      }
      std::vector<GridRect> next;
      for (std::size_t w = 0; w < inputs.size(); ++w) {
        std::int32_t x0 = width, y0 = height, x1 = 0, y1 = 0;
        for (const std::int64_t v : inputs[w]) {
          ASSERT_TRUE(has(graph.inputs({round, static_cast<std::int64_t>(w)}), v)) << round << ' ' << w << ' ' << v;
          const GridRect& r = reach[static_cast<std::size_t>(v)];
          x0 = std::min(x0, r.x0), y0 = std::min(y0, r.y0);
          x1 = std::max(x1, r.x0 + r.width), y1 = std::max(y1, r.y0 + r.height);
        }
        const bool is_empty = x0 >= x1;  // a sliver at the field's rim that no triangle hit
        next.push_back(is_empty ? GridRect{} : GridRect{x0, y0, x1 - x0, y1 - y0});
        if (!is_empty && round == graph.last_round()) {
          EXPECT_LE(graph.first_row_reached(static_cast<std::int64_t>(w) / graph.windows(round).columns), y0);
        }
      }
      reach = next;
    }
  }
}

TEST(WindowGraph, CountsBeyond32Bits) {
  const WindowGraph graph(300'000, 300'000, 4);
  EXPECT_GT(graph.windows(0).count(), std::int64_t{1} << 32);
  const std::int64_t last = graph.windows(1).count() - 1;
  EXPECT_EQ(graph.inputs({1, last}).columns, 75'000);
  EXPECT_TRUE(has(graph.inputs({1, last}), graph.windows(0).count() - 1));
}

}  // namespace
}  // namespace tinsmith
