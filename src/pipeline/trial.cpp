#include "pipeline/trial.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "pipeline/typical_area.hpp"
#include "pipeline/workload.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

// Of rows, and columns in each: 9 windows; where that is little beside the whole, up to 25.
std::size_t n_bands(std::size_t n_windows) {
  constexpr double kShare = 8;  // a band for so many windows along a side
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(static_cast<double>(n_windows)) / kShare), 3,
                                 5);
}

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Box {
  double left = std::numeric_limits<double>::infinity();
  double right = -left;
  double top = left;
  double bottom = -left;

  void add(LatticePoint p) {
    left = std::min(left, static_cast<double>(p.x) / kLatticePerCell);
    right = std::max(right, static_cast<double>(p.x) / kLatticePerCell);
    top = std::min(top, static_cast<double>(p.y) / kLatticePerCell);
    bottom = std::max(bottom, static_cast<double>(p.y) / kLatticePerCell);
  }
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

Box box_of(const Chunk& chunk, const std::array<std::int32_t, 3>& triangle) {
  Box box;
  for (const std::int32_t v : triangle) box.add(chunk.position[at(v)]);
  return box;
}

// Triangles that no seam has a part in.
std::vector<std::array<std::int32_t, 3>> inside_of(const Chunk& chunk) {
  std::vector<std::array<std::int32_t, 3>> inside;
  for (const auto& triangle : chunk.triangles)
    if (std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t v) { return chunk.is_settled[at(v)]; }))
      inside.push_back(triangle);
  return inside;
}

// How many triangles there were without seams. A triangle with a box of w x h is found inside a box of W x H,
// wherever seams happen to be, in (W - w) (H - h) places: each stands for as many as that is rarer than its window.
double triangles_without_seams(const Chunk& chunk, const GridRect& window) {
  constexpr std::size_t kFewest = 10;
  constexpr double kRarest = 1.0 / 8;  // along each side
  const double all = static_cast<double>(chunk.triangles.size());
  const auto inside = inside_of(chunk);
  if (inside.size() < kFewest) return all;
  Box room;
  for (const auto& triangle : inside)
    for (const std::int32_t v : triangle) room.add(chunk.position[at(v)]);
  double triangles = 0;
  for (const auto& triangle : inside) {
    const Box box = box_of(chunk, triangle);
    triangles += (window.width - 1) / std::max(room.width() - box.width(), kRarest * window.width) *
                 (window.height - 1) / std::max(room.height() - box.height(), kRarest * window.height);
  }
  return std::min(triangles, all);
}

}  // namespace

std::vector<std::int64_t> windows_with_samples(const HeightField& field, const WindowGraph& graph) {
  std::vector<std::int64_t> windows;
  for (std::int64_t w = 0; w < graph.windows(0).count(); ++w)
    if (!field.is_surely_void(graph.samples({0, w}))) windows.push_back(w);
  return windows;
}

// Bands of rows with as many windows each; of each band the windows in the middle of as many parts of its columns.
std::vector<std::int64_t> spread_out(std::vector<std::int64_t> windows, std::int64_t columns) {
  const std::size_t bands = n_bands(windows.size());
  if (windows.size() <= bands * bands) return windows;
  const auto is_left_of = [columns](std::int64_t a, std::int64_t b) {
    return std::pair(a % columns, a) < std::pair(b % columns, b);
  };
  std::vector<std::int64_t> chosen;
  for (std::size_t band = 0; band < bands; ++band) {
    const std::size_t first = band * windows.size() / bands;
    const std::size_t last = (band + 1) * windows.size() / bands;
    const auto begin = windows.begin();
    std::sort(begin + static_cast<std::ptrdiff_t>(first), begin + static_cast<std::ptrdiff_t>(last), is_left_of);
    for (std::size_t part = 0; part < bands; ++part)
      chosen.push_back(windows[first + (2 * part + 1) * (last - first) / (2 * bands)]);
  }
  return chosen;
}

Trial try_windows(const HeightField& field, const GridFrame& frame, const std::vector<GridRect>& windows,
                  const RoundsOptions& options, const Progress& progress) {
  Trial trial;
  const auto start = std::chrono::steady_clock::now();
  const double area = typical_area(field, options.tolerance);
  for (const GridRect& window : windows) {
    const FirstChunk result =
        first_chunk(field, window, window_options(frame, window, options, area), options.colours);
    trial.triangles += triangles_without_seams(result.chunk, window);
    trial.cells += static_cast<double>(result.valid_cells);
    trial.first_triangles += static_cast<double>(result.chunk.triangles.size());
    trial.most_start_triangles = std::max(trial.most_start_triangles, static_cast<double>(result.start_triangles));
    ++trial.n_windows;
    if (progress && !progress(static_cast<double>(trial.n_windows) / static_cast<double>(windows.size()), "plan"))
      throw Interrupted("interrupted; nothing was written");
  }
  trial.seconds = seconds_since(start) / kRoundShare[0];
  return trial;
}

}  // namespace tinsmith
