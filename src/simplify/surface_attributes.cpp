#include "simplify/surface_attributes.hpp"

#include <algorithm>
#include <cmath>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Attribute vectors closer than that are the same (eq. 28): half a step of 8 bits.
constexpr double kSameValue = 1.0 / 512;

AttributeField field_of(const SurfaceMesh& mesh, const SurfaceAttribute& attribute) {
  AttributeField field{attribute.kind, {}, std::vector<Quadric<3>>(mesh.original_vertex.size())};
  field.value.reserve(mesh.original_vertex.size());
  for (const std::uint32_t v : mesh.original_vertex) {
    const float* values = attribute.values.data() + 3 * static_cast<std::size_t>(v);
    field.value.push_back({values[0], values[1], values[2]});
  }
  return field;
}

// Adds the quadric of each triangle's flat in attribute space to its three wedges: a plane, a line, or a point
// where the three values don't span more.
void sum_quadrics(const SurfaceMesh& mesh, AttributeField& field, bool area_weights) {
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    const std::array<std::int32_t, 3> wedges{mesh.wedge[at(h)], mesh.wedge[at(h + 1)], mesh.wedge[at(h + 2)]};
    const Vec<3>& p = field.value[at(wedges[0])];
    const auto [e1, e2] = directions_of(p, field.value[at(wedges[1])], field.value[at(wedges[2])], kSameValue);
    Quadric<3> quadric;
    quadric.add_flat(p, e1, e2, triangle_weight(mesh, h, area_weights));
    for (const std::int32_t w : wedges) field.quadric[at(w)] += quadric;
  }
}

}  // namespace

double triangle_weight(const SurfaceMesh& mesh, std::int32_t h, bool area_weights) {
  if (!area_weights) return 1;
  const Vec<3>& a = mesh.position[at(mesh.origin[at(h)])];
  const Vec<3> ab = mesh.position[at(mesh.destination(h))] - a;
  const Vec<3> n = cross(ab, mesh.position[at(mesh.origin[at(Halfedges::previous(h))])] - a);
  return std::sqrt(dot(n, n)) / 2;
}

SurfaceAttributes attributes_of(const SurfaceMesh& mesh, const Surface& surface, bool area_weights) {
  SurfaceAttributes result;
  for (const SurfaceAttribute& attribute : surface.attributes) {
    if (attribute.kind == AttributeKind::kScalar) {
      ScalarField scalar{attribute.name, {}};
      for (const std::uint32_t v : mesh.original_vertex) scalar.value.push_back(attribute.values[v]);
      result.scalars.push_back(std::move(scalar));
    } else {
      result.fields.push_back(field_of(mesh, attribute));
      sum_quadrics(mesh, result.fields.back(), area_weights);
    }
  }
  return result;
}

Vec<3> best_value(const Quadric<3>& quadric, const Vec<3>& between, AttributeKind kind) {
  constexpr double kDraw = 1e-3;
  using Q = Quadric<3>;
  Q drawn = quadric;
  const double trace = quadric.q[Q::a(0, 0)] + quadric.q[Q::a(1, 1)] + quadric.q[Q::a(2, 2)];
  drawn.add_point(between, kDraw * trace);
  Vec<3> r;
  for (std::size_t i = 0; i < 3; ++i) r[i] = -drawn.q[Q::b(i)];
  Vec<3> value = between;
  if (!solve(drawn, r, 1e-9, value)) value = between;
  if (kind == AttributeKind::kColour) {
    for (double& x : value) x = std::clamp(x, 0.0, 1.0);
    return value;
  }
  const double length = std::sqrt(dot(value, value));
  if (!(length > 1e-12)) return between;
  for (double& x : value) x /= length;
  return value;
}

}  // namespace tinsmith
