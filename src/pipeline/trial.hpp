#pragma once
// A few windows, really compressed, for what they tell of all.

#include <cstdint>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "pipeline/rounds.hpp"
#include "samples/height_grid.hpp"
#include "tile/window_graph.hpp"

namespace tinsmith {

/// The windows of round 0 that may hold samples, ascending.
std::vector<std::int64_t> windows_with_samples(const HeightField& field, const WindowGraph& graph);

/// Up to nine of the windows, of more than a thousand up to 25, spread over the rows and columns that they are in.
std::vector<std::int64_t> spread_out(std::vector<std::int64_t> windows, std::int64_t columns);

/// Sums over the tried windows, but for one.
struct Trial {
  std::uint64_t n_windows = 0;
  double cells = 0;                 // with four valid samples
  double triangles = 0;             // of the result, with no seams between windows
  double first_triangles = 0;       // of round 0, with seams
  double most_start_triangles = 0;  // of a window, before simplification
  double seconds = 0;               // of one thread, for all rounds
};

/// Compresses the windows one by one. Throws Interrupted when progress (stage "plan") says so.
Trial try_windows(const HeightField& field, const GridFrame& frame, const std::vector<GridRect>& windows,
                  const RoundsOptions& options, const Progress& progress);

}  // namespace tinsmith
