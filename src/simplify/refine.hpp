#pragma once
// Small steps that lower the squared error of the surface and keep its triangles as many as they are: what was
// refused before may be legal after them (DESIGN section 4, vertex moves and flips).

#include <cstddef>
#include <cstdint>

#include "mesh/window_mesh.hpp"
#include "samples/colour_grid.hpp"
#include "samples/height_grid.hpp"
#include "simplify/star.hpp"

namespace tinsmith {

/// What the steps measure against: every sample stays within the tolerance.
struct RefineBound {
  const HeightGrid& samples;
  double tolerance = 0;
  bool may_move = true;                 // false: vertices stay as they were placed, and only edges may change
  std::size_t directions = 8;           // in which a move is tried: 2, 4 or 8
  const ColourGrid* colours = nullptr;  // none: height alone counts
  double squared_height_per_level = 0;  // what a squared colour error weighs beside a squared vertical one
};

/// Moves a vertex to the best of a few places a quarter of its mean edge length away, or changes its height only,
/// whichever lowers the squared error (of height and colour) over the samples of its star most; locked ones stay,
/// corners stay in plan, borders slide. `star` is scratch. Returns whether the vertex has moved.
bool improve_vertex(WindowMesh& mesh, const RefineBound& bound, std::int32_t v, Star& star);

/// Flips the edge of h when that lowers the squared error over the samples of its two triangles. Returns whether
/// it did.
bool improve_edge(WindowMesh& mesh, const RefineBound& bound, std::int32_t h);

}  // namespace tinsmith
