#pragma once
// What the vertices of a window's mesh may do, found from the mesh and the samples alone.

#include "mesh/window_mesh.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// Sets the kinds. A border edge that runs along a row or column of samples with an invalid cell on its outer
/// side is outline; any other border edge is a seam: beyond it lie triangles of another window. A vertex on a
/// seam is locked, and so is a pinch of the outline; one on the outline is a corner where the outline turns,
/// else border. Vertices that connect() found to have several fans stay locked.
/// `samples` must reach one sample beyond the mesh on each side.
void set_kinds(WindowMesh& mesh, const HeightGrid& samples);

}  // namespace tinsmith
