#pragma once
// Small steps that lower the squared error of the surface and keep its triangles as many as they are: what was
// refused before may be legal after them (DESIGN section 4, vertex moves and flips).

#include <cstdint>
#include <vector>

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
  const ColourGrid* colours = nullptr;  // none: height alone counts
  double squared_height_per_level = 0;  // what a squared colour error weighs beside a squared vertical one
};

/// Moves a vertex by the Gauss-Newton step of the squared vertical error over the samples of its star, half a mean
/// edge at most, or by less of it, or in height only, whichever lowers the squared error (of height and colour)
/// first; locked ones stay, corners stay in plan, borders slide. `star` is scratch. Returns whether the vertex has
/// moved.
bool improve_vertex(WindowMesh& mesh, const RefineBound& bound, std::int32_t v, Star& star);

/// Flips the edge of h when that lowers the squared error over the samples of its two triangles. Returns whether it
/// did. `squared_error` remembers the vertical one by triangle: not a number where it is not known.
bool improve_edge(WindowMesh& mesh, const RefineBound& bound, std::int32_t h, std::vector<float>& squared_error);

}  // namespace tinsmith
