#pragma once
// The places where a surface and the input are farthest from each other, brought nearer one by one. A fit brings
// the many that are off a little nearer; the few that are off most need vertices of their own.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simplify/fit_samples.hpp"
#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// So many vertices a simplification from n to a target of triangles should keep back for the places that are
/// farthest off in the end; each brings two triangles. More of them where values draw vertices to where they change
/// most.
double n_kept_back(double n_triangles, double target, bool is_drawn_by_values);

/// Where samples lie on a surface.
struct NearestTriangles {
  std::vector<std::int32_t>& triangle;  // by sample: the first halfedge of that with the nearest point; kNone: none
  std::vector<float>& squared;          // by sample: its squared distance
};

/// How much may be done: triangles that are added, and steps of vertices that come nearer.
struct FarthestLimits {
  std::size_t n_triangles;
  std::size_t n_steps;
};

struct AddedVertex {
  std::int32_t vertex;
  std::int32_t below;  // the first halfedge of the input's triangle that is nearest
};

/// Goes from the farthest place to the next, within the limits: a sample of the input, or the middle of an edge,
/// gets a vertex on the input (of those that are gone, with two triangles, at a border one); a vertex comes a
/// little nearer to the input. Only what brings the place nearer and nothing around it as far off is done; what
/// can't be, stays. No triangle turns over, nor away from a neighbour; vertices on lines come to lines only.
/// Samples around have the nearest of the triangles there afterwards. Returns what was added.
std::vector<AddedVertex> bring_in_farthest(SurfaceMesh& mesh, WedgeValues& values, const FitSamples& samples,
                                           const NearestTriangles& nearest, const FarthestLimits& limits);

}  // namespace tinsmith
