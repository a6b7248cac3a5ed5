// One certificate, whatever the blocks, the memory and the threads.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <random>

#include "io/mesh_cases.hpp"
#include "judge/scene.hpp"
#include "pipeline/measure_blocks.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::array<double Certificate::*, 12> kNumbers{
    &Certificate::max_error,  &Certificate::max_error_column, &Certificate::max_error_row, &Certificate::rmse,
    &Certificate::mean_error, &Certificate::p99_error,        &Certificate::area_plan,     &Certificate::area_valid,
    &Certificate::cells_plan, &Certificate::cells_valid,      &Certificate::rounding,      &Certificate::max_error};
constexpr std::array<std::uint64_t Certificate::*, 13> kCounts{&Certificate::samples,
                                                               &Certificate::covered,
                                                               &Certificate::uncovered,
                                                               &Certificate::overlapped,
                                                               &Certificate::voids_covered,
                                                               &Certificate::vertices,
                                                               &Certificate::triangles,
                                                               &Certificate::folded,
                                                               &Certificate::non_manifold_edges,
                                                               &Certificate::t_junctions,
                                                               &Certificate::unwelded_edges,
                                                               &Certificate::components,
                                                               &Certificate::non_manifold_vertices};

/// To the last bit.
void expect_same(const Certificate& a, const Certificate& b) {
  for (std::size_t i = 0; i < kNumbers.size(); ++i) ASSERT_EQ(a.*kNumbers[i], b.*kNumbers[i]) << "number " << i;
  for (std::size_t i = 0; i < kCounts.size(); ++i) ASSERT_EQ(a.*kCounts[i], b.*kCounts[i]) << "count " << i;
}

/// Rough terrain with voids, meshed fully, then shaken, with triangles lost, doubled, turned, torn apart, led
/// astray across the whole grid or beyond it.
Scene damaged(std::mt19937_64& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  Scene scene = full_plane(20 + static_cast<int>(below(20)), 15 + static_cast<int>(below(20)));
  for (double& z : scene.z) z = below(12) == 0 ? kVoid : static_cast<double>(below(1000)) / 7.0;
  mesh_fully(scene);
  const auto shift = [&](std::size_t most) {
    return (static_cast<double>(below(2 * most + 1)) - double(most)) / 16;
  };
  for (auto& v : scene.vertices)
    if (below(3) == 0) v = {v[0] + shift(8), v[1] + shift(8), v[2] + shift(90)};
  for (std::size_t n = below(30); n > 0; --n) {
    auto& triangle = scene.triangles[below(scene.triangles.size())];
    switch (below(6)) {
      case 0:
        triangle = scene.triangles.back();
        scene.triangles.pop_back();
        break;
      case 1:
        scene.triangles.push_back(std::array(triangle));
        break;
      case 2:
        std::swap(triangle[0], triangle[1]);
        break;
      case 3:
        triangle[2] = static_cast<std::uint32_t>(below(scene.vertices.size()));
        break;
      case 4:
        scene.vertices.push_back(std::array(scene.vertices[triangle[1]]));
        triangle[1] = static_cast<std::uint32_t>(scene.vertices.size() - 1);
        break;
      default: {
        auto& v = scene.vertices[triangle[0]];
        v = {v[0] + shift(16000), v[1] + shift(16000), v[2]};
      }
    }
  }
  return scene;
}

TEST(OutOfCore, BlocksOfAnySizeGiveTheSameCertificate) {
  std::mt19937_64 random(5);
  for (int trial = 0; trial < 150; ++trial) {
    SCOPED_TRACE(trial);
    const Scene scene = damaged(random);
    const Certificate whole = scene.judged();
    for (const BlockSize block : {BlockSize{7, 5}, BlockSize{1, 1}, BlockSize{64, 3}, BlockSize{16, 16}})
      expect_same(scene.judged(block), whole);
  }
}

TEST(OutOfCore, AnyBudgetGivesTheSameCertificate) {
  const ScratchFolder folder;
  std::mt19937_64 random(6);
  for (int trial = 0; trial < 40; ++trial) {
    SCOPED_TRACE(trial);
    const Scene scene = damaged(random);
    const Certificate whole = scene.judged();
    for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{5000}, std::uint64_t{60000}})
      expect_same(scene.judged({7, 5}, {bytes, bytes, folder.file("")}), whole);
  }
}

