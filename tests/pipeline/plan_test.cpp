// The plan's windows, and the share of the work that is done.

#include "tinsmith/plan.hpp"

#include <set>

#include "pipeline/trial.hpp"
#include "pipeline/workload.hpp"
#include "pipeline_fixture.hpp"
#include "samples/grid_rect.hpp"

namespace tinsmith {
namespace {

using namespace test;

// A huge field of which only some squares are there.
class SparseField : public HeightField {
 public:
  SparseField(std::int32_t side, std::vector<GridRect> islands) : side_(side), islands_(std::move(islands)) {}
  std::int32_t width() const override { return side_; }
  std::int32_t height() const override { return side_; }
  HeightGrid read(const GridRect& rect) const override {
    HeightGrid grid = void_grid(rect);
    for (std::int64_t i = 0; i < rect.area(); ++i) {
      const GridRect sample{static_cast<std::int32_t>(rect.x0 + i % rect.width),
                            static_cast<std::int32_t>(rect.y0 + i / rect.width), 1, 1};
      if (!is_surely_void(sample)) grid.z[static_cast<std::size_t>(i)] = std::sin(0.3 * sample.x0) * sample.y0;
    }
    return grid;
  }
  bool is_surely_void(const GridRect& rect) const override {
    return std::none_of(islands_.begin(), islands_.end(),
                        [&](const GridRect& island) { return !is_empty(intersection(island, rect)); });
  }

 private:
  std::int32_t side_;
  std::vector<GridRect> islands_;
};

TEST(Plan, TriesWindowsFarFromEachOther) {
  std::vector<std::int64_t> windows(90 * 60);
  for (std::size_t i = 0; i < windows.size(); ++i) windows[i] = static_cast<std::int64_t>(i);
  std::set<std::pair<std::int64_t, std::int64_t>> parts;
  for (const std::int64_t w : spread_out(windows, 90)) parts.emplace(w % 90 / 18, w / 90 / 12);
  EXPECT_EQ(parts.size(), 25U);
  windows.resize(90 * 6);
  parts.clear();
  for (const std::int64_t w : spread_out(windows, 90)) parts.emplace(w % 90 / 30, w / 90 / 2);
  EXPECT_EQ(parts.size(), 9U) << "of fewer windows fewer";
  EXPECT_EQ(spread_out({5, 7}, 3), (std::vector<std::int64_t>{5, 7}));
  EXPECT_TRUE(spread_out({}, 3).empty());
}

TEST(Plan, TriesOnlyWhereSamplesMayBe) {
  const SparseField field(20000, {{100, 100, 60, 60}, {19000, 19500, 10, 300}});
  const WindowGraph graph(field.width(), field.height(), 32);
  for (const std::int64_t w : windows_with_samples(field, graph))
    EXPECT_FALSE(field.is_surely_void(graph.samples({0, w})));
  EXPECT_LT(windows_with_samples(field, graph).size(), 40U);
}

// The fraction rises by work only, from 0 to 1, however much of the field is empty.
TEST(Progress, CountsWindowsThatMayHoldSamples) {
  const SparseField field(3000, {{10, 2900, 60, 90}});
  std::vector<double> told;
  CompressReport report;
  run_rounds(
      field, {}, {0.5, 32, Placement::kOptimal},
      [&](double fraction, std::string_view) {
        told.push_back(fraction);
        return true;
      },
      report);
  ASSERT_FALSE(told.empty());
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
  const auto void_steps = std::count(told.begin(), told.end(), 0.0);
  EXPECT_GT(void_steps, 1000) << "the empty windows above the island are no work";
}

TEST(Progress, OfAnEmptyFieldIsDone) {
  const SparseField field(1000, {});
  const WindowGraph graph(field.width(), field.height(), 32);
  EXPECT_EQ(Workload(field, graph).fraction(), 1);
}

}  // namespace
}  // namespace tinsmith
