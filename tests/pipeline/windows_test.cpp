// Tiled equals untiled, parallel equals serial, on the sample terrain.

#include <cmath>
#include <iostream>
#include <numeric>

#include "pipeline_fixture.hpp"

namespace tinsmith {
namespace {

using namespace test;

bool same_bytes(const TerrainMesh& a, const TerrainMesh& b) {
  return a.position == b.position && a.height == b.height && a.triangles == b.triangles;
}

TEST(RunRounds, GivesTheSameBytesForAnyNumberOfThreads) {
  const HeightGrid grid = GridField(matterhorn().read({0, 0, 400, 330})).read({0, 0, 400, 330});
  HeightGrid with_voids = grid;
  cut(with_voids, Mask::kSparse, 311);
  for (const HeightGrid& one : {grid, with_voids}) {
    const RoundsOptions options{10, 64, Placement::kOptimal, Effort::kDefault};
    const Outcome serial = run_on(one, options, 1);
    EXPECT_GT(serial.report.windows, 30U);
    EXPECT_GT(serial.mesh.triangles.size(), 10'000U);
    for (const int threads : {2, 3, 8, 8})
      EXPECT_TRUE(same_bytes(run_on(one, options, threads).mesh, serial.mesh)) << threads;
  }
}

// Vertices within two cells of the seams of a round.
std::uint64_t n_near_seams(const TerrainMesh& mesh, std::int32_t window, std::int32_t shift) {
  constexpr std::int32_t kNear = 2 * kLatticePerCell;
  const auto is_near = [&](std::int32_t v) {
    const std::int32_t side = window * kLatticePerCell;
    const std::int32_t nearest = (v + shift * kLatticePerCell + side / 2) / side * side - shift * kLatticePerCell;
    return nearest > 0 && nearest < 1024 * kLatticePerCell && std::abs(v - nearest) <= kNear;
  };
  std::uint64_t n = 0;
  for (const LatticePoint p : mesh.position) n += is_near(p.x) || is_near(p.y) ? 1 : 0;
  return n;
}

double share_of_later_rounds(const CompressReport& report) {
  const double total = std::accumulate(report.round_seconds.begin(), report.round_seconds.end(), 0.0);
  return 1 - report.round_seconds.front() / total;
}

// How many vertices there are near seams, and how many of the one-window result in the same places.
struct Density {
  std::uint64_t found = 0;
  std::uint64_t expected = 0;
  double ratio() const { return static_cast<double>(found) / static_cast<double>(expected); }
};

// Counts at most 1.01 x those of the one-window result, density near former seams at most 1.05 x. Times are
// printed, not tested.
TEST(RunRounds, LeavesNoTraceOfItsWindows) {
  const Outcome one = run_on_matterhorn(20, 1024);
  ASSERT_EQ(one.report.windows, 1U);
  const auto n_one = static_cast<double>(one.mesh.triangles.size());
  Density all;
  for (const std::int32_t window : {64, 128, 256, 512}) {
    SCOPED_TRACE(testing::Message() << "window " << window);
    const Outcome tiled = run_on_matterhorn(20, window);
    EXPECT_EQ(tiled.report.windows, static_cast<std::uint64_t>((1024 / window) * (1024 / window)));
    EXPECT_LE(static_cast<double>(tiled.mesh.triangles.size()), 1.01 * n_one);
    std::cout << "window " << window << ": " << tiled.mesh.triangles.size() << " triangles, one window " << n_one
              << "; later rounds take " << 100 * share_of_later_rounds(tiled.report) << " %; density at seams";
    for (const std::int32_t shift : {0, window / 2}) {
      const Density density{n_near_seams(tiled.mesh, window, shift), n_near_seams(one.mesh, window, shift)};
      std::cout << " " << density.ratio() << " (" << density.expected << " vertices)";
      EXPECT_GT(density.expected, 400U);
      EXPECT_LE(density.ratio(), 1.05) << "shift " << shift;
      if (shift == 0) all = {all.found + density.found, all.expected + density.expected};
    }
    std::cout << "\n";
  }
  EXPECT_GT(all.expected, 10'000U);
  EXPECT_LE(all.ratio(), 1.05);
}

// The targets, default options.
TEST(RunRounds, ReachesTheTriangleTargetsOnTheSampleTerrain) {
  const HeightGrid grid = matterhorn().read({0, 0, 1025, 1025});
  struct Target {
    double tolerance;
    std::uint64_t triangles;
  };
  for (const auto [tolerance, triangles] : {Target{5, 525'000}, {10, 285'000}, {20, 135'000}, {50, 42'000}}) {
    const Outcome run = run_on_matterhorn(tolerance, CompressOptions{}.window);
    EXPECT_LE(run.mesh.triangles.size(), triangles) << tolerance << " m";
    EXPECT_EQ(complaints(check_surface(run.mesh, grid), tolerance), "");
    std::cout << tolerance << " m: " << run.mesh.triangles.size() << " triangles, later rounds take "
              << 100 * share_of_later_rounds(run.report) << " %\n";
  }
}

}  // namespace
}  // namespace tinsmith
