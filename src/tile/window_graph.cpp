#include "tile/window_graph.hpp"

#include <algorithm>
#include <limits>

namespace tinsmith {

namespace {

// No chunk reaches farther than two sides beyond its window.
constexpr std::int64_t kFarthest = 4;

}  // namespace

WindowGraph::WindowGraph(std::int32_t width, std::int32_t height, std::int32_t side)
    : width_(width), height_(height), side_(side) {
  for (int round = 0; round < kRounds; ++round)
    grids_[static_cast<std::size_t>(round)] = window_grid(width, height, side, round);
  n_rounds_ = grids_[0].count() > 1 ? kRounds : 1;
}

GridRect WindowGraph::samples(WindowName name) const {
  return windows(name.round).samples(name.window, width_, height_);
}

// Along one axis, in cells: what window i holds, and what its chunk may reach.
WindowGraph::Range WindowGraph::held(int round, std::int64_t i) const {
  const std::int64_t shift = windows(round).shift_x;  // the same along both axes
  return {i * side_ - shift, (i + 1) * side_ - shift};
}

WindowGraph::Range WindowGraph::reached(int round, std::int64_t i) const {
  if (round == 0) return held(0, i);
  const Range inputs = inputs_along(round, i, std::numeric_limits<std::int64_t>::max());
  return {reached(round - 1, inputs.low).low, reached(round - 1, inputs.high).high};
}

// A triangle has an area: its centroid lies inside of what its chunk reaches, not on the rim.
WindowGraph::Range WindowGraph::inputs_along(int round, std::int64_t i, std::int64_t n_inputs) const {
  const Range own = held(round, i);
  Range found{i + kFarthest, i - kFarthest};
  for (std::int64_t j = i - kFarthest; j <= i + kFarthest; ++j) {
    const Range reach = reached(round - 1, j);
    if (reach.low >= own.high || reach.high <= own.low) continue;
    found = {std::min(found.low, j), std::max(found.high, j)};
  }
  if (n_inputs == std::numeric_limits<std::int64_t>::max()) return found;
  return {std::max<std::int64_t>(found.low, 0), std::min(found.high, n_inputs - 1)};
}

WindowGraph::Range WindowGraph::readers_along(int round, std::int64_t i, std::int64_t n_inputs,
                                              std::int64_t n_readers) const {
  Range found{n_readers, -1};
  for (std::int64_t j = std::max<std::int64_t>(i - kFarthest, 0); j <= std::min(i + kFarthest, n_readers - 1);
       ++j) {
    const Range inputs = inputs_along(round + 1, j, n_inputs);
    if (i < inputs.low || i > inputs.high) continue;
    found = {std::min(found.low, j), std::max(found.high, j)};
  }
  return found;
}

WindowSpan WindowGraph::inputs(WindowName name) const {
  if (name.round == 0) return {};
  const WindowGrid& own = windows(name.round);
  const WindowGrid& before = windows(name.round - 1);
  const Range columns = inputs_along(name.round, name.window % own.columns, before.columns);
  const Range rows = inputs_along(name.round, name.window / own.columns, before.rows);
  return {columns.low, columns.high, rows.low, rows.high, before.columns};
}

WindowSpan WindowGraph::readers(WindowName name) const {
  if (name.round == last_round()) return {};
  const WindowGrid& own = windows(name.round);
  const WindowGrid& after = windows(name.round + 1);
  const Range columns = readers_along(name.round, name.window % own.columns, own.columns, after.columns);
  const Range rows = readers_along(name.round, name.window / own.columns, own.rows, after.rows);
  return {columns.low, columns.high, rows.low, rows.high, after.columns};
}

std::int64_t WindowGraph::first_row_reached(std::int64_t window_row) const {
  return reached(last_round(), window_row).low;
}

}  // namespace tinsmith
