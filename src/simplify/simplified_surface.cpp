#include <algorithm>

#include "simplify/simplified_mesh.hpp"
#include "tinsmith/simplify.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Of the corner at the origin of h, in the input's coordinates; what has not moved is the input's to the bit.
Vec<3> place_of(const SurfaceMesh& mesh, const Surface& input, std::int32_t h) {
  const Vec<3>& p = mesh.position[at(mesh.origin[at(h)])];
  const Vec<3>& before = input.position[mesh.original_vertex[at(mesh.wedge[at(h)])]];
  if (scaled(mesh, before) == p) return before;
  return {p[0] * mesh.extent + mesh.middle[0], p[1] * mesh.extent + mesh.middle[1],
          p[2] * mesh.extent + mesh.middle[2]};
}

// The first halfedges of the triangles that are left, in the input's order.
std::vector<std::int32_t> in_input_order(const SurfaceMesh& mesh) {
  std::vector<std::int32_t> order(mesh.original_triangle.size(), kNone);
  for (std::size_t t = 0; t < order.size(); ++t) {
    const auto h = static_cast<std::int32_t>(3 * t);
    if (mesh.origin[at(h)] != kNone) order[mesh.original_triangle[t]] = h;
  }
  order.erase(std::remove(order.begin(), order.end(), kNone), order.end());
  return order;
}

Surface surface_of(const SurfaceMesh& mesh, const WedgeValues& values, const Surface& input) {
  Surface result;
  std::vector<std::int32_t> name(mesh.original_vertex.size(), kNone);
  std::vector<std::int32_t> wedges;
  for (const std::int32_t h : in_input_order(mesh)) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::int32_t k = 0; k < 3; ++k) {
      const std::int32_t w = mesh.wedge[at(h + k)];
      if (name[at(w)] == kNone) {
        name[at(w)] = static_cast<std::int32_t>(wedges.size());
        wedges.push_back(w);
        result.position.push_back(place_of(mesh, input, h + k));
      }
      triangle[at(k)] = static_cast<std::uint32_t>(name[at(w)]);
    }
    result.triangles.push_back(triangle);
  }
  for (std::size_t i = 0; i < values.blocks.size(); ++i) {
    const WedgeValues::Block& block = values.blocks[i];
    SurfaceAttribute out{block.kind, input.attributes[i].name, {}};
    for (const std::int32_t w : wedges) {
      const auto n = static_cast<std::size_t>(out.components());
      for (const double x : values.of(w).subspan(block.offset, n))
        out.values.push_back(static_cast<float>(block.lowest + block.range * x));
    }
    result.attributes.push_back(std::move(out));
  }
  return result;
}

}  // namespace

Surface simplify_surface(const Surface& surface, const SimplifySurfaceOptions& options,
                         SimplifySurfaceReport& report) {
  WedgeValues values;
  const SurfaceMesh mesh = simplified_mesh(surface, options, report, values, nullptr);
  return surface_of(mesh, values, surface);
}

}  // namespace tinsmith
