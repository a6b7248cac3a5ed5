#pragma once
// Which window task is next.

#include <array>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <queue>
#include <vector>

#include "tile/window_graph.hpp"

namespace tinsmith {

/// Hands out every task that is not done once, each when all its inputs are done. Later rounds go first, then rows
/// from the top: what is finished is used, and can be dropped, as soon as possible. Members may be called by
/// several threads.
class WindowQueue {
 public:
  using IsDone = std::function<bool(WindowName)>;

  WindowQueue(const WindowGraph& graph, const IsDone& is_done);

  /// None when nothing is ready: all is handed out, or waits for tasks that are at work.
  std::optional<WindowName> next();

  /// Notes a task as done. Returns how many are ready now, or more.
  std::int64_t done(WindowName task);

  std::int64_t n_done(int round) const;

 private:
  using Windows = std::priority_queue<std::int64_t, std::vector<std::int64_t>, std::greater<>>;
  struct Round {
    std::vector<std::uint8_t> n_waiting_for;  // inputs not done, by window
    std::vector<std::uint8_t> is_done;
    Windows ready;
    std::int64_t n_done = 0;
  };
  Round& round(int r) { return rounds_[static_cast<std::size_t>(r)]; }

  const WindowGraph& graph_;
  mutable std::mutex mutex_;
  std::array<Round, kRounds> rounds_;
  std::int64_t next_first_ = 0;  // of round 0
};

}  // namespace tinsmith
