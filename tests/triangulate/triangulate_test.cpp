#include "triangulate/triangulate.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <tuple>

#include "support/random_grid.hpp"
#include "support/surface_check.hpp"

namespace tinsmith {
namespace {

using namespace test;

WindowMesh triangulate_whole(const HeightGrid& grid, double tolerance, double aspect = 1) {
  return triangulate(around(grid, grid.rect), grid.rect, {tolerance, aspect});
}

std::size_t n_triangles(const WindowMesh& mesh) { return mesh.origin.size() / 3; }

TEST(Triangulate, CoversTheValidCellsExactlyWithinTheTolerance) {
  std::uint64_t pinched = 0;
  std::uint64_t inserted = 0;
  for (const Mask mask : kMasks) {
    for (std::uint64_t seed = 101; seed < 113; ++seed) {
      std::mt19937_64 random(seed);
      const auto width = static_cast<std::int32_t>(2 + random() % 60);
      const auto height = static_cast<std::int32_t>(2 + random() % 60);
      const HeightGrid grid = mountains(width, height, seed, mask);
      for (const double tolerance : {0.0, 3.0, 40.0, 5000.0}) {
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << ", voids " << name_of(mask) << ", tolerance " << tolerance);
        const WindowMesh mesh = triangulate_whole(grid, tolerance, 0.5 + static_cast<double>(random() % 3));
        EXPECT_EQ(validate(mesh), "");
        EXPECT_EQ(complaints(check_surface(mesh, grid), tolerance + 1e-9), "");
        pinched += static_cast<std::uint64_t>(std::count(mesh.kind.begin(), mesh.kind.end(), VertexKind::kLocked));
        inserted += mesh.position.size();
      }
    }
  }
  EXPECT_GT(pinched, 1000U);
  EXPECT_GT(inserted, 10'000U);
}

TEST(Triangulate, JoinsThePartsOfALargeWindow) {
  for (const Mask mask : kMasks) {
    SCOPED_TRACE(name_of(mask));
    const HeightGrid grid = mountains(230, 131, 104, mask);
    for (const double tolerance : {0.0, 10.0, 5000.0}) {
      const WindowMesh mesh = triangulate_whole(grid, tolerance);
      EXPECT_EQ(validate(mesh), "");
      EXPECT_EQ(complaints(check_surface(mesh, grid), tolerance + 1e-9), "");
    }
  }
}

TEST(Triangulate, EveryVertexIsASampleWithItsHeight) {
  const HeightGrid grid = mountains(65, 65, 102, Mask::kSparse);
  const WindowMesh mesh = triangulate_whole(grid, 10);
  ASSERT_GT(mesh.n_vertices(), 500);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const LatticePoint p = mesh.position[v];
    ASSERT_TRUE(is_sample_position(p));
    EXPECT_EQ(mesh.height[v], grid.at(p.x / kLatticePerCell, p.y / kLatticePerCell));
    EXPECT_FALSE(mesh.is_settled[v]);
  }
}

TEST(Triangulate, NeedsTwoTrianglesForAnExactPlane) {
  for (const auto& [width, height] : {std::pair{65, 65}, std::pair{64, 33}, std::pair{2, 2}}) {
    const HeightGrid grid = grid_of(width, height, [](int x, int y) { return 100 + 0.25 * x - 0.5 * y; });
    for (const double tolerance : {0.0, 1.0}) {
      // The hierarchy's squares need not fill the window: some samples more than the corners, but few.
      const std::size_t n = n_triangles(triangulate_whole(grid, tolerance));
      EXPECT_GE(n, 2U);
      EXPECT_LE(n, width == height ? 2U : 64U) << width << " x " << height;
    }
  }
}

TEST(Triangulate, KeepsEverySampleAtToleranceZeroOnRoughGround) {
  std::mt19937_64 random(103);
  const HeightGrid grid = grid_of(31, 17, [&](int, int) { return static_cast<double>(random() % 1000); });
  EXPECT_GE(n_triangles(triangulate_whole(grid, 0)), 2U * 30 * 16 * 98 / 100);
}

TEST(Triangulate, GivesNothingWhereNoCellIsValid) {
  EXPECT_TRUE(triangulate_whole(grid_of(9, 9, [](int, int) { return kVoid; }), 1).origin.empty());
  // Valid samples, but no 2 x 2 of them.
  const HeightGrid stripes = grid_of(9, 9, [](int x, int) { return x % 2 == 0 ? 1.0 : kVoid; });
  EXPECT_TRUE(triangulate_whole(stripes, 1).origin.empty());
}

TEST(Triangulate, CoarserTolerancesNeedFewerTriangles) {
  const HeightGrid grid = mountains(129, 129, 104);
  std::size_t finer = 2 * 128 * 128 + 1;
  for (const double tolerance : {0.5, 2.0, 10.0, 50.0, 250.0}) {
    const std::size_t n = n_triangles(triangulate_whole(grid, tolerance));
    EXPECT_LT(n, finer) << tolerance;
    finer = n;
  }
  EXPECT_LT(finer, 300U);
}

// ---- neighbours along a seam

using SeamEdge = std::tuple<LatticePoint, LatticePoint>;

// The border edges of a mesh along the column (in samples), ends in ascending order.
std::set<SeamEdge> edges_on_column(const WindowMesh& mesh, std::int32_t column, const HeightGrid& grid) {
  std::set<SeamEdge> found;
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (!mesh.is_border_edge(h)) continue;
    const LatticePoint a = mesh.position[static_cast<std::size_t>(mesh.origin[static_cast<std::size_t>(h)])];
    const LatticePoint b = mesh.position[static_cast<std::size_t>(mesh.destination(h))];
    if (a.x != column * kLatticePerCell || b.x != a.x) continue;
    // Rims of voids lie on the column too; the seam is where both sides are valid.
    const std::int32_t y = std::min(a.y, b.y) / kLatticePerCell;
    if (grid.is_valid_cell(column - 1, y) && grid.is_valid_cell(column, y))
      found.insert({std::min(a, b), std::max(a, b)});
  }
  return found;
}

