// The guarantees on the whole surface, whatever the voids, sizes and windows.

#include "pipeline_fixture.hpp"

namespace tinsmith {
namespace {

using namespace test;

TEST(RunRounds, GivesACertifiedSurfaceOverAllVoidsAndWindows) {
  std::uint64_t n_components = 0;
  std::uint64_t n_windows = 0;
  for (const Mask mask : kMasks) {
    for (std::uint64_t seed = 301; seed < 305; ++seed) {
      const HeightGrid grid = mountains(70, 51, seed, mask);
      for (const std::int32_t window : {4, 8, 16, 37, 128}) {
        for (const double tolerance : {0.0, 5.0, 60.0, 1e6}) {
          SCOPED_TRACE(testing::Message() << "seed " << seed << ", voids " << name_of(mask) << ", window " << window
                                          << ", tolerance " << tolerance);
          const Outcome run = run_on(grid, {tolerance, window, Placement::kOptimal});
          const SurfaceCheck check = check_surface(run.mesh, grid);
          // At 0 the last bits of the doubles are left.
          EXPECT_EQ(complaints(check, tolerance == 0 ? 1e-10 : tolerance), "");
          EXPECT_EQ(run.report.full_triangles, 2 * check.cells);
          EXPECT_EQ(run.report.triangles, run.mesh.triangles.size());
          EXPECT_EQ(run.report.vertices, run.mesh.position.size());
          EXPECT_LE(run.report.triangles, run.report.full_triangles);
          n_components += check.components;
          n_windows += run.report.windows;
        }
      }
    }
  }
  EXPECT_GT(n_components, 5'000U);
  EXPECT_GT(n_windows, 20'000U);
}

TEST(RunRounds, HoldsForEveryPlacement) {
  for (const Mask mask : kMasks) {
    for (const Placement placement : {Placement::kOptimal, Placement::kSegment, Placement::kSubset}) {
      SCOPED_TRACE(testing::Message() << name_of(mask) << ", placement " << static_cast<int>(placement));
      const HeightGrid grid = mountains(70, 51, 306, mask);
      const Outcome run = run_on(grid, {25, 16, placement});
      EXPECT_EQ(complaints(check_surface(run.mesh, grid), 25), "");
      if (placement != Placement::kSubset) continue;
      for (std::size_t v = 0; v < run.mesh.position.size(); ++v) {
        const LatticePoint p = run.mesh.position[v];
        ASSERT_EQ(run.mesh.height[v], grid.at(p.x / kLatticePerCell, p.y / kLatticePerCell));
      }
    }
  }
}

TEST(RunRounds, HoldsForStripsAndTinyRasters) {
  for (const auto& [width, height] :
       {std::pair{2, 2}, {2, 200}, {200, 2}, {3, 3}, {3, 130}, {5, 4}, {17, 17}, {16, 18}}) {
    for (const std::int32_t window : {4, 16, 256}) {
      for (const Mask mask : {Mask::kNone, Mask::kSparse}) {
        SCOPED_TRACE(testing::Message()
                     << width << " x " << height << ", window " << window << ", " << name_of(mask));
        const HeightGrid grid = mountains(width, height, 307, mask);
        EXPECT_EQ(complaints(check_surface(run_on(grid, {15, window, {}}).mesh, grid), 15), "");
      }
    }
  }
}

TEST(RunRounds, GivesAnEmptyMeshWhereNoCellIsValid) {
  for (const auto& [width, height] : {std::pair{1, 1}, {1, 50}, {50, 1}, {40, 40}}) {
    const HeightGrid grid = grid_of(width, height, [](int, int y) { return y % 2 == 0 ? 5.0 : kVoid; });
    const Outcome run = run_on(grid, {1, 8, {}});
    EXPECT_TRUE(run.mesh.triangles.empty());
    EXPECT_EQ(run.report.samples, static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>((height + 1) / 2));
  }
}

// Not promised: two triangles whatever the windows. One that is larger than a window is shared, and locked, in
// every round.
TEST(RunRounds, EndsAPlaneAsTwoTrianglesAWindowAtMost) {
  const HeightGrid grid = grid_of(101, 77, [](int x, int y) { return 700 + 0.5 * x + 0.25 * y; });
  for (const std::int32_t window : {8, 16, 50, 200}) {
    for (const double tolerance : {0.0, 0.5}) {
      const Outcome run = run_on(grid, {tolerance, window, {}});
      EXPECT_EQ(complaints(check_surface(run.mesh, grid), tolerance == 0 ? 1e-10 : tolerance), "");
      EXPECT_LE(run.mesh.triangles.size(), 2 * run.report.windows)
          << "window " << window << ", tolerance " << tolerance;
    }
  }
}

// Every sample of the rough half stays, and every triangle between two of its columns.
TEST(RunRounds, ChangesNothingButExactPlanesAtToleranceZero) {
  std::mt19937_64 random(308);
  std::uniform_real_distribution<double> rough(0, 1000);
  const HeightGrid grid = grid_of(61, 40, [&](int x, int) { return x < 30 ? 64.0 : rough(random); });
  const Outcome run = run_on(grid, {0, 16, {}});
  EXPECT_EQ(complaints(check_surface(run.mesh, grid), 1e-10), "");
  EXPECT_GE(run.mesh.triangles.size(), 2U * 30 * 39 + 39);
  EXPECT_LE(run.mesh.triangles.size(), 2U * 31 * 39 + 200);
}

TEST(RunRounds, HoldsForSteepStepsAndLargeHeights) {
  for (const double base : {0.0, 1e7, -1e9}) {
    const HeightGrid grid =
        grid_of(60, 60, [&](int x, int y) { return base + (x < 31 ? 0 : 900) + 0.125 * ((x * y) % 7); });
    for (const double tolerance : {0.01, 1.0}) {
      SCOPED_TRACE(testing::Message() << "base " << base << ", tolerance " << tolerance);
      const Outcome run = run_on(grid, {tolerance, 16, {}});
      EXPECT_EQ(complaints(check_surface(run.mesh, grid), tolerance), "");
    }
  }
}

}  // namespace
}  // namespace tinsmith
