#include "pipeline/window_queue.hpp"

#include <algorithm>

namespace tinsmith {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

}  // namespace

WindowQueue::WindowQueue(const WindowGraph& graph, const IsDone& is_done) : graph_(graph) {
  for (int r = 0; r < graph.n_rounds(); ++r) {
    const std::int64_t n = graph.windows(r).count();
    round(r).is_done.resize(at(n));
    round(r).n_waiting_for.resize(at(n), 0);
    for (std::int64_t w = 0; w < n; ++w) {
      round(r).is_done[at(w)] = is_done({r, w}) ? 1 : 0;
      round(r).n_done += round(r).is_done[at(w)];
      if (r == 0 || round(r).is_done[at(w)]) continue;
      graph.inputs({r, w}).for_each([&](std::int64_t maker) {
        if (!round(r - 1).is_done[at(maker)]) ++round(r).n_waiting_for[at(w)];
      });
      if (round(r).n_waiting_for[at(w)] == 0) round(r).ready.push(w);
    }
  }
}

std::optional<WindowName> WindowQueue::next() {
  const std::lock_guard lock(mutex_);
  for (int r = graph_.last_round(); r > 0; --r) {
    if (round(r).ready.empty()) continue;
    const std::int64_t window = round(r).ready.top();
    round(r).ready.pop();
    return WindowName{r, window};
  }
  const std::int64_t n = graph_.windows(0).count();
  while (next_first_ < n && round(0).is_done[at(next_first_)]) ++next_first_;
  if (next_first_ == n) return std::nullopt;
  return WindowName{0, next_first_++};
}

std::int64_t WindowQueue::done(WindowName task) {
  const std::lock_guard lock(mutex_);
  round(task.round).is_done[at(task.window)] = 1;
  ++round(task.round).n_done;
  graph_.readers(task).for_each([&](std::int64_t reader) {
    Round& after = round(task.round + 1);
    if (!after.is_done[at(reader)] && --after.n_waiting_for[at(reader)] == 0) after.ready.push(reader);
  });
  std::int64_t n_ready = graph_.windows(0).count() - next_first_;
  for (int r = 1; r < graph_.n_rounds(); ++r) n_ready += static_cast<std::int64_t>(round(r).ready.size());
  return n_ready;
}

std::int64_t WindowQueue::n_done(int r) const {
  const std::lock_guard lock(mutex_);
  return rounds_[at(r)].n_done;
}

}  // namespace tinsmith
