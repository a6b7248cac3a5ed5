// The search for a tolerance, and what of its attempts is kept.

#include "pipeline/search.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "io/mesh_cases.hpp"
#include "pipeline/attempt_log.hpp"

namespace tinsmith {
namespace {

class CountedSurface : public TerrainSurface {
 public:
  explicit CountedSurface(double n_triangles) { extent_.n_triangles = static_cast<std::uint64_t>(n_triangles); }
  const TerrainExtent& extent() const override { return extent_; }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& /*visit*/) const override {}
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& /*visit*/) const override {}

 private:
  TerrainExtent extent_;
};

/// Attempts on a terrain whose triangles fall steadily with the tolerance; notes what was run and dropped.
struct Attempted {
  explicit Attempted(const std::string& file) : log(file) {}

  Attempts attempts() {
    return {[this](double tolerance, CompressReport& report) {
              run.push_back(tolerance);
              report.tolerance = tolerance;
              report.full_triangles = 2000000;
              return std::make_shared<CountedSurface>(1e6 * std::pow(1 + tolerance, -1.3));
            },
            [this](double tolerance) { return log.find(tolerance); },
            [this](const Attempt& attempt) {
              log.add(attempt);
              dropped.insert(attempt.tolerance);
            }};
  }
  double found(double triangles) {
    CompressReport report;
    search_tolerance(attempts(), triangles, {}, report);
    return report.tolerance;
  }

  AttemptLog log;
  std::vector<double> run;
  std::set<double> dropped;
};

// A staircase: from 133.7 on 2 triangles, and so on.
TEST(Search, OfFewTrianglesFindsTheLeastToleranceThatReachesThem) {
  for (const auto& [n, least] : {std::pair{2.0, 133.7}, {4.0, 115.4}, {5.0, 115.4}, {40.0, 3.0}, {99.0, 3.0}}) {
    int n_runs = 0;
    const Attempts attempts{[&](double tolerance, CompressReport& report) {
      ++n_runs;
      report.tolerance = tolerance;
      return std::make_shared<CountedSurface>(tolerance >= 133.7   ? 2
                                              : tolerance >= 115.4 ? 4
                                              : tolerance >= 3     ? 40
                                                                   : 5000);
    }};
    CompressReport report;
    const auto surface = search_tolerance(attempts, n, {}, report);
    EXPECT_LE(static_cast<double>(surface->extent().n_triangles), n);
    EXPECT_GE(report.tolerance, least);
    EXPECT_LE(report.tolerance, 1.01 * least) << n;
    EXPECT_LE(n_runs, 12) << n;
  }
}

TEST(Search, DropsEveryAttemptButTheResult) {
  for (const double triangles : {30.0, 999.0, 54321.0, 400000.0}) {
    const ScratchFolder folder;
    Attempted first(folder.file("attempts"));
    const double tolerance = first.found(triangles);
    ASSERT_GT(first.run.size(), 2U);
    std::set<double> all(first.run.begin(), first.run.end());
    EXPECT_EQ(all.size(), first.run.size()) << "each is tried once";
    EXPECT_EQ(all.erase(tolerance), 1U);
    EXPECT_EQ(first.dropped, all);
    Attempted again(folder.file("attempts"));
    EXPECT_EQ(again.found(triangles), tolerance);
    EXPECT_EQ(again.run, std::vector<double>{tolerance}) << "what was dropped is not tried again";
  }
}

TEST(Search, TriesAgainWhatATornLogDoesNotTell) {
  for (std::size_t lost = 1; lost < 400; lost += 7) {
    const ScratchFolder folder;
    Attempted first(folder.file("attempts"));
    const double tolerance = first.found(54321);
    std::string bytes = bytes_of(folder.file("attempts"));
    bytes.resize(bytes.size() - std::min(lost, bytes.size()));
    std::ofstream(folder.file("attempts"), std::ios::binary) << bytes;
    Attempted again(folder.file("attempts"));
    EXPECT_EQ(again.found(54321), tolerance);
    EXPECT_EQ(Attempted(folder.file("attempts")).found(54321), tolerance);
  }
}

TEST(Search, OfADamagedLineKnowsNothing) {
  const ScratchFolder folder;
  AttemptLog(folder.file("attempts")).add({16, 1234, 5678});
  ASSERT_TRUE(AttemptLog(folder.file("attempts")).find(16));
  EXPECT_EQ(AttemptLog(folder.file("attempts")).find(16)->triangles, 1234U);
  EXPECT_EQ(AttemptLog(folder.file("attempts")).find(16)->full_triangles, 5678U);
  std::string bytes = bytes_of(folder.file("attempts"));
  bytes.replace(bytes.find("1234"), 4, "1235");
  std::ofstream(folder.file("attempts"), std::ios::binary) << bytes;
  EXPECT_FALSE(AttemptLog(folder.file("attempts")).find(16));
}

}  // namespace
}  // namespace tinsmith
