#include "tinsmith/progressive.hpp"

#include <algorithm>
#include <numeric>

#include "simplify/simplified_mesh.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr std::uint32_t kUnnamed = 0xFFFFFFFF;

// Gives wedges and triangles their numbers in the order in which they come in.
class Names {
 public:
  Names(const SurfaceMesh& mesh, const Surface& input)
      : mesh_(mesh),
        input_(input),
        vertex_(mesh.original_vertex.size(), kUnnamed),
        triangle_(mesh.origin.size() / 3, kUnnamed) {}

  std::uint32_t add_vertex(std::int32_t wedge) { return vertex_[at(wedge)] = n_vertices_++; }
  std::uint32_t add_triangle(std::int32_t triangle) { return triangle_[at(triangle)] = n_triangles_++; }
  bool has_vertex(std::int32_t wedge) const { return vertex_[at(wedge)] != kUnnamed; }
  std::uint32_t vertex(std::int32_t wedge) const { return vertex_[at(wedge)]; }
  std::uint32_t triangle(std::int32_t triangle) const { return triangle_[at(triangle)]; }
  std::uint32_t original(std::int32_t wedge) const { return mesh_.original_vertex[at(wedge)]; }
  std::uint32_t original_triangle(std::int32_t triangle) const { return mesh_.original_triangle[at(triangle)]; }

  std::vector<float> values(std::int32_t wedge) const {
    std::vector<float> all;
    for (const SurfaceAttribute& attribute : input_.attributes) {
      const auto n = static_cast<std::size_t>(attribute.components());
      const float* first = attribute.values.data() + original(wedge) * n;
      all.insert(all.end(), first, first + n);
    }
    return all;
  }

 private:
  const SurfaceMesh& mesh_;
  const Surface& input_;
  std::vector<std::uint32_t> vertex_;
  std::vector<std::uint32_t> triangle_;
  std::uint32_t n_vertices_ = 0;
  std::uint32_t n_triangles_ = 0;
};

void append_values(Surface& surface, const std::vector<float>& values) {
  auto from = values.begin();
  for (SurfaceAttribute& attribute : surface.attributes) {
    const auto to = from + attribute.components();
    attribute.values.insert(attribute.values.end(), from, to);
    from = to;
  }
}

void add_base(const SurfaceMesh& mesh, const Surface& input, Names& names, ProgressiveSurface& result) {
  for (const SurfaceAttribute& attribute : input.attributes)
    result.base.attributes.push_back({attribute.kind, attribute.name, {}});
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    if (mesh.origin[at(h)] == kNone) continue;
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t wedge = mesh.wedge[at(h) + k];
      if (!names.has_vertex(wedge)) {
        names.add_vertex(wedge);
        result.base.position.push_back(input.position[names.original(wedge)]);
        result.original_vertex.push_back(names.original(wedge));
        append_values(result.base, names.values(wedge));
      }
      corners[k] = names.vertex(wedge);
    }
    names.add_triangle(h / 3);
    result.base.triangles.push_back(corners);
    result.original_triangle.push_back(names.original_triangle(h / 3));
  }
}

VertexSplit split_of(const SurfaceCollapse& collapse, const Surface& input, Names& names) {
  VertexSplit split;
  for (const SurfaceCollapse::Moved& moved : collapse.moved) {
    VertexSplit::Vertex vertex{names.vertex(moved.kept),
                               names.original(moved.gone),
                               input.position[names.original(moved.gone)],
                               names.values(moved.gone),
                               {}};
    names.add_vertex(moved.gone);
    for (const std::int32_t t : moved.triangles) vertex.triangles.push_back(names.triangle(t));
    split.vertices.push_back(std::move(vertex));
  }
  for (const SurfaceCollapse::Removed& removed : collapse.removed) {
    VertexSplit::Triangle triangle{names.original_triangle(removed.triangle), {}};
    for (std::size_t k = 0; k < 3; ++k) triangle.corners[k] = names.vertex(removed.wedges[k]);
    names.add_triangle(removed.triangle);
    split.triangles.push_back(triangle);
  }
  return split;
}

// What to take in which order, so that the numbers `original` rise.
std::vector<std::uint32_t> rising(const std::vector<std::uint32_t>& original) {
  std::vector<std::uint32_t> order(original.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return original[a] < original[b]; });
  return order;
}

Surface reordered(const Surface& surface, const std::vector<std::uint32_t>& original_vertex,
                  const std::vector<std::uint32_t>& original_triangle) {
  const std::vector<std::uint32_t> vertices = rising(original_vertex);
  std::vector<std::uint32_t> name(vertices.size());
  Surface result;
  for (const SurfaceAttribute& attribute : surface.attributes)
    result.attributes.push_back({attribute.kind, attribute.name, {}});
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    name[vertices[i]] = static_cast<std::uint32_t>(i);
    result.position.push_back(surface.position[vertices[i]]);
    for (std::size_t a = 0; a < surface.attributes.size(); ++a) {
      const auto n = static_cast<std::size_t>(surface.attributes[a].components());
      const float* first = surface.attributes[a].values.data() + vertices[i] * n;
      result.attributes[a].values.insert(result.attributes[a].values.end(), first, first + n);
    }
  }
  for (const std::uint32_t t : rising(original_triangle)) {
    const auto& [a, b, c] = surface.triangles[t];
    result.triangles.push_back({name[a], name[b], name[c]});
  }
  return result;
}

}  // namespace

ProgressiveSurface make_progressive(const Surface& surface, SimplifySurfaceOptions options,
                                    SimplifySurfaceReport& report) {
  options.placement = Placement::kSubset;
  std::vector<SurfaceCollapse> history;
  WedgeValues values;
  const SurfaceMesh mesh = simplified_mesh(surface, options, report, values, &history);
  ProgressiveSurface result;
  Names names(mesh, surface);
  add_base(mesh, surface, names, result);
  result.splits.reserve(history.size());
  for (auto collapse = history.rbegin(); collapse != history.rend(); ++collapse)
    result.splits.push_back(split_of(*collapse, surface, names));
  return result;
}

Surface restore(const ProgressiveSurface& progressive, double max_triangles) {
  Surface surface = progressive.base;
  std::vector<std::uint32_t> original_vertex = progressive.original_vertex;
  std::vector<std::uint32_t> original_triangle = progressive.original_triangle;
  for (const VertexSplit& split : progressive.splits) {
    if (static_cast<double>(surface.triangles.size() + split.triangles.size()) > max_triangles) break;
    for (const VertexSplit::Vertex& vertex : split.vertices) {
      const auto number = static_cast<std::uint32_t>(surface.position.size());
      surface.position.push_back(vertex.position);
      append_values(surface, vertex.values);
      original_vertex.push_back(vertex.original);
      for (const std::uint32_t t : vertex.triangles)
        std::replace(surface.triangles[t].begin(), surface.triangles[t].end(), vertex.parent, number);
    }
    for (const VertexSplit::Triangle& triangle : split.triangles) {
      surface.triangles.push_back(triangle.corners);
      original_triangle.push_back(triangle.original);
    }
  }
  return reordered(surface, original_vertex, original_triangle);
}

}  // namespace tinsmith
