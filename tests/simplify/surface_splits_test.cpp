// Vertices come to triangles, edges and borders, and everything stays connected.

#include "simplify/surface_splits.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <vector>

#include "tinsmith/simplify.hpp"

namespace tinsmith {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// 3 x 3 vertices; the one in the middle has just been collapsed into a neighbour, so that a vertex and two
// triangles are gone.
struct Sheet {
  SurfaceMesh mesh;
  NewVertex free{kNone, kNone};

  Sheet() {
    Surface surface;
    for (int y = 0; y < 3; ++y) {
      for (int x = 0; x < 3; ++x) surface.position.push_back({double(x), double(y), 0});
    }
    for (std::uint32_t y = 0; y < 2; ++y) {
      for (std::uint32_t x = 0; x < 2; ++x) {
        const std::uint32_t v = 3 * y + x;
        surface.triangles.push_back({v, v + 1, v + 4});
        surface.triangles.push_back({v, v + 4, v + 3});
      }
    }
    SurfaceDefects defects;
    SimplifySurfaceReport report;
    mesh = surface_mesh_of(surface, defects);
    mark_features(mesh, {}, report);
    std::int32_t h = 0;  // leaves the middle
    while (mesh.original_vertex[at(mesh.wedge[at(h)])] != 4) ++h;
    free = {mesh.origin[at(h)], mesh.wedge[at(h)]};
    const std::int32_t kept = mesh.destination(h);
    const std::int32_t wedge = mesh.wedge[at(Halfedges::next(h))];
    for (std::int32_t& w : mesh.wedge) w = w == free.wedge ? wedge : w;
    carry_feature(mesh, h);
    carry_feature(mesh, mesh.twin[at(h)]);
    collapse_edge(mesh, h, kept);
  }
};

using Corners = std::array<std::int32_t, 3>;

Corners from_least(Corners t) {
  std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  return t;
}

// Each from its least vertex on.
std::multiset<Corners> triangles_of(const SurfaceMesh& mesh) {
  std::multiset<Corners> triangles;
  for (std::size_t h = 0; h < mesh.origin.size(); h += 3) {
    if (mesh.origin[h] != kNone)
      triangles.insert(from_least({mesh.origin[h], mesh.origin[h + 1], mesh.origin[h + 2]}));
  }
  return triangles;
}

void expect_connected(const SurfaceMesh& mesh) {
  std::vector<int> n_around(mesh.out.size(), 0);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[at(h)] == kNone) continue;
    ++n_around[at(mesh.origin[at(h)])];
    EXPECT_EQ(mesh.is_feature[at(h)] != 0, mesh.is_border_edge(h)) << h;
    EXPECT_EQ(mesh.wedge[at(h)], mesh.wedge[at(mesh.out[at(mesh.origin[at(h)])])]) << h;
    const std::int32_t g = mesh.twin[at(h)];
    if (g == kNone) {
      EXPECT_EQ(mesh.out[at(mesh.origin[at(h)])], h);
      continue;
    }
    EXPECT_EQ(mesh.twin[at(g)], h);
    EXPECT_EQ(mesh.origin[at(g)], mesh.destination(h));
    EXPECT_EQ(mesh.destination(g), mesh.origin[at(h)]);
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.out.size()); ++v) {
    if (!mesh.is_alive(v)) continue;
    int n = 0;
    for_each_out(mesh, v, [&](std::int32_t h) {
      EXPECT_EQ(mesh.origin[at(h)], v);
      ++n;
    });
    EXPECT_EQ(n, n_around[at(v)]) << v;
  }
}

Corners corners(const SurfaceMesh& mesh, std::int32_t h) {
  return {mesh.origin[at(h)], mesh.origin[at(Halfedges::next(h))], mesh.origin[at(Halfedges::previous(h))]};
}

void replace(std::multiset<Corners>& triangles, const Corners& gone, const std::vector<Corners>& come) {
  EXPECT_EQ(triangles.erase(from_least(gone)), 1U);
  for (const Corners& t : come) triangles.insert(from_least(t));
}

// At every halfedge of a sheet of its own: expect(sheet, h, triangles) says what becomes of the triangles.
template <class Split, class Expect>
void split_everywhere(Split split, Expect expect) {
  const std::int32_t n = Sheet().mesh.n_halfedges();
  for (std::int32_t h = 0; h < n; ++h) {
    Sheet sheet;
    if (sheet.mesh.origin[at(h)] == kNone) continue;
    SCOPED_TRACE(h);
    auto expected = triangles_of(sheet.mesh);
    expect(sheet, h, expected);
    split(sheet.mesh, h, sheet.free, find_gone_triangle(sheet.mesh, 0));
    EXPECT_EQ(triangles_of(sheet.mesh), expected);
    expect_connected(sheet.mesh);
  }
}

TEST(SurfaceSplits, ATriangleBecomesThree) {
  split_everywhere(split_triangle, [](const Sheet& sheet, std::int32_t h, std::multiset<Corners>& expected) {
    const auto [a, b, c] = corners(sheet.mesh, h);
    const std::int32_t v = sheet.free.vertex;
    replace(expected, {a, b, c}, {{a, b, v}, {b, c, v}, {c, a, v}});
  });
}

TEST(SurfaceSplits, AnEdgeGetsAVertex) {
  int n_inner = 0;
  int n_borders = 0;
  split_everywhere(split_edge, [&](const Sheet& sheet, std::int32_t h, std::multiset<Corners>& expected) {
    const auto [a, b, c] = corners(sheet.mesh, h);
    const std::int32_t v = sheet.free.vertex;
    replace(expected, {a, b, c}, {{a, v, c}, {v, b, c}});
    const std::int32_t g = sheet.mesh.twin[at(h)];
    ++(g == kNone ? n_borders : n_inner);
    if (g != kNone) {
      const std::int32_t d = corners(sheet.mesh, g)[2];
      replace(expected, {b, a, d}, {{b, v, d}, {v, a, d}});
    }
  });
  EXPECT_EQ(n_borders, 8);
  EXPECT_EQ(n_inner, 10);
}

}  // namespace
}  // namespace tinsmith
