#pragma once
// A surface before its simplification, as samples that the result is fitted to.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// The input's vertices, and after them the middles of its triangles.
struct FitSamples {
  std::vector<Vec<3>> place;
  Halfedges triangles;               // over the vertices
  std::vector<float> weight;         // by the areas around it
  std::vector<std::int32_t> vertex;  // near which it lies: of the one that goes in a collapse, the one that stays
  std::vector<std::int32_t> wedge;   // by vertex: its only one; kNone: a seam passes
  // Of the vertices, n_components each; empty: only places are fitted.
  std::vector<float> values;
  std::vector<std::uint8_t> has_values;  // by vertex: not on lines and seams, where there may be several

  bool is_valued(std::size_t sample) const { return sample < has_values.size() && has_values[sample] != 0; }
};

/// Lets the samples near vertices that are gone lie near those that they became.
void follow_collapses(const SurfaceMesh& mesh, FitSamples& samples);

/// With values when they have a weight.
FitSamples fit_samples(const SurfaceMesh& mesh, const WedgeValues& values, const SimplifySurfaceOptions& options);

}  // namespace tinsmith
