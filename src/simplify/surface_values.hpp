#pragma once
// Values in the last step of a simplification: how far the surface's are from those of the samples, where that
// draws its vertices, and how they follow.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simplify/fit_samples.hpp"
#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"
#include "simplify/surface_walk.hpp"

namespace tinsmith {

/// A surface with its values, and the samples that it is fitted to, which have values.
struct ValuedSurface {
  const SurfaceMesh& mesh;
  WedgeValues& values;
  const FitSamples& samples;
};

/// The wedges of a triangle's corners, and the shares that they have in a place there.
struct PlaceInTriangle {
  std::array<std::int32_t, 3> wedge{};
  Vec<3> share{};
};
PlaceInTriangle place_in(const SurfaceMesh& mesh, const Nearest& there);

/// Of the values of a sample and those at the place, summed over the components.
double squared_difference(const ValuedSurface& surface, std::size_t sample, const PlaceInTriangle& place);

/// Adds to the quadrics of the steps of three vertices what brings the values at `there`, between them, nearer to
/// those of the sample, which counts by `weight`.
void pull_by_values(const ValuedSurface& surface, std::size_t sample, const Nearest& there, double weight,
                    std::vector<Quadric<3>>& pulls);

/// Changes the values of interior vertices so that those of the samples, of which each lies near the triangle given
/// for it (its first halfedge; kNone: none), are nearer in the least-squares sense. Seams, and lines, stay.
void fit_values(const ValuedSurface& surface, const std::vector<std::int32_t>& triangle);

/// Means over the samples with values, by their weights.
struct SurfaceErrors {
  double squared_distance = 0;
  double squared_difference = 0;  // of values, summed over the components
};
SurfaceErrors errors_of(const ValuedSurface& surface);

/// RMS, in the values' range: what is off by less is hardly seen.
constexpr double kSmallDifference = 0.03;

/// The usual weight, or less where values are so smooth that with so many times fewer triangles they will hardly be
/// off. The surface is still the input.
double seen_weight(double usual, const ValuedSurface& input, double times_fewer);

/// The weight that values have in a collapse to so many times fewer triangles than the surface with these errors
/// has: the usual one, or less where the shape will be off by less.
double balanced_weight(double usual, const SurfaceErrors& errors, double times_fewer);

/// Calls found(sample, nearest) for the samples with values that lie anywhere.
template <class Found>
void for_each_valued(const ValuedSurface& surface, const std::vector<std::int32_t>& triangle, Found&& found) {
  const FitSamples& samples = surface.samples;
  const WalkedSurface walked{surface.mesh, surface.mesh.position};
  for (std::size_t i = 0; i < samples.has_values.size(); ++i) {
    if (!samples.is_valued(i) || !surface.mesh.is_alive(samples.vertex[i])) continue;
    const Nearest there = nearest(walked, samples.place[i], triangle[i], samples.vertex[i]);
    if (there.halfedge != kNone) found(i, there);
  }
}

}  // namespace tinsmith
