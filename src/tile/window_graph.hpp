#pragma once
// Which windows of one round the windows of the next depend on: the order of the work, known from sizes alone.

#include <array>
#include <cstdint>
#include <vector>

#include "samples/height_grid.hpp"
#include "tile/windows.hpp"

namespace tinsmith {

/// A window task by its name.
struct WindowName {
  int round = 0;
  std::int64_t window = 0;

  friend bool operator==(WindowName, WindowName) = default;
};

/// A block of windows of one round.
struct WindowSpan {
  std::int64_t first_column = 0;
  std::int64_t last_column = -1;
  std::int64_t first_row = 0;
  std::int64_t last_row = -1;
  std::int64_t columns = 0;  // of the round's grid

  std::int64_t count() const { return (last_column - first_column + 1) * (last_row - first_row + 1); }

  /// Calls f for the numbers of the windows, ascending.
  template <class F>
  void for_each(F&& f) const {
    for (std::int64_t row = first_row; row <= last_row; ++row) {
      for (std::int64_t column = first_column; column <= last_column; ++column) f(row * columns + column);
    }
  }
};

/// The rounds over a field of width x height samples in windows of `side` cells. A chunk of round 0 lies within
/// its window. A window of a later round gets the triangles whose centroids it holds, and its chunk covers what
/// they cover: it reaches as far as the chunks that they come from, two windows' sides beyond its own at most.
class WindowGraph {
 public:
  WindowGraph(std::int32_t width, std::int32_t height, std::int32_t side);

  /// One when a single window holds all, else kRounds.
  int n_rounds() const { return n_rounds_; }
  int last_round() const { return n_rounds_ - 1; }
  const WindowGrid& windows(int round) const { return grids_[static_cast<std::size_t>(round)]; }

  /// The samples of a window, its border samples included.
  GridRect samples(WindowName name) const;

  /// The windows of the round before that may hold triangles of this window; none for round 0.
  WindowSpan inputs(WindowName name) const;

  /// The windows of the round after that may get triangles of this window; none for the last round.
  WindowSpan readers(WindowName name) const;

  /// The first row of samples that chunks of this row of windows of the last round may reach.
  std::int64_t first_row_reached(std::int64_t window_row) const;

 private:
  // Along one axis: windows in cells, and windows by their numbers.
  struct Range {
    std::int64_t low = 0;
    std::int64_t high = -1;
  };
  struct Axis {
    std::vector<Range> reached;  // in cells, by window
    std::vector<Range> inputs;
    std::vector<Range> readers;
  };
  Range held(int round, std::int64_t i) const;
  Axis axis(int round, std::int64_t n_windows, const Axis& before) const;

  std::int32_t width_;
  std::int32_t height_;
  std::int64_t side_;
  int n_rounds_;
  std::array<WindowGrid, kRounds> grids_;
  std::array<Axis, kRounds> columns_;
  std::array<Axis, kRounds> rows_;
};

}  // namespace tinsmith
