#include "mesh/window_mesh.hpp"

#include <fmt/format.h>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

std::int32_t copy_vertex(WindowMesh& mesh, std::int32_t v) {
  mesh.position.push_back(mesh.position[at(v)]);
  mesh.height.push_back(mesh.height[at(v)]);
  mesh.is_settled.push_back(mesh.is_settled[at(v)]);
  if (!mesh.colour.empty()) mesh.colour.push_back(mesh.colour[at(v)]);
  mesh.kind.push_back(VertexKind::kLocked);
  mesh.out.push_back(kNone);
  return mesh.n_vertices() - 1;
}

// Gives the fan of h a vertex of its own, unless it is the first of its vertex or has one already.
void separate_fan(WindowMesh& mesh, std::int32_t h) {
  const std::int32_t v = mesh.origin[at(h)];
  const std::int32_t start = fan_of(mesh, h).start;
  if (start == mesh.out[at(v)]) return;
  const std::int32_t copy = copy_vertex(mesh, v);
  mesh.out[at(copy)] = start;
  std::int32_t g = start;
  do {
    mesh.origin[at(g)] = copy;
    g = mesh.turn(g);
  } while (g != kNone && g != start);
}

}  // namespace

void connect(WindowMesh& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles) {
  const std::size_t n = mesh.position.size();
  const std::vector<std::int32_t> pinched = connect(mesh, triangles, n);
  mesh.kind.assign(n, VertexKind::kInterior);
  if (pinched.empty()) return;
  for (const std::int32_t v : pinched) mesh.kind[at(v)] = VertexKind::kLocked;
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    const std::int32_t v = mesh.origin[at(h)];
    const bool is_first_copy = static_cast<std::size_t>(v) < n;
    if (is_first_copy && mesh.kind[at(v)] == VertexKind::kLocked) separate_fan(mesh, h);
  }
}

void collapse_edge(WindowMesh& mesh, std::int32_t h, std::int32_t kept, const Place& place) {
  collapse_edge(mesh, h, kept);
  mesh.position[at(kept)] = place.position;
  mesh.height[at(kept)] = place.height;
}

namespace {

std::string validate_halfedge(const WindowMesh& mesh, std::int32_t h) {
  const std::int32_t t = mesh.twin[at(h)];
  if (t != kNone && mesh.twin[at(t)] != h) return fmt::format("I1: the twin's twin of halfedge {} is another", h);
  if (t != kNone && mesh.origin[at(t)] != mesh.destination(h))
    return fmt::format("I1: the twin of halfedge {} starts elsewhere", h);
  if (!mesh.is_alive(mesh.origin[at(h)])) return fmt::format("halfedge {} leaves a removed vertex", h);
  return {};
}

}  // namespace

std::string validate(const WindowMesh& mesh) {
  std::vector<std::int32_t> degree(mesh.position.size(), 0);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[at(h)] == kNone) continue;
    if (std::string broken = validate_halfedge(mesh, h); !broken.empty()) return broken;
    ++degree[at(mesh.origin[at(h)])];
    const auto corner = [&](std::int32_t e) { return mesh.position[at(mesh.origin[at(e)])]; };
    const std::int32_t n = WindowMesh::next(h);
    if (orient(corner(h), corner(n), corner(WindowMesh::next(n))) <= 0)
      return fmt::format("I2: triangle {} is not counter-clockwise", h / 3);
  }
  for (std::int32_t v = 0; v < mesh.n_vertices(); ++v) {
    if (!mesh.is_alive(v)) continue;
    std::int32_t n = 0;
    for_each_out(mesh, v, [&](std::int32_t h) {
      if (mesh.origin[at(h)] == v) ++n;
    });
    if (n != degree[at(v)])
      return fmt::format("the fan of vertex {} meets {} of {} halfedges", v, n, degree[at(v)]);
  }
  return {};
}

}  // namespace tinsmith
