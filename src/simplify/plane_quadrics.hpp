#pragma once
// The paper's steps 2 and 3: quadrics of triangles and of feature edges, summed at vertices.

#include <vector>

#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// By vertex: the planes of its triangles, and at features those that stand on its edges. Without triangles when
/// another quadric holds theirs.
std::vector<Quadric<3>> plane_quadrics(const SurfaceMesh& mesh, bool with_triangles, bool area_weights);

}  // namespace tinsmith
