// What each effort owes on the sample terrain, beside greedy insertion at the same largest error.

#include "io/raster_fixture.hpp"
#include "tinsmith/compress.hpp"
#include "tinsmith/verify.hpp"

namespace tinsmith {
namespace {

// npm's delatin 0.2.0 on the same samples; tools/bench/RESULTS.md.
struct Greedy {
  double tolerance;
  double triangles;
  double rmse;
};
constexpr Greedy kAt20{20, 281'240, 7.201};
constexpr Greedy kAt50{50, 90'171, 16.48};

class EffortTest : public RasterTest {};

TEST_F(EffortTest, GivesItsShareOfGreedyInsertionsTrianglesAndIsNoRougher) {
  struct Case {
    Effort effort;
    Greedy greedy;
    double share;
  };
  const std::string dem = TINSMITH_SOURCE_DIR "/data/matterhorn.tif";
  for (const auto& [effort, greedy, share] :
       {Case{Effort::kDefault, kAt20, 0.38}, Case{Effort::kDefault, kAt50, 0.365},
        Case{Effort::kBest, kAt20, 0.355}, Case{Effort::kBest, kAt50, 0.345}}) {
    CompressOptions options;
    options.max_error = greedy.tolerance;
    options.effort = effort;
    const CompressReport report = compress({dem}, path("tin.ply"), {}, options);
    EXPECT_LE(static_cast<double>(report.triangles), share * greedy.triangles);
    const Certificate certificate = verify({dem}, path("tin.ply"), {});
    EXPECT_LE(certificate.max_error, greedy.tolerance);
    EXPECT_LE(certificate.rmse, greedy.rmse);
  }
}

}  // namespace
}  // namespace tinsmith
