#pragma once
// The outline of what a window covers: the union of its valid cells.

#include <vector>

#include "geometry/lattice.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// A straight piece of the outline, in samples (not lattice units), from the smaller to the larger coordinate.
/// It ends where the outline turns and where what lies on either side changes, so that the two windows along a
/// seam see the same pieces of it.
struct OutlinePiece {
  LatticePoint a;
  LatticePoint b;
};

/// All pieces of the outline of the valid cells of a window (rect in samples). `samples` must reach one sample
/// beyond the window on each side.
std::vector<OutlinePiece> outline_of(const HeightGrid& samples, const GridRect& window);

/// Whether all cells of the window are valid.
bool is_full(const HeightGrid& samples, const GridRect& window);

}  // namespace tinsmith
