#pragma once
// The colours of a mesh against those of the samples.

#include <span>

#include "judge/blocked_mesh.hpp"
#include "judge/measure.hpp"

namespace tinsmith {

/// A block's triangles, with the colours of their corners in the same order.
struct ColouredFacets {
  std::span<const Facet> facets;
  std::span<const FacetColours> colours;
};

/// The channels that a mesh has of a field's: red, green and blue for one (grey, in all of them) and three; alpha
/// too for two and four.
constexpr std::size_t n_mesh_channels(int n_channels) { return n_channels % 2 == 1 ? 3 : 4; }

/// Adds the differences at all valid samples in or on a triangle that have a colour, channel by channel of the
/// mesh. Where several triangles have a sample, a channel's largest difference counts. samples.colours is there.
void measure_colours(const GridRect& rect, const ColouredFacets& mesh, const Samples& samples, Findings& findings);

}  // namespace tinsmith