TEST(OutOfCore, VerticesComeFromTheFileInAnyOrder) {
  const ScratchFolder folder;
  Scene scene = full_plane(150, 140);  // ten times what is kept
  std::mt19937_64 random(8);
  std::shuffle(scene.triangles.begin(), scene.triangles.end(), random);
  expect_same(scene.judged({64, 64}, {0, 100000, folder.file("")}), scene.judged());
}

TEST(OutOfCore, AnyNumberOfThreadsGivesTheSameCertificate) {
  std::mt19937_64 random(7);
  for (int trial = 0; trial < 30; ++trial) {
    SCOPED_TRACE(trial);
    const Scene scene = damaged(random);
    const Certificate whole = scene.judged();
    const ArrayField field(scene.z.data(), scene.width, scene.height);
    const Samples samples{field, scene.frame, {7, 5}, {}};
    const BlockGrid grid(field, samples.block);
    for (const int threads : {1, 2, 5}) {
      BlockedMesh mesh(grid, scene.frame, {});
      mesh.add_vertices(scene.tin().vertices);
      for (const auto& [a, b, c] : scene.tin().triangles) mesh.add_triangle({a, b, c});
      mesh.close();
      expect_same(measure_blocks(mesh, samples, threads, threads == 5 ? 1 : 1 << 20), whole);
    }
  }
}

TEST(OutOfCore, TrianglesMayBeFarLargerThanBlocks) {
  Scene scene = plane_of_two(101, 83);
  scene.at(50, 41) += 4;
  expect_same(scene.judged({7, 5}), scene.judged());
  for (auto& v : scene.vertices) v = {(v[0] - 50) * 1e6, (v[1] - 41) * 1e6, 7};
  const Certificate c = scene.judged({7, 5});
  expect_same(c, scene.judged());
  EXPECT_EQ(c.covered, 101U * 83U);
  EXPECT_EQ(c.components, 1U);
}

TEST(OutOfCore, PartsFarApartAreCountedOnce) {
  Scene scene = full_plane(60, 40);
  std::erase_if(scene.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return scene.vertices[v][0] == 30; });
  });
  EXPECT_EQ(scene.judged({7, 5}).components, 2U);
}

/// Next to nothing in a raster of 90 billion samples: only the corner may be read.
class VastField : public HeightField {
 public:
  std::int32_t width() const override { return 300000; }
  std::int32_t height() const override { return 300000; }
  HeightGrid read(const GridRect& rect) const override {
    EXPECT_FALSE(is_surely_void(rect));
    HeightGrid grid{rect, {}};
    for (std::int32_t y = rect.y0; y < rect.y0 + rect.height; ++y)
      for (std::int32_t x = rect.x0; x < rect.x0 + rect.width; ++x)
        grid.z.push_back(x < kSide && y < kSide && x >= 0 && y >= 0 ? 100 + 2 * x - 3 * y : kVoid);
    return grid;
  }
  bool is_surely_void(const GridRect& rect) const override { return rect.x0 >= kSide || rect.y0 >= kSide; }

  static constexpr int kSide = 30;
};

TEST(OutOfCore, VoidsCostNothing) {
  const VastField field;
  const Scene scene = full_plane(VastField::kSide, VastField::kSide);
  const Certificate c = measure(scene.tin(), {field, scene.frame, {}, {}});
  EXPECT_EQ(c.covered, 900U);
  EXPECT_TRUE(c.broken_promises(0).empty());
}

TEST(OutOfCore, AFullScratchFolderIsAnErrorThatLeavesNothing) {
  const ScratchFolder folder;
  const Scene scene = full_plane(40, 40);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit limit{20000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &limit);
  EXPECT_THROW(scene.judged({7, 5}, {0, 5000, folder.file("")}), ResourceError);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
  EXPECT_THROW(scene.judged({7, 5}, {0, 5000, folder.file("missing")}), OutputError);
}

TEST(ExactSum, LosesNothingInAnyOrder) {
  std::mt19937_64 random(9);
  std::vector<double> numbers;
  for (int i = 0; i < 1000; ++i) {
    const double x = std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 1800) - 1000);
    numbers.insert(numbers.end(), {x, -x});
  }
  numbers.push_back(0.1);
  std::shuffle(numbers.begin(), numbers.end(), random);
  ExactSum sum;
  for (const double x : numbers) sum.add(x);
  EXPECT_EQ(sum.value(), 0.1);
  sum.add(-0.3);
  EXPECT_DOUBLE_EQ(sum.value(), -0.2);
  sum.add(std::numeric_limits<double>::infinity());
  EXPECT_EQ(sum.value(), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace tinsmith
