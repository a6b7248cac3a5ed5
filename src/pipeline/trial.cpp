#include "pipeline/trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "pipeline/workload.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

constexpr std::size_t kBands = 3;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Area in cells of the triangles that no seam has a part in, and their number.
struct Inside {
  double area = 0;
  double triangles = 0;
};

Inside inside_of(const Chunk& chunk) {
  constexpr double kTwiceAreaPerCell = 2.0 * kLatticePerCell * kLatticePerCell;
  Inside inside;
  for (const auto& [a, b, c] : chunk.triangles) {
    if (!chunk.is_settled[at(a)] || !chunk.is_settled[at(b)] || !chunk.is_settled[at(c)]) continue;
    const LatticePoint p = chunk.position[at(a)];
    const LatticePoint q = chunk.position[at(b)];
    const LatticePoint r = chunk.position[at(c)];
    const double twice = static_cast<double>(q.x - p.x) * static_cast<double>(r.y - p.y) -
                         static_cast<double>(q.y - p.y) * static_cast<double>(r.x - p.x);
    inside.area += std::abs(twice) / kTwiceAreaPerCell;
    inside.triangles += 1;
  }
  return inside;
}

}  // namespace

std::vector<std::int64_t> windows_with_samples(const HeightField& field, const WindowGraph& graph) {
  std::vector<std::int64_t> windows;
  for (std::int64_t w = 0; w < graph.windows(0).count(); ++w)
    if (!field.is_surely_void(graph.samples({0, w}))) windows.push_back(w);
  return windows;
}

// Three bands of rows with a third of the windows each; of each band the windows at a sixth, a half and five sixths
// of its columns.
std::vector<std::int64_t> spread_out(std::vector<std::int64_t> windows, std::int64_t columns) {
  if (windows.size() <= kBands * kBands) return windows;
  const auto is_left_of = [columns](std::int64_t a, std::int64_t b) {
    return std::pair(a % columns, a) < std::pair(b % columns, b);
  };
  std::vector<std::int64_t> chosen;
  for (std::size_t band = 0; band < kBands; ++band) {
    const auto first = windows.begin() + static_cast<std::ptrdiff_t>(band * windows.size() / kBands);
    const auto last = windows.begin() + static_cast<std::ptrdiff_t>((band + 1) * windows.size() / kBands);
    std::sort(first, last, is_left_of);
    for (const std::ptrdiff_t sixths : {1, 3, 5}) chosen.push_back(*(first + sixths * (last - first) / 6));
  }
  return chosen;
}

Trial try_windows(const HeightField& field, const GridFrame& frame, const std::vector<GridRect>& windows,
                  const RoundsOptions& options, const Progress& progress) {
  Trial trial;
  Inside inside;
  const auto start = std::chrono::steady_clock::now();
  for (const GridRect& window : windows) {
    const FirstChunk result = first_chunk(field, window, window_options(frame, window, options));
    const Inside more = inside_of(result.chunk);
    inside.area += more.area;
    inside.triangles += more.triangles;
    trial.cells += static_cast<double>(result.valid_cells);
    trial.first_triangles += static_cast<double>(result.chunk.triangles.size());
    trial.most_start_triangles = std::max(trial.most_start_triangles, static_cast<double>(result.start_triangles));
    ++trial.n_windows;
    if (progress && !progress(static_cast<double>(trial.n_windows) / static_cast<double>(windows.size()), "plan"))
      throw Interrupted("interrupted; nothing was written");
  }
  trial.seconds = seconds_since(start) / kRoundShare[0];
  // Beside seams, which later rounds dissolve, triangles are small; where most of them lie there they all count.
  const bool is_inside_typical = inside.area > trial.cells / 4;
  trial.triangles = is_inside_typical ? inside.triangles / inside.area * trial.cells : trial.first_triangles;
  return trial;
}

}  // namespace tinsmith
