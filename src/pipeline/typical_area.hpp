#pragma once
// How large most triangles of a surface are.

#include "samples/height_grid.hpp"

namespace tinsmith {

/// The geometric mean of the areas, in cells, of the triangles of a right-triangulated hierarchy within the
/// tolerance, over blocks of samples that are spread over the field. Infinity where they hold no samples. Tells the
/// same for every window, and where some parts of the terrain are far rougher than others it tells of these, since
/// most triangles are there. Throws InputError when samples can't be read.
double typical_area(const HeightField& field, double tolerance);

}  // namespace tinsmith
