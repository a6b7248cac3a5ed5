#include "simplify/surface_attributes.hpp"

#include <algorithm>
#include <cmath>

#include "simplify/surface_limits.hpp"

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

// A surface whose edges are longer by a factor is off by the square of it, and its values, where they jump, are
// wrong on an area that grows with it: of the squared errors the ratio is its cube. Of a checkered bunny at 20, 5
// and 1 % the colours' error, as a multiple of that of geometry alone, is 0.65, 0.71 and 0.90 at 1.07, 1.04
// and 1.06 times the RMS distance; with the weight below it is 0.65, 0.82 and 0.94. While the collapse goes on it
// may get less: see balanced_weight().
constexpr double kWeightByCubedLength = 0.22;
// Of combined quadrics, which can't make jumps less steep: with the above, distances are up to 1.26 times. And
// where the length is not known; a fifth of the triangles of a scan have about that.
constexpr double kWeightBesideGeometry = 3e-7;

bool attributes_count(const SimplifySurfaceOptions& options) { return options.attribute_weight != 0.0; }

double attribute_weight(const SurfaceMesh& mesh, const SimplifySurfaceOptions& options) {
  if (options.attribute_weight) return *options.attribute_weight;
  const double length = length_in_result(mesh, options);
  switch (options.quadric) {
    case QuadricForm::kSeparate:
      return 1;
    case QuadricForm::kCombined:
      return kWeightBesideGeometry;
    case QuadricForm::kGradient:
      return length > 0 ? kWeightByCubedLength * length * length * length : kWeightBesideGeometry;
  }
  return 1;
}

double length_in_result(const SurfaceMesh& mesh, const SimplifySurfaceOptions& options) {
  const std::size_t n_triangles = mesh.original_triangle.size();
  const double target = target_of(options, n_triangles);
  if (!(target > 0)) return 0;
  const auto n = static_cast<double>(n_triangles);
  return std::sqrt(mesh.mean_area * n / std::min(n, target));
}

double triangle_weight(const SurfaceMesh& mesh, std::int32_t h, bool area_weights) {
  return area_weights ? triangle_area(mesh, h) + kMeanAreas * mesh.mean_area : 1;
}

}  // namespace tinsmith
