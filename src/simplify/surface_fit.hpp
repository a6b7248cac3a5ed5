#pragma once
// The last step of a simplification in space: its vertices, and what they carry, move to where they fit the input's
// best in the least-squares sense. Quadrics know planes without an end; this knows where the surface is.

#include <cstdint>
#include <vector>

#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// A surface before its simplification: its vertices, and after them the middles of its triangles.
struct FitSamples {
  std::vector<Vec<3>> place;
  Halfedges triangles;               // over the vertices
  std::vector<float> weight;         // by the areas around it
  std::vector<float> values;         // of the vertices, n_components each; empty: only places are fitted
  std::vector<std::int32_t> vertex;  // near which it lies: of the one that goes in a collapse, the one that stays
};

/// With values when they have a weight.
FitSamples fit_samples(const SurfaceMesh& mesh, const WedgeValues& values, const SimplifySurfaceOptions& options);

/// Moves interior vertices, and then changes their values, so that the samples are nearer to the surface, and their
/// values to those there. Where a sample got farther off than any was before, or a triangle farther from the input,
/// the vertices are drawn back half of the way. Where the vertices may move, edges may flip. No triangle turns
/// over, nor away from a neighbour; lines, borders and seams stay.
void fit(SurfaceMesh& mesh, WedgeValues& values, FitSamples& samples, bool may_flip);

}  // namespace tinsmith
