#pragma once
// How much of the work on all windows is done.

#include <array>
#include <atomic>
#include <cstdint>
#include <vector>

#include "samples/height_grid.hpp"
#include "tile/window_graph.hpp"

namespace tinsmith {

// Part of the whole run that each round takes; measured on mountains at 10 m.
inline constexpr std::array<double, kRounds> kRoundShare{0.9, 0.06, 0.04};

/// Counts the windows that may hold samples, by rounds; those that surely hold none are done at once and don't
/// count. Members may be called by several threads.
class Workload {
 public:
  /// The graph must outlive it. Asks the field once for each window of round 0. Throws InputError.
  Workload(const HeightField& field, const WindowGraph& graph);

  /// Whether the window surely holds no sample, nor do those that its triangles come from.
  bool is_void(WindowName task) const {
    return has_samples_[static_cast<std::size_t>(task.round)][static_cast<std::size_t>(task.window)] == 0;
  }

  void add_done(WindowName task);

  /// Of the work of all rounds, 0 to 1.
  double fraction() const;

 private:
  std::array<std::vector<std::uint8_t>, kRounds> has_samples_;  // by window
  std::array<std::int64_t, kRounds> n_all_{};
  std::array<std::atomic<std::int64_t>, kRounds> n_done_{};
};

}  // namespace tinsmith
