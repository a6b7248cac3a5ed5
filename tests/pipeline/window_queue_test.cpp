#include "pipeline/window_queue.hpp"

#include <gtest/gtest.h>

#include <deque>
#include <random>
#include <set>

namespace tinsmith {
namespace {

// Any order of finishing, any set of tasks that are done before: as in a run that goes on.
TEST(WindowQueue, HandsOutEveryTaskOnceAndAfterItsInputs) {
  std::mt19937 random(17);
  for (const auto& [width, height, side] : {std::array{200, 130, 16}, {40, 40, 64}, {17, 900, 8}}) {
    const WindowGraph graph(width, height, side);
    for (const unsigned share_done : {0U, 3U, 9U}) {
      std::set<std::pair<int, std::int64_t>> done;
      for (int r = 0; r < graph.n_rounds(); ++r) {
        for (std::int64_t w = 0; w < graph.windows(r).count(); ++w) {
          bool has_inputs = true;
          graph.inputs({r, w}).for_each([&](std::int64_t v) { has_inputs = has_inputs && done.count({r - 1, v}); });
          if (has_inputs && random() % 10 < share_done) done.insert({r, w});
        }
      }
      WindowQueue queue(graph, [&](WindowName t) { return done.count({t.round, t.window}) > 0; });
      std::deque<WindowName> at_work;
      while (true) {
        while (at_work.size() < 4) {
          const auto task = queue.next();
          if (!task) break;
          EXPECT_EQ(done.count({task->round, task->window}), 0U);
          graph.inputs(*task).for_each([&](std::int64_t v) { EXPECT_TRUE(done.count({task->round - 1, v})); });
          at_work.push_back(*task);
        }
        if (at_work.empty()) break;
        const std::size_t i = random() % at_work.size();
        const WindowName task = at_work[i];
        at_work.erase(at_work.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_TRUE(done.insert({task.round, task.window}).second);
        queue.done(task);
      }
      for (int r = 0; r < graph.n_rounds(); ++r) EXPECT_EQ(queue.n_done(r), graph.windows(r).count());
    }
  }
}

}  // namespace
}  // namespace tinsmith
