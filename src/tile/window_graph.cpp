#include "tile/window_graph.hpp"

#include <algorithm>

namespace tinsmith {

namespace {

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

// No chunk reaches farther than two sides beyond its window.
constexpr std::int64_t kFarthest = 4;

}  // namespace

WindowGraph::WindowGraph(std::int32_t width, std::int32_t height, std::int32_t side)
    : width_(width), height_(height), side_(side) {
  for (int round = 0; round < kRounds; ++round) grids_[at(round)] = window_grid(width, height, side, round);
  n_rounds_ = grids_[0].count() > 1 ? kRounds : 1;
  for (int round = 0; round < n_rounds_; ++round) {
    const std::size_t before = at(std::max(round - 1, 0));
    columns_[at(round)] = axis(round, windows(round).columns, columns_[before]);
    rows_[at(round)] = axis(round, windows(round).rows, rows_[before]);
    for (auto* axes : {&columns_, &rows_}) {
      if (round == 0) continue;
      auto& readers = (*axes)[before].readers;
      const auto& inputs = (*axes)[at(round)].inputs;
      for (std::int64_t i = std::ssize(inputs) - 1; i >= 0; --i) {
        for (std::int64_t j = inputs[at(i)].low; j <= inputs[at(i)].high; ++j)
          readers[at(j)] = {i, std::max(readers[at(j)].high, i)};
      }
    }
  }
}

GridRect WindowGraph::samples(WindowName name) const {
  return windows(name.round).samples(name.window, width_, height_);
}

// What window i holds along an axis, in cells.
WindowGraph::Range WindowGraph::held(int round, std::int64_t i) const {
  const std::int64_t shift = windows(round).shift_x;  // the same along both axes
  return {i * side_ - shift, (i + 1) * side_ - shift};
}

WindowGraph::Axis WindowGraph::axis(int round, std::int64_t n_windows, const Axis& before) const {
  Axis axis;
  axis.readers.resize(at(n_windows));
  for (std::int64_t i = 0; i < n_windows; ++i) {
    const Range own = held(round, i);
    if (round == 0) {
      axis.inputs.emplace_back();
      axis.reached.push_back(own);
      continue;
    }
    // A triangle has an area: its centroid lies inside of what its chunk reaches, not on the rim.
    const std::int64_t last = std::ssize(before.reached) - 1;
    Range inputs{last + 1, -1};
    for (std::int64_t j = std::max<std::int64_t>(i - kFarthest, 0); j <= std::min(i + kFarthest, last); ++j) {
      if (before.reached[at(j)].low >= own.high || before.reached[at(j)].high <= own.low) continue;
      inputs = {std::min(inputs.low, j), std::max(inputs.high, j)};
    }
    axis.inputs.push_back(inputs);
    axis.reached.push_back({before.reached[at(inputs.low)].low, before.reached[at(inputs.high)].high});
  }
  return axis;
}

WindowSpan WindowGraph::inputs(WindowName name) const {
  if (name.round == 0) return {};
  const std::int64_t n = windows(name.round).columns;
  const Range columns = columns_[at(name.round)].inputs[at(name.window % n)];
  const Range rows = rows_[at(name.round)].inputs[at(name.window / n)];
  return {columns.low, columns.high, rows.low, rows.high, windows(name.round - 1).columns};
}

WindowSpan WindowGraph::readers(WindowName name) const {
  if (name.round == last_round()) return {};
  const std::int64_t n = windows(name.round).columns;
  const Range columns = columns_[at(name.round)].readers[at(name.window % n)];
  const Range rows = rows_[at(name.round)].readers[at(name.window / n)];
  return {columns.low, columns.high, rows.low, rows.high, windows(name.round + 1).columns};
}

std::int64_t WindowGraph::first_row_reached(std::int64_t window_row) const {
  return rows_[at(last_round())].reached[at(window_row)].low;
}

}  // namespace tinsmith
