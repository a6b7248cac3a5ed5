#pragma once
// The last step of a simplification in space: its vertices, and what they carry, move to where they fit the input's
// best in the least-squares sense. Quadrics know planes without an end; this knows where the surface is.

#include <cstddef>

#include "simplify/fit_samples.hpp"
#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// Moves interior vertices and changes their values, so that the samples are nearer to the surface, and their
/// values to those there. Where a sample got farther off than any was before, or a triangle farther from the input,
/// the vertices are drawn back half of the way. Then vertices are added, with up to n_triangles, see
/// bring_in_farthest(), and those that are farthest come nearer, on lines too. Where the vertices may move, edges
/// may flip. No triangle turns over, nor away from a neighbour; seams stay.
void fit(SurfaceMesh& mesh, WedgeValues& values, FitSamples& samples, bool may_flip, std::size_t n_triangles);

}  // namespace tinsmith
