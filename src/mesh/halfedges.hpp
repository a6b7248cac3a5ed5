#pragma once
// The neighbours of triangles: 32-bit halfedges.
//
// Halfedge h = 3 t + k runs from origin[h] to origin[next(h)] inside triangle t; the triangle lies on its left.
// Invariants: I1 twin[twin[h]] == h; out[v] leaves v, and when v is on a border it is the halfedge without twin, so
// that turning counter-clockwise from it meets the whole fan; every vertex has one fan.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tinsmith {

inline constexpr std::int32_t kNone = -1;

struct Halfedges {
  std::vector<std::int32_t> out;     // by vertex: a halfedge that leaves it; kNone: removed
  std::vector<std::int32_t> origin;  // by halfedge; kNone: triangle removed
  std::vector<std::int32_t> twin;    // by halfedge; kNone: border

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

/// Calls f(h) for every halfedge that leaves v and has a triangle, counter-clockwise.
template <class F>
void for_each_out(const Halfedges& mesh, std::int32_t v, F&& f) {
  const std::int32_t start = mesh.out[static_cast<std::size_t>(v)];
  std::int32_t h = start;
  do {
    f(h);
    h = mesh.turn(h);
  } while (h != kNone && h != start);
}

/// Fills all from the triangles over n_vertices vertices. Returns the vertices with more than one fan: out has the
/// start of the first. Edges with more than two triangles are not allowed.
std::vector<std::int32_t> connect(Halfedges& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles,
                                  std::size_t n_vertices);

struct Fan {
  std::int32_t start;  // clockwise as far as it goes; of a closed fan the smallest halfedge
  std::int32_t size;   // in triangles
};

/// The fan that h belongs to.
Fan fan_of(const Halfedges& mesh, std::int32_t h);

/// Collapses the edge of h into its end `kept`; the other end goes. That it is legal was checked before.
void collapse_edge(Halfedges& mesh, std::int32_t h, std::int32_t kept);

/// Replaces the edge of h, which has two triangles, by the other diagonal of their quadrilateral: h runs along it
/// afterwards. That both new triangles are valid was checked before.
void flip_edge(Halfedges& mesh, std::int32_t h);

}  // namespace tinsmith
