#include "tinsmith/compress.hpp"

#include <functional>

#include "pipeline_fixture.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

using namespace test;

HeightArray array_of(const HeightGrid& grid, double step_x = 1, double step_y = 1) {
  return {grid.rect.width, grid.rect.height, grid.z.data(), step_x, step_y};
}

CompressOptions with_max_error(double max_error) {
  CompressOptions options;
  options.max_error = max_error;
  return options;
}

TEST(Compress, GivesCoordinatesInMetresOfTheArraysSteps) {
  const HeightGrid grid = grid_of(11, 6, [](int x, int y) { return 2.0 * x + y; });
  CompressReport report;
  const Tin tin = compress(array_of(grid, 30, 20), with_max_error(0), &report);
  ASSERT_EQ(tin.triangles.size(), 2U);
  EXPECT_EQ(report.samples, 66U);
  EXPECT_EQ(report.triangles, 2U);
  EXPECT_EQ(report.full_triangles, 100U);
  for (const auto& [x, y, z] : tin.vertices) {
    EXPECT_TRUE(x == 0 || x == 300) << x;
    EXPECT_TRUE(y == 0 || y == 100) << y;
    EXPECT_NEAR(z, 2 * x / 30 + y / 20, 1e-9);
  }
  for (const auto& [a, b, c] : tin.triangles) {
    const auto& [p, q, r] = std::tie(tin.vertices[a], tin.vertices[b], tin.vertices[c]);
    EXPECT_GT((q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]), 0);
  }
}

