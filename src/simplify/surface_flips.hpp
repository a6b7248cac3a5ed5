#pragma once
// Edges of a surface that follow the input better as the other diagonal of their two triangles.

#include <cstdint>
#include <functional>
#include <vector>

#include "simplify/surface_mesh.hpp"
#include "simplify/surface_values.hpp"

namespace tinsmith {

/// How far the values of a sample are from those at a place of the surface, beside a distance to the power 2.5.
using ValueError = std::function<double(std::size_t sample, const PlaceInTriangle& place)>;

/// Samples of the input, each with the triangle of the surface that is nearest.
struct SurfaceSamples {
  const std::vector<Vec<3>>& place;
  const std::vector<float>& weight;
  const std::vector<std::int32_t>& triangle;  // its first halfedge; kNone: none
  const std::vector<float>& squared;          // the distance to it
  ValueError value_error = {};                // none: only distances count
};

/// Whether a place of the surface is too far from the input, or the normal there (of any length) turned away from
/// the input's; the vertex v lies nearby.
using IsAstray = std::function<bool(const Vec<3>& place, const Vec<3>& normal, std::int32_t v)>;

/// Flips edges where that brings the samples of their two triangles nearer: by the sum of the distances to the
/// power 2.5 and the values' errors, with the weights. Features and seams stay, no edge gets normals more than 90
/// degrees apart that had them not, and triangles get neither thin nor go astray. A triangle takes part in one flip
/// at most.
void flip_nearer(SurfaceMesh& mesh, const SurfaceSamples& samples, const IsAstray& is_astray);

}  // namespace tinsmith
