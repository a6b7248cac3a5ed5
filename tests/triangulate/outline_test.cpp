#include "triangulate/outline.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <tuple>

#include "support/random_grid.hpp"

namespace tinsmith {
namespace {

using namespace test;

using UnitEdge = std::tuple<std::int32_t, std::int32_t, bool>;  // from sample (x, y), along the row or the column

std::set<UnitEdge> unit_edges(const std::vector<OutlinePiece>& pieces, std::size_t& n_repeated) {
  std::set<UnitEdge> edges;
  for (const auto& [a, b] : pieces) {
    EXPECT_TRUE((a.x == b.x) != (a.y == b.y));
    const bool is_row = a.y == b.y;
    EXPECT_LT(is_row ? a.x : a.y, is_row ? b.x : b.y);
    for (std::int32_t i = 0; i < (is_row ? b.x - a.x : b.y - a.y); ++i) {
      const bool is_new = edges.insert({is_row ? a.x + i : a.x, is_row ? a.y : a.y + i, is_row}).second;
      n_repeated += is_new ? 0 : 1;
    }
  }
  return edges;
}

// Unit edges with a valid cell of the window on one side only.
std::set<UnitEdge> expected_edges(const HeightGrid& grid, const GridRect& w) {
  const auto is_cell = [&](std::int32_t x, std::int32_t y) {
    return x >= w.x0 && y >= w.y0 && x < w.x0 + w.width - 1 && y < w.y0 + w.height - 1 && grid.is_valid_cell(x, y);
  };
  std::set<UnitEdge> edges;
  for (std::int32_t y = w.y0; y < w.y0 + w.height; ++y) {
    for (std::int32_t x = w.x0; x < w.x0 + w.width; ++x) {
      if (is_cell(x, y) != is_cell(x, y - 1)) edges.insert({x, y, true});
      if (is_cell(x, y) != is_cell(x - 1, y)) edges.insert({x, y, false});
    }
  }
  return edges;
}

TEST(Outline, IsExactlyTheRimOfTheValidCells) {
  std::size_t n_inner = 0;
  for (const Mask mask : kMasks) {
    for (std::uint64_t seed = 141; seed < 151; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", voids " << name_of(mask));
      const HeightGrid grid = mountains(30, 26, seed, mask);
      for (const GridRect window : {grid.rect, GridRect{8, 0, 9, 17}, GridRect{5, 9, 2, 3}}) {
        std::size_t n_repeated = 0;
        const auto found = unit_edges(outline_of(around(grid, window), window), n_repeated);
        EXPECT_EQ(found, expected_edges(grid, window));
        EXPECT_EQ(n_repeated, 0U);
        n_inner += found.size();
      }
    }
  }
  EXPECT_GT(n_inner, 10'000U);
}

TEST(Outline, OfAFullWindowIsItsFourSides) {
  const HeightGrid grid = mountains(20, 20, 152);
  EXPECT_EQ(outline_of(grid, grid.rect).size(), 4U);
  EXPECT_TRUE(is_full(grid, grid.rect));
  EXPECT_FALSE(is_full(grid, {0, 0, 21, 20}));
}

// A seam's pieces are the same from both sides, wherever a void begins on either side.
TEST(Outline, CutsASeamAtTheSamePlacesFromBothSides) {
  std::size_t n_pieces = 0;
  for (const Mask mask : kMasks) {
    for (std::uint64_t seed = 161; seed < 171; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", voids " << name_of(mask));
      const HeightGrid grid = mountains(33, 29, seed, mask);
      const auto on_seam = [&](const GridRect& window) {
        std::set<std::pair<LatticePoint, LatticePoint>> pieces;
        for (const auto& [a, b] : outline_of(around(grid, window), window)) {
          const bool is_seam = a.x == 16 && b.x == 16 && grid.is_valid_cell(15, a.y) && grid.is_valid_cell(16, a.y);
          if (is_seam) pieces.insert({a, b});
        }
        return pieces;
      };
      const auto pieces = on_seam({0, 0, 17, 29});
      EXPECT_EQ(pieces, on_seam({16, 0, 17, 29}));
      n_pieces += pieces.size();
    }
  }
  EXPECT_GT(n_pieces, 100U);
}

}  // namespace
}  // namespace tinsmith
