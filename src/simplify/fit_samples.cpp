#include "simplify/fit_samples.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::int32_t only_wedge(const SurfaceMesh& mesh, std::int32_t v) {
  const std::int32_t wedge = mesh.wedge[at(mesh.out[at(v)])];
  bool is_only = true;
  for_each_out(mesh, v, [&](std::int32_t h) { is_only = is_only && mesh.wedge[at(h)] == wedge; });
  return is_only ? wedge : kNone;
}

}  // namespace

void follow_collapses(const SurfaceMesh& mesh, FitSamples& samples) {
  for (std::int32_t& v : samples.vertex) {
    while (!mesh.is_alive(v) && samples.vertex[at(v)] != v) v = samples.vertex[at(v)];
  }
}

FitSamples fit_samples(const SurfaceMesh& mesh, const WedgeValues& values, const SimplifySurfaceOptions& options) {
  FitSamples samples;
  const std::size_t n_samples = mesh.position.size() + mesh.original_triangle.size();
  samples.place.reserve(n_samples);
  samples.weight.reserve(n_samples);
  samples.vertex.reserve(n_samples);
  samples.place = mesh.position;
  samples.triangles = mesh;
  samples.weight.assign(mesh.position.size(), 0);
  samples.vertex.resize(mesh.position.size());
  for (std::size_t v = 0; v < samples.vertex.size(); ++v) samples.vertex[v] = static_cast<std::int32_t>(v);
  samples.wedge.reserve(mesh.position.size());
  for (const std::int32_t v : samples.vertex) samples.wedge.push_back(only_wedge(mesh, v));
  // Exact for the squares of linear functions: a twelfth of the triangle at each corner, the rest in the middle.
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    const auto twelfth = static_cast<float>(triangle_weight(mesh, h, options.area_weights) / 12);
    const auto [a, b, c] = corners_of(mesh, h);
    for (std::int32_t k = 0; k < 3; ++k) samples.weight[at(mesh.origin[at(h + k)])] += twelfth;
    constexpr double kThird = 1.0 / 3;
    samples.place.push_back(
        {(a[0] + b[0] + c[0]) * kThird, (a[1] + b[1] + c[1]) * kThird, (a[2] + b[2] + c[2]) * kThird});
    samples.weight.push_back(9 * twelfth);
    samples.vertex.push_back(mesh.origin[at(h)]);
  }
  if (values.n_components == 0 || !attributes_count(options)) return samples;
  samples.values.reserve(mesh.position.size() * values.n_components);
  for (const std::int32_t h : mesh.out) {
    for (const double x : values.of(mesh.wedge[at(h)])) samples.values.push_back(static_cast<float>(x));
  }
  samples.has_values.reserve(mesh.kind.size());
  for (const SurfaceVertexKind kind : mesh.kind)
    samples.has_values.push_back(kind == SurfaceVertexKind::kInterior ? 1 : 0);
  return samples;
}

}  // namespace tinsmith