HeightGrid transposed(const HeightGrid& grid) {
  return grid_of(grid.rect.height, grid.rect.width, [&](std::int32_t x, std::int32_t y) { return grid.at(y, x); });
}

void expect_sides_agree(const HeightGrid& grid, double tolerance, std::size_t& n_edges, std::size_t& n_ends) {
  const std::int32_t seam = grid.rect.width / 2 / 8 * 8;
  const GridRect left{0, 0, seam + 1, grid.rect.height};
  const GridRect right{seam, 0, grid.rect.width - seam, grid.rect.height};
  const WindowMesh one = triangulate(around(grid, left), left, {tolerance, 1});
  const WindowMesh other = triangulate(around(grid, right), right, {tolerance, 1});
  const std::set<SeamEdge> edges = edges_on_column(one, seam, grid);
  EXPECT_EQ(edges, edges_on_column(other, seam, grid));
  n_edges += edges.size();
  for (const auto& [a, b] : edges) {  // pieces of the seam that end at a void
    if (std::none_of(edges.begin(), edges.end(), [&, end = b](const SeamEdge& e) { return std::get<0>(e) == end; }))
      ++n_ends;
  }
}

TEST(Triangulate, BothSidesOfASeamAgreeWhateverVoidsTouchIt) {
  std::size_t n_edges = 0;
  std::size_t n_ends = 0;
  for (const Mask mask : kMasks) {
    for (std::uint64_t seed = 121; seed < 133; ++seed) {
      for (const double tolerance : {0.0, 8.0, 60.0}) {
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << ", voids " << name_of(mask) << ", tolerance " << tolerance);
        const HeightGrid grid = mountains(41, 37, seed, mask);
        expect_sides_agree(grid, tolerance, n_edges, n_ends);
        expect_sides_agree(transposed(grid), tolerance, n_edges, n_ends);
      }
    }
  }
  EXPECT_GT(n_edges, 5'000U);
  EXPECT_GT(n_ends, 500U);
}

TEST(Triangulate, BothSidesOfASeamAgreeAlongSeveralParts) {
  std::size_t n_edges = 0;
  std::size_t n_ends = 0;
  for (const Mask mask : kMasks) {
    SCOPED_TRACE(name_of(mask));
    const HeightGrid grid = mountains(41, 233, 135, mask);
    expect_sides_agree(grid, 8, n_edges, n_ends);
    expect_sides_agree(transposed(grid), 8, n_edges, n_ends);
  }
  EXPECT_GT(n_edges, 500U);
}

// A void of one sample at every place around the seam, alone.
TEST(Triangulate, BothSidesOfASeamAgreeAroundASingleVoid) {
  std::size_t n_edges = 0;
  std::size_t n_ends = 0;
  const HeightGrid whole = mountains(17, 12, 134);
  for (std::int32_t x = 6; x <= 10; ++x) {
    for (std::int32_t y = 0; y < 12; ++y) {
      SCOPED_TRACE(testing::Message() << "void at " << x << ", " << y);
      HeightGrid grid = whole;
      grid.z[static_cast<std::size_t>(y) * 17 + static_cast<std::size_t>(x)] = kVoid;
      expect_sides_agree(grid, 30, n_edges, n_ends);
    }
  }
  EXPECT_GT(n_ends, 60U);
}

}  // namespace
}  // namespace tinsmith
