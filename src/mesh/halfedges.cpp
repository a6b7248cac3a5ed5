#include "mesh/halfedges.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

bool are_opposite(const Halfedges& mesh, std::int32_t h, std::int32_t g) {
  return mesh.origin[at(h)] == mesh.destination(g) && mesh.destination(h) == mesh.origin[at(g)];
}

// Until its twin comes a halfedge waits in a list of its edge's smaller vertex, linked by what will be the twins.
void pair_twins(Halfedges& mesh) {
  mesh.twin.resize(mesh.origin.size());
  std::vector<std::int32_t> waiting(mesh.out.size(), kNone);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    std::int32_t& first = waiting[at(std::min(mesh.origin[at(h)], mesh.destination(h)))];
    std::int32_t* link = &first;
    while (*link != kNone && !are_opposite(mesh, h, *link)) link = &mesh.twin[at(*link)];
    const std::int32_t g = *link;
    if (g == kNone) {
      mesh.twin[at(h)] = std::exchange(first, h);
    } else {
      *link = mesh.twin[at(g)];
      mesh.twin[at(g)] = h;
      mesh.twin[at(h)] = g;
    }
  }
  for (std::int32_t h : waiting) {
    while (h != kNone) h = std::exchange(mesh.twin[at(h)], kNone);
  }
}

Fan open_fan_from(const Halfedges& mesh, std::int32_t start) {
  Fan fan{start, 0};
  for (std::int32_t g = start; g != kNone; g = mesh.turn(g)) ++fan.size;
  return fan;
}

// Joins the outer neighbours of the triangle of h, which falls away; the vertex opposite to h keeps a halfedge.
void close_triangle(Halfedges& mesh, std::int32_t h) {
  const std::int32_t a = mesh.twin[at(Halfedges::next(h))];
  const std::int32_t b = mesh.twin[at(Halfedges::previous(h))];
  const std::int32_t apex = mesh.origin[at(Halfedges::previous(h))];
  TINSMITH_ASSERT(a != kNone || b != kNone);
  if (mesh.out[at(apex)] == Halfedges::previous(h)) mesh.out[at(apex)] = a;
  if (a != kNone) mesh.twin[at(a)] = b;
  if (b != kNone) mesh.twin[at(b)] = a;
  const std::int32_t t = h / 3 * 3;
  for (std::int32_t k = 0; k < 3; ++k) mesh.origin[at(t + k)] = kNone;
}

}  // namespace

Fan fan_of(const Halfedges& mesh, std::int32_t h) {
  Fan fan{h, 0};
  std::int32_t g = h;
  do {
    ++fan.size;
    fan.start = std::min(fan.start, g);
    const std::int32_t t = mesh.twin[at(g)];
    if (t == kNone) return open_fan_from(mesh, g);
    g = Halfedges::next(t);
  } while (g != h);
  return fan;
}

std::vector<std::int32_t> connect(Halfedges& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles,
                                  std::size_t n_vertices) {
  mesh.origin.clear();
  mesh.origin.reserve(triangles.size() * 3);
  for (const auto& t : triangles) mesh.origin.insert(mesh.origin.end(), t.begin(), t.end());
  mesh.out.assign(n_vertices, kNone);
  pair_twins(mesh);
  std::vector<std::int32_t> degree(n_vertices, 0);
  for (std::int32_t h = mesh.n_halfedges(); h-- > 0;) {
    const std::int32_t v = mesh.origin[at(h)];
    mesh.out[at(v)] = h;
    ++degree[at(v)];
  }
  std::vector<std::int32_t> with_more_fans;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(n_vertices); ++v) {
    if (!mesh.is_alive(v)) continue;
    const Fan fan = fan_of(mesh, mesh.out[at(v)]);
    mesh.out[at(v)] = fan.start;
    if (fan.size != degree[at(v)]) with_more_fans.push_back(v);
  }
  return with_more_fans;
}

//        vl
//       /  \          h runs from v0 to v1, g back. One of them goes, and the triangles (v0, v1, vl) and
//     v0 -> v1        (v1, v0, vr) fall away.
//       \  /
//        vr
void collapse_edge(Halfedges& mesh, std::int32_t h, std::int32_t kept) {
  const std::int32_t gone = mesh.origin[at(h)] == kept ? mesh.destination(h) : mesh.origin[at(h)];
  const std::int32_t g = mesh.twin[at(h)];
  const std::int32_t start = mesh.out[at(gone)];
  const bool is_closed = !mesh.is_border_vertex(kept) && !mesh.is_border_vertex(gone);
  std::int32_t f = start;
  do {
    mesh.origin[at(f)] = kept;
    f = mesh.turn(f);
  } while (f != kNone && f != start);
  // A halfedge that leaves the new vertex, outside of (v0, v1, vl): from it the start of an open fan is found.
  std::int32_t leaving = mesh.twin[at(Halfedges::previous(h))];
  if (leaving == kNone) leaving = Halfedges::next(mesh.twin[at(Halfedges::next(h))]);
  close_triangle(mesh, h);
  if (g != kNone) close_triangle(mesh, g);
  mesh.out[at(gone)] = kNone;
  mesh.out[at(kept)] = is_closed ? leaving : fan_of(mesh, leaving).start;
}

//        c                 c
//      /   \             / | \         h ran from a to b, now from d to c; its triangle was (a, b, c) and is
//     a --> b    -->     a  |  b        (d, c, a), that of its twin was (b, a, d) and is (c, d, b).
//      \   /             \ | /
//        d                 d
void flip_edge(Halfedges& mesh, std::int32_t h) {
  const std::int32_t g = mesh.twin[at(h)];
  const std::int32_t h_next = Halfedges::next(h);
  const std::int32_t h_previous = Halfedges::previous(h);
  const std::int32_t g_next = Halfedges::next(g);
  const std::int32_t g_previous = Halfedges::previous(g);
  const std::int32_t a = mesh.origin[at(h)];
  const std::int32_t b = mesh.origin[at(g)];
  const std::int32_t c = mesh.origin[at(h_previous)];
  const std::int32_t d = mesh.origin[at(g_previous)];
  const auto pair = [&](std::int32_t e, std::int32_t outside) {
    mesh.twin[at(e)] = outside;
    if (outside != kNone) mesh.twin[at(outside)] = e;
  };
  const auto rename_out = [&](std::int32_t v, std::initializer_list<std::int32_t> before, std::int32_t now) {
    for (const std::int32_t e : before) {
      if (mesh.out[at(v)] == e) {
        mesh.out[at(v)] = now;
        return;
      }
    }
  };
  rename_out(a, {h, g_next}, h_previous);
  rename_out(b, {g, h_next}, g_previous);
  rename_out(c, {h_previous}, h_next);
  rename_out(d, {g_previous}, g_next);
  const std::int32_t beside_bc = mesh.twin[at(h_next)];
  const std::int32_t beside_ca = mesh.twin[at(h_previous)];
  const std::int32_t beside_ad = mesh.twin[at(g_next)];
  const std::int32_t beside_db = mesh.twin[at(g_previous)];
  mesh.origin[at(h)] = d;
  mesh.origin[at(h_next)] = c;
  mesh.origin[at(h_previous)] = a;
  mesh.origin[at(g)] = c;
  mesh.origin[at(g_next)] = d;
  mesh.origin[at(g_previous)] = b;
  pair(h_next, beside_ca);
  pair(h_previous, beside_ad);
  pair(g_next, beside_db);
  pair(g_previous, beside_bc);
}

}  // namespace tinsmith