TEST(Compress, GivesTheSameBytesForAnyNumberOfThreads) {
  const HeightGrid grid = mountains(200, 170, 321, Mask::kSparse);
  CompressOptions options = with_max_error(10);
  options.window = 32;
  options.threads = 1;
  const Tin serial = compress(array_of(grid), options);
  EXPECT_GT(serial.triangles.size(), 3'000U);
  for (const int threads : {2, 3, 8}) {
    options.threads = threads;
    const Tin parallel = compress(array_of(grid), options);
    EXPECT_EQ(parallel.vertices, serial.vertices);
    EXPECT_EQ(parallel.triangles, serial.triangles);
  }
}

TEST(Compress, StopsAtANumberOfTrianglesOrJustBelow) {
  const HeightGrid grid = mountains(257, 257, 322);
  for (const double triangles : {300.0, 5'000.0, 40'000.0}) {
    CompressOptions options;
    options.triangles = triangles;
    CompressReport report;
    const Tin tin = compress(array_of(grid), options, &report);
    EXPECT_LE(static_cast<double>(tin.triangles.size()), triangles);
    EXPECT_GE(static_cast<double>(tin.triangles.size()), 0.95 * triangles);
    EXPECT_EQ(report.triangles, tin.triangles.size());
    // The tolerance told is the one that the result was made with.
    EXPECT_EQ(compress(array_of(grid), with_max_error(report.tolerance)).triangles, tin.triangles);
  }
}

TEST(Compress, StopsAtARatioOfTheFullGridsTriangles) {
  const HeightGrid grid = mountains(257, 257, 323, Mask::kRing);
  for (const double ratio : {0.02, 0.2}) {
    CompressOptions options;
    options.ratio = ratio;
    CompressReport report;
    const Tin tin = compress(array_of(grid), options, &report);
    const double reached = static_cast<double>(tin.triangles.size()) / static_cast<double>(report.full_triangles);
    EXPECT_LE(reached, ratio);
    EXPECT_GE(reached, 0.95 * ratio);
  }
}

TEST(Compress, GivesAllTrianglesWhenMoreAreAllowedThanThereAre) {
  const HeightGrid grid = mountains(20, 20, 324);
  CompressOptions options;
  options.triangles = 1e7;
  EXPECT_LE(compress(array_of(grid), options).triangles.size(), 2U * 19 * 19);
  options.triangles.reset();
  options.ratio = 1;
  EXPECT_LE(compress(array_of(grid), options).triangles.size(), 2U * 19 * 19);
}

TEST(Compress, ThrowsWhenTheOutlineNeedsMoreTriangles) {
  const HeightGrid grid = mountains(65, 65, 325, Mask::kChecker);
  CompressOptions options;
  options.triangles = 10;
  EXPECT_THROW(compress(array_of(grid), options), ResultError);
  options.triangles.reset();
  options.ratio = 1e-9;
  EXPECT_THROW(compress(array_of(grid), options), ResultError);
}

TEST(Compress, ThrowsAtOptionsWithoutSense) {
  const HeightGrid grid = mountains(9, 9, 326);
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const auto refuses = [&](const std::function<void(CompressOptions&)>& change) {
    CompressOptions options = with_max_error(1);
    change(options);
    EXPECT_THROW(compress(array_of(grid), options), UsageError);
  };
  refuses([](CompressOptions& o) { o.max_error.reset(); });
  refuses([](CompressOptions& o) { o.triangles = 100; });
  refuses([](CompressOptions& o) { o.ratio = 0.5; });
  for (const double wrong : {-1.0, kVoid, kInfinite}) {
    refuses([&](CompressOptions& o) { o.max_error = wrong; });
    refuses([&](CompressOptions& o) { o.max_error.reset(), o.triangles = wrong; });
    refuses([&](CompressOptions& o) { o.max_error.reset(), o.ratio = wrong; });
  }
  refuses([](CompressOptions& o) { o.max_error.reset(), o.triangles = 1; });
  refuses([](CompressOptions& o) { o.max_error.reset(), o.triangles = 2.5; });
  refuses([](CompressOptions& o) { o.max_error.reset(), o.ratio = 0; });
  refuses([](CompressOptions& o) { o.max_error.reset(), o.ratio = 1.01; });
  refuses([](CompressOptions& o) { o.window = 3; });
  refuses([](CompressOptions& o) { o.window = -64; });
  refuses([](CompressOptions& o) { o.threads = -1; });
}

TEST(Compress, ThrowsWhereThereIsNoSurface) {
  const HeightGrid row = grid_of(50, 1, [](int, int) { return 1.0; });
  const HeightGrid voids = grid_of(9, 9, [](int, int) { return kVoid; });
  for (const HeightGrid& grid : {row, voids}) {
    EXPECT_THROW(compress(array_of(grid), with_max_error(1)), InputError);
    CompressOptions options;
    options.triangles = 100;
    EXPECT_THROW(compress(array_of(grid), options), InputError);
  }
  EXPECT_THROW(compress(HeightArray{}, with_max_error(1)), InputError);
  HeightGrid infinite = mountains(9, 9, 327);
  infinite.z[40] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(compress(array_of(infinite), with_max_error(1)), InputError);
}

TEST(Compress, ThrowsInterruptedWhenProgressSaysStop) {
  const HeightGrid grid = mountains(129, 129, 328);
  CompressOptions options = with_max_error(10);
  options.window = 16;
  int n_calls = 0;
  options.progress = [&](double, std::string_view) { return ++n_calls < 5; };
  EXPECT_THROW(compress(array_of(grid), options), Interrupted);
  EXPECT_GE(n_calls, 5);
}

TEST(Compress, ItsProgressNeverFallsWithinAStage) {
  const HeightGrid grid = mountains(129, 129, 329);
  CompressOptions options = with_max_error(10);
  options.window = 16;
  options.threads = 3;
  double told = 0;
  std::string stage;
  int n_calls = 0;
  options.progress = [&](double fraction, std::string_view now) {
    EXPECT_TRUE(now != stage || fraction >= told) << stage << " " << told << " " << fraction;
    EXPECT_GE(fraction, 0);
    EXPECT_LE(fraction, 1 + 1e-9);
    told = fraction;
    stage = now;
    ++n_calls;
    return true;
  };
  compress(array_of(grid), options);
  EXPECT_GT(n_calls, 64);
  EXPECT_NEAR(told, 1, 1e-9);
}

}  // namespace
}  // namespace tinsmith
