#pragma once
// How the triangles of a mesh hang together, by their indices alone and then in plan.

#include <cstdint>
#include <vector>

#include "judge/plan_mesh.hpp"
#include "tinsmith/certificate.hpp"

namespace tinsmith {

/// A border edge runs from corner `corner % 3` of triangle `corner / 3` to the next corner.
using BorderEdges = std::vector<std::uint32_t>;

/// Fills non_manifold_edges, non_manifold_vertices and components; gives the edges of one triangle only, by
/// their lower vertex. Throws ResourceError beyond 2^32 / 3 triangles.
BorderEdges measure_topology(const PlanMesh& mesh, Certificate& certificate);

/// Fills t_junctions and unwelded_edges.
void measure_border(const PlanMesh& mesh, const BorderEdges& border, Certificate& certificate);

}  // namespace tinsmith
