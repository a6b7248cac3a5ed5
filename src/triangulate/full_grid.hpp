#pragma once
// Every sample a vertex: the start that loses neither height nor colour.

#include "mesh/window_mesh.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// Two triangles for each valid cell of the window, cut along the diagonal that differs less in height. Kinds are
/// not set. `samples` must hold the window. A window without a valid cell gives an empty mesh.
WindowMesh full_grid(const HeightGrid& samples, const GridRect& window);

}  // namespace tinsmith
