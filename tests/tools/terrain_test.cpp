// The generated terrain is what it says: any block by itself, the same for a seed, voids of the promised shapes.

#include "terrain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace tinsmith {
namespace {

constexpr std::array kKinds{TerrainKind::kPlane, TerrainKind::kFlat,    TerrainKind::kCone, TerrainKind::kRidge,
                            TerrainKind::kStep,  TerrainKind::kFractal, TerrainKind::kSea};
constexpr std::array kVoids{VoidKind::kSquare, VoidKind::kDiagonal, VoidKind::kRagged, VoidKind::kChecker,
                            VoidKind::kHoles,  VoidKind::kBridges,  VoidKind::kBorder};

HeightGrid whole(const Terrain& terrain) { return heights_of(terrain, {0, 0, terrain.width, terrain.height}); }

bool same_bits(const HeightGrid& a, const HeightGrid& b) {
  return a.z.size() == b.z.size() && std::memcmp(a.z.data(), b.z.data(), a.z.size() * sizeof(double)) == 0;
}

std::int64_t count_voids(const HeightGrid& grid) {
  return std::count_if(grid.z.begin(), grid.z.end(), [](double z) { return std::isnan(z); });
}

/// Samples where two valid cells meet in this corner only.
int count_pinches(const HeightGrid& grid) {
  int n = 0;
  for (int y = 1; y < grid.rect.height - 1; ++y) {
    for (int x = 1; x < grid.rect.width - 1; ++x) {
      const bool nw = grid.is_valid_cell(x - 1, y - 1);
      const bool ne = grid.is_valid_cell(x, y - 1);
      const bool sw = grid.is_valid_cell(x - 1, y);
      const bool se = grid.is_valid_cell(x, y);
      n += static_cast<int>((nw && se && !ne && !sw) || (ne && sw && !nw && !se));
    }
  }
  return n;
}

TEST(Terrain, AnyBlockEqualsThatPartOfTheWhole) {
  for (const TerrainKind kind : kKinds) {
    const Terrain terrain{.kind = kind, .voids = VoidKind::kRagged, .width = 120, .height = 90};
    const HeightGrid all = whole(terrain);
    const HeightGrid block = heights_of(terrain, {37, 21, 50, 40});
    for (int y = 21; y < 61; ++y) {
      for (int x = 37; x < 87; ++x) {
        ASSERT_EQ(is_void_at(terrain, x, y), !all.is_valid(x, y));
        if (!all.is_valid(x, y)) continue;
        ASSERT_EQ(block.at(x, y), all.at(x, y)) << "kind " << static_cast<int>(kind) << " at " << x << ", " << y;
        ASSERT_EQ(height_at(terrain, x, y), all.at(x, y));
      }
    }
  }
}

TEST(Terrain, FarBlocksOfTheLargestSizeAreTerrainToo) {
  Terrain terrain{.width = 300000, .height = 300000};
  const HeightGrid far = heights_of(terrain, {299900, 299900, 100, 100});
  EXPECT_EQ(count_voids(far), 0);
  const auto [low, high] = std::minmax_element(far.z.begin(), far.z.end());
  EXPECT_GT(*high - *low, 1);
}

TEST(Terrain, OutsideIsVoid) {
  const HeightGrid grid = heights_of({.width = 10, .height = 10}, {-1, 0, 12, 11});
  EXPECT_EQ(count_voids(grid), 12 * 11 - 100);
}

TEST(Terrain, IsTheSameForOneSeedAndAnotherForAnother) {
  for (const TerrainKind kind : {TerrainKind::kFractal, TerrainKind::kSea}) {
    Terrain terrain{.kind = kind, .seed = 5, .width = 600, .height = 300, .cell = 90};
    const HeightGrid first = whole(terrain);
    EXPECT_TRUE(same_bits(first, whole(terrain)));
    terrain.seed = 6;
    EXPECT_FALSE(same_bits(first, whole(terrain)));
  }
}

TEST(Terrain, HeightsLieWithinZeroAndTheAmplitude) {
  for (const TerrainKind kind : kKinds) {
    const HeightGrid grid = whole({.kind = kind, .width = 301, .height = 201, .cell = 90, .amplitude = 1500});
    for (const double z : grid.z) ASSERT_TRUE(z >= 0 && z <= 1500) << z << " in kind " << static_cast<int>(kind);
  }
}

TEST(Terrain, ThePlaneIsExactInSinglePrecision) {
  const HeightGrid grid = whole({.kind = TerrainKind::kPlane, .width = 1025, .height = 700});
  for (int y = 0; y < 699; ++y) {
    for (int x = 0; x < 1024; ++x) {
      ASSERT_EQ(static_cast<double>(static_cast<float>(grid.at(x, y))), grid.at(x, y));
      ASSERT_EQ(grid.at(x, y) + grid.at(x + 1, y + 1), grid.at(x + 1, y) + grid.at(x, y + 1));
    }
  }
  EXPECT_NE(grid.at(0, 0), grid.at(0, 1));
  EXPECT_NE(grid.at(0, 0), grid.at(1, 0));
}

TEST(Terrain, TheConeHasItsApexInTheMiddle) {
  const Terrain terrain{.kind = TerrainKind::kCone, .width = 101, .height = 101, .amplitude = 700};
  EXPECT_EQ(height_at(terrain, 50, 50), 700);
  EXPECT_EQ(height_at(terrain, 0, 0), 0);
}

TEST(Terrain, TheSeaIsMostlyExactlyZeroAndHasIslands) {
  const HeightGrid grid = whole({.kind = TerrainKind::kSea, .width = 1000, .height = 1000, .cell = 90});
  const auto n_sea = std::count(grid.z.begin(), grid.z.end(), 0.0);
  EXPECT_GT(n_sea, 600000);
  EXPECT_LT(n_sea, 990000);
}

TEST(Terrain, TheFractalIsMountainous) {
  const HeightGrid grid = whole({.width = 800, .height = 800, .cell = 60});
  const auto [low, high] = std::minmax_element(grid.z.begin(), grid.z.end());
  EXPECT_GT(*high - *low, 800);
  int n_rough = 0;  // rises more than a metre from sample to sample
  for (int y = 0; y < 800; ++y) {
    for (int x = 0; x < 799; ++x) n_rough += static_cast<int>(std::abs(grid.at(x + 1, y) - grid.at(x, y)) > 1);
  }
  EXPECT_GT(n_rough, 320000);
}

TEST(Voids, EveryKindLeavesSamplesAndTakesSome) {
  for (const VoidKind voids : kVoids) {
    const HeightGrid grid = whole({.kind = TerrainKind::kFlat, .voids = voids, .width = 300, .height = 200});
    EXPECT_GT(count_voids(grid), 300) << static_cast<int>(voids);
    EXPECT_LT(count_voids(grid), 40000) << static_cast<int>(voids);
  }
}

TEST(Voids, DiagonalAndCheckerPinchValidCellsAtCorners) {
  for (const VoidKind voids : {VoidKind::kDiagonal, VoidKind::kChecker}) {
    const HeightGrid grid = whole({.kind = TerrainKind::kFlat, .voids = voids, .width = 129, .height = 129});
    EXPECT_GT(count_pinches(grid), 100) << static_cast<int>(voids);
  }
}

TEST(Voids, BridgesAreOneCellWide) {
  const HeightGrid grid =
      whole({.kind = TerrainKind::kFlat, .voids = VoidKind::kBridges, .width = 100, .height = 100});
  EXPECT_TRUE(grid.is_valid_cell(13, 32));
  EXPECT_FALSE(grid.is_valid_cell(13, 31));
  EXPECT_FALSE(grid.is_valid_cell(13, 33));
}

TEST(Voids, TheBorderTakesTheCornersAndLeavesTheMiddle) {
  const Terrain terrain{.voids = VoidKind::kBorder, .width = 201, .height = 101};
  for (const int x : {0, 200}) {
    for (const int y : {0, 100}) EXPECT_TRUE(is_void_at(terrain, x, y));
  }
  EXPECT_FALSE(is_void_at(terrain, 100, 50));
}

TEST(Names, OfKindsAreKnownAndOthersAreNot) {
  EXPECT_EQ(terrain_kind("sea"), TerrainKind::kSea);
  EXPECT_EQ(void_kind("ragged"), VoidKind::kRagged);
  EXPECT_FALSE(terrain_kind("Sea"));
  EXPECT_FALSE(void_kind(""));
}

}  // namespace
}  // namespace tinsmith
