#pragma once
// The mesh that a window task works on: triangles with their neighbours, 32-bit indices.
//
// Halfedge h = 3 t + k runs from origin[h] to origin[next(h)] inside triangle t; the triangle lies on its
// left. Invariants: I1 twin[twin[h]] == h; I2 every triangle is counter-clockwise in plan; out[v] leaves v,
// and when v is on a border it is the halfedge without twin, so that turning counter-clockwise from it meets
// the whole fan; every vertex has one fan.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/lattice.hpp"
#include "mesh/vertex_kind.hpp"

namespace tinsmith {

inline constexpr std::int32_t kNone = -1;

struct WindowMesh {
  // by vertex
  std::vector<LatticePoint> position;
  std::vector<double> height;
  std::vector<VertexKind> kind;
  std::vector<std::uint8_t> is_settled;  // was free among free neighbours in an earlier round
  std::vector<std::int32_t> out;         // a halfedge that leaves it; kNone: removed
  // by halfedge
  std::vector<std::int32_t> origin;  // kNone: triangle removed
  std::vector<std::int32_t> twin;    // kNone: border

  std::int32_t n_vertices() const { return static_cast<std::int32_t>(position.size()); }
  std::int32_t n_halfedges() const { return static_cast<std::int32_t>(origin.size()); }
  std::int32_t destination(std::int32_t h) const { return origin[static_cast<std::size_t>(next(h))]; }
  bool is_border_edge(std::int32_t h) const { return twin[static_cast<std::size_t>(h)] == kNone; }
  bool is_alive(std::int32_t v) const { return out[static_cast<std::size_t>(v)] != kNone; }
  bool is_border_vertex(std::int32_t v) const { return is_border_edge(out[static_cast<std::size_t>(v)]); }

  static std::int32_t next(std::int32_t h) { return h % 3 == 2 ? h - 2 : h + 1; }
  static std::int32_t previous(std::int32_t h) { return h % 3 == 0 ? h + 2 : h - 1; }

  /// The next halfedge that leaves the same vertex, counter-clockwise; kNone at the end of an open fan.
  std::int32_t turn(std::int32_t h) const { return twin[static_cast<std::size_t>(previous(h))]; }
};

/// A point of the surface.
struct Place {
  LatticePoint position;
  double height = 0;
};

/// Calls f(h) for every halfedge that leaves v and has a triangle, counter-clockwise.
template <class F>
void for_each_out(const WindowMesh& mesh, std::int32_t v, F&& f) {
  const std::int32_t start = mesh.out[static_cast<std::size_t>(v)];
  std::int32_t h = start;
  do {
    f(h);
    h = mesh.turn(h);
  } while (h != kNone && h != start);
}

/// Fills origin, twin and out from triangles over the vertices already in the mesh, and splits every vertex
/// with more than one fan into one vertex a fan (marked: kind kLocked). Other kinds are left to the caller.
void connect(WindowMesh& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles);

/// Collapses the edge of h into its end `kept`, which moves to `place`; the other end goes. Topology only: that
/// it is legal was checked before.
void collapse_edge(WindowMesh& mesh, std::int32_t h, std::int32_t kept, const Place& place);

/// Replaces the edge of h, which has two triangles, by the other diagonal of their quadrilateral: h runs along it
/// afterwards. Topology only: that both new triangles are counter-clockwise was checked before.
void flip_edge(WindowMesh& mesh, std::int32_t h);

/// Empty when all invariants hold, else the first broken one with its place. For tests: O(n).
std::string validate(const WindowMesh& mesh);

}  // namespace tinsmith
