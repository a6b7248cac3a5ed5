#include "simplify/surface_attributes.hpp"

#include <algorithm>
#include <cmath>

namespace tinsmith {

namespace {

WedgeValues::Block block_of(const SurfaceAttribute& attribute, std::size_t offset) {
  WedgeValues::Block block{attribute.kind, offset, 0, 1};
  if (attribute.kind != AttributeKind::kScalar || attribute.values.empty()) return block;
  const auto [lowest, highest] = std::minmax_element(attribute.values.begin(), attribute.values.end());
  block.lowest = *lowest;
  const double range = static_cast<double>(*highest) - *lowest;
  if (range > 0) block.range = range;
  return block;
}

}  // namespace

WedgeValues wedge_values(const SurfaceMesh& mesh, const Surface& surface) {
  WedgeValues all;
  for (const SurfaceAttribute& attribute : surface.attributes) {
    all.blocks.push_back(block_of(attribute, all.n_components));
    all.n_components += static_cast<std::size_t>(attribute.components());
  }
  all.values.reserve(mesh.original_vertex.size() * all.n_components);
  for (const std::uint32_t v : mesh.original_vertex) {
    for (std::size_t i = 0; i < all.blocks.size(); ++i) {
      const auto n = static_cast<std::size_t>(surface.attributes[i].components());
      for (std::size_t k = 0; k < n; ++k)
        all.values.push_back((surface.attributes[i].values[v * n + k] - all.blocks[i].lowest) /
                             all.blocks[i].range);
    }
  }
  return all;
}

void put_in_range(const WedgeValues& all, std::span<double> values) {
  for (const WedgeValues::Block& block : all.blocks) {
    if (block.kind == AttributeKind::kScalar) continue;
    const std::span<double> three = values.subspan(block.offset, 3);
    if (block.kind == AttributeKind::kColour) {
      for (double& x : three) x = std::clamp(x, 0.0, 1.0);
      continue;
    }
    const double length = std::hypot(three[0], three[1], three[2]);
    if (length > 1e-12) {
      for (double& x : three) x /= length;
    }
  }
}

// Of a bunny with a checkered or smooth colour the errors, as multiples of those of the geometry alone: with 3e-7
// the colour's is 0.76 and 0.70 at 20 %, 0.90 and 0.55 at 5 %, 0.97 and 0.47 at 1 % of the triangles, the distance
// at most 1.08. With 1e-6 the distance is 1.18, with 2e-7 the colour's 0.78 at 20 %.
constexpr double kWeightBesideGeometry = 3e-7;

double attribute_weight(const SimplifySurfaceOptions& options) {
  if (options.attribute_weight) return *options.attribute_weight;
  return options.quadric == QuadricForm::kSeparate ? 1 : kWeightBesideGeometry;
}

double triangle_weight(const SurfaceMesh& mesh, std::int32_t h, bool area_weights) {
  return area_weights ? triangle_area(mesh, h) + kMeanAreas * mesh.mean_area : 1;
}

}  // namespace tinsmith
