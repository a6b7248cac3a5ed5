// What manifold_of counts and mends: every kind of defect on drawings of a few triangles, then random ones.

#include "mesh/surface_definition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "support/surface_measures.hpp"
#include "support/surface_shapes.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith::test {
namespace {

using Triangle = std::array<std::uint32_t, 3>;
using Triangles = std::vector<Triangle>;
using Numbers = std::vector<std::uint32_t>;

/// A scalar that is the vertex's number.
Surface with_numbers(Surface s) {
  SurfaceAttribute number{AttributeKind::kScalar, "number", {}};
  for (std::size_t v = 0; v < s.position.size(); ++v) number.values.push_back(static_cast<float>(v));
  s.attributes.push_back(std::move(number));
  return s;
}

/// Vertices on a curve of which no three lie on a line and no four in a plane.
Surface drawing(std::size_t n_vertices, Triangles triangles) {
  Surface s{{}, std::move(triangles), {}};
  for (std::size_t v = 0; v < n_vertices; ++v) {
    const auto x = static_cast<double>(v);
    s.position.push_back({x, x * x, x * x * x});
  }
  return with_gradient_colour(with_numbers(std::move(s)));
}

const Triangles tetrahedron{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

struct Mended {
  SurfaceDefects defects;
  ManifoldSurface result;
};

Mended mend(const Surface& s) {
  Mended mended;
  mended.result = manifold_of(s, mended.defects);
  return mended;
}

void expect_defects(const SurfaceDefects& is, const SurfaceDefects& wanted) {
  EXPECT_EQ(is.duplicated_triangles, wanted.duplicated_triangles);
  EXPECT_EQ(is.degenerate_triangles, wanted.degenerate_triangles);
  EXPECT_EQ(is.flipped_triangles, wanted.flipped_triangles);
  EXPECT_EQ(is.non_manifold_edges, wanted.non_manifold_edges);
  EXPECT_EQ(is.non_manifold_vertices, wanted.non_manifold_vertices);
  EXPECT_EQ(is.unorientable_edges, wanted.unorientable_edges);
  EXPECT_EQ(is.unreferenced_vertices, wanted.unreferenced_vertices);
}

SurfaceDefects only(std::uint64_t SurfaceDefects::*kind, std::uint64_t n) {
  SurfaceDefects defects;
  defects.*kind = n;
  return defects;
}

void expect_same(const Surface& a, const Surface& b) {
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.triangles, b.triangles);
  ASSERT_EQ(a.attributes.size(), b.attributes.size());
  for (std::size_t k = 0; k < a.attributes.size(); ++k) {
    EXPECT_EQ(a.attributes[k].kind, b.attributes[k].kind);
    EXPECT_EQ(a.attributes[k].name, b.attributes[k].name);
    EXPECT_EQ(a.attributes[k].values, b.attributes[k].values);
  }
}

/// Vertices are the input's, with all their attributes.
void expect_carried(const Surface& input, const ManifoldSurface& result) {
  ASSERT_EQ(result.surface.position.size(), result.original_vertex.size());
  ASSERT_EQ(result.is_locked.size(), result.original_vertex.size());
  ASSERT_EQ(result.surface.attributes.size(), input.attributes.size());
  for (std::size_t v = 0; v < result.original_vertex.size(); ++v) {
    const std::size_t from = result.original_vertex[v];
    ASSERT_EQ(result.surface.position[v], input.position[from]);
    for (std::size_t k = 0; k < input.attributes.size(); ++k) {
      const auto n = static_cast<std::size_t>(input.attributes[k].components());
      ASSERT_EQ(result.surface.attributes[k].values.size(), n * result.original_vertex.size());
      for (std::size_t i = 0; i < n; ++i)
        ASSERT_EQ(result.surface.attributes[k].values[n * v + i], input.attributes[k].values[n * from + i]);
    }
  }
}

/// The input's vertices at the corners.
Triangles original_triangles(const ManifoldSurface& result) {
  Triangles triangles = result.surface.triangles;
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = result.original_vertex[v];
  return triangles;
}

Numbers locked_originals(const ManifoldSurface& result) {
  Numbers locked;
  for (std::size_t v = 0; v < result.is_locked.size(); ++v)
    if (result.is_locked[v] != 0) locked.push_back(result.original_vertex[v]);
  std::sort(locked.begin(), locked.end());
  return locked;
}

TEST(SurfaceDefinition, CleanSurfaceComesBackUnchanged) {
  for (const Surface& shape : {sphere(5), torus(12, 7), cube_with_creases(4), open_sheet(9), scan(6), Surface{}}) {
    const Surface s = with_numbers(with_normals(with_checker_colour(shape, 3)));
    const auto [defects, result] = mend(s);
    expect_defects(defects, {});
    EXPECT_FALSE(defects.any());
    expect_same(result.surface, s);
    expect_carried(s, result);
    EXPECT_TRUE(std::is_sorted(result.original_vertex.begin(), result.original_vertex.end()));
    EXPECT_EQ(locked_originals(result), Numbers{});
  }
}

TEST(SurfaceDefinition, SameVerticesAgainAreRemovedInAnyOrder) {
  Triangle again{0, 1, 3};
  do {
    Surface s = drawing(4, tetrahedron);
    s.triangles.push_back(again);
    const auto [defects, result] = mend(s);
    expect_defects(defects, only(&SurfaceDefects::duplicated_triangles, 1));
    expect_same(result.surface, drawing(4, tetrahedron));
    EXPECT_EQ(locked_originals(result), Numbers{});
  } while (std::next_permutation(again.begin(), again.end()));
  const auto [defects, result] = mend(drawing(3, {{2, 1, 0}, {0, 1, 2}, {1, 0, 2}, {2, 1, 0}}));
  expect_defects(defects, only(&SurfaceDefects::duplicated_triangles, 3));
  EXPECT_EQ(result.surface.triangles, (Triangles{{2, 1, 0}}));
}

TEST(SurfaceDefinition, TrianglesWithVertexTwiceAreRemoved) {
  const auto [defects, result] =
      mend(drawing(4, {{1, 1, 2}, {0, 2, 1}, {0, 1, 3}, {3, 0, 3}, {1, 2, 3}, {2, 0, 3}, {1, 2, 2}, {3, 3, 3}}));
  expect_defects(defects, only(&SurfaceDefects::degenerate_triangles, 4));
  expect_same(result.surface, drawing(4, tetrahedron));
}

TEST(SurfaceDefinition, AllDegenerateLeavesNothing) {
  const Surface s = drawing(3, {{1, 1, 2}, {0, 0, 0}});
  const auto [defects, result] = mend(s);
  SurfaceDefects wanted = only(&SurfaceDefects::degenerate_triangles, 2);
  wanted.unreferenced_vertices = 3;
  expect_defects(defects, wanted);
  EXPECT_TRUE(result.surface.position.empty() && result.surface.triangles.empty());
  expect_carried(s, result);
}

TEST(SurfaceDefinition, TrianglesWithoutAreaAreKept) {
  Surface on_line = drawing(4, {{0, 1, 2}, {0, 2, 3}});
  on_line.position = {{0, 0, 0}, {0.1, 0.2, 0.3}, {0.3, 0.6, 0.9}, {1, 0, 0}};
  Surface at_a_point = on_line;
  at_a_point.position[1] = at_a_point.position[2];
  for (const Surface& s : {on_line, at_a_point}) {
    const auto [defects, result] = mend(s);
    expect_defects(defects, only(&SurfaceDefects::degenerate_triangles, 1));
    expect_same(result.surface, s);
  }
  Surface thin = on_line;  // a millionth of a millionth as wide as long
  thin.position[1][0] += 1e-12;
  EXPECT_FALSE(mend(thin).defects.any());
}

// Three pages of a book: 0 1 is the back, with a triangle to each of 2, 3 and 4.
TEST(SurfaceDefinition, EdgeWithThreeTrianglesIsCutApartAndLocked) {
  const Surface s = drawing(5, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  const auto [defects, result] = mend(s);
  expect_defects(defects, only(&SurfaceDefects::non_manifold_edges, 1));
  expect_carried(s, result);
  EXPECT_EQ(original_triangles(result), s.triangles);
  EXPECT_EQ(result.original_vertex, (Numbers{0, 1, 2, 3, 4, 0, 1, 1, 0}));
  EXPECT_EQ(result.surface.triangles, (Triangles{{0, 1, 2}, {5, 6, 3}, {7, 8, 4}}));
  EXPECT_EQ(locked_originals(result), (Numbers{0, 0, 0, 1, 1, 1}));
}

// The fin is cut off; the sphere stays whole, as its triangles at the edge are still the ends of one fan.
TEST(SurfaceDefinition, SphereWithFinStaysClosed) {
  Surface s = drawing(5, tetrahedron);
  s.triangles.push_back({0, 1, 4});
  const auto [defects, result] = mend(s);
  expect_defects(defects, only(&SurfaceDefects::non_manifold_edges, 1));
  EXPECT_EQ(result.surface.triangles, (Triangles{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {5, 6, 4}}));
  EXPECT_EQ(result.original_vertex, (Numbers{0, 1, 2, 3, 4, 0, 1}));
  EXPECT_EQ(locked_originals(result), (Numbers{0, 0, 1, 1}));
}

TEST(SurfaceDefinition, BowTieVertexIsCutApartAndLocked) {
  const Surface s = drawing(5, {{0, 1, 2}, {0, 3, 4}});
  const auto [defects, result] = mend(s);
  expect_defects(defects, only(&SurfaceDefects::non_manifold_vertices, 1));
  expect_carried(s, result);
  EXPECT_EQ(result.surface.triangles, (Triangles{{0, 1, 2}, {5, 3, 4}}));
  EXPECT_EQ(result.original_vertex, (Numbers{0, 1, 2, 3, 4, 0}));
  EXPECT_EQ(locked_originals(result), (Numbers{0, 0}));
}

TEST(SurfaceDefinition, ClosedSurfacesThatTouchAtVertexAreCutApart) {
  Surface s = drawing(7, tetrahedron);
  for (const Triangle& t : tetrahedron) s.triangles.push_back({t[0] + 3, t[1] + 3, t[2] + 3});
  const auto [defects, result] = mend(s);
  expect_defects(defects, only(&SurfaceDefects::non_manifold_vertices, 1));
  EXPECT_TRUE(is_closed_manifold(result.surface));
  EXPECT_EQ(count_components(result.surface), 2U);
  EXPECT_EQ(locked_originals(result), (Numbers{3, 3}));
}

TEST(SurfaceDefinition, PiecesMayBeWoundDifferently) {
  Surface s = drawing(8, tetrahedron);
  for (const Triangle& t : tetrahedron) s.triangles.push_back({t[0] + 4, t[2] + 4, t[1] + 4});
  const auto [defects, result] = mend(s);
  expect_defects(defects, {});
  expect_same(result.surface, s);
}

TEST(SurfaceDefinition, TriangleTurnedOverIsTurnedBack) {
  const Surface s = with_numbers(sphere(2));
  for (std::size_t t = 0; t < s.triangles.size(); ++t) {
    Surface turned = s;
    std::swap(turned.triangles[t][1], turned.triangles[t][2]);
    const auto [defects, result] = mend(turned);
    expect_defects(defects, only(&SurfaceDefects::flipped_triangles, 1));
    expect_same(result.surface, s);
    EXPECT_EQ(locked_originals(result), Numbers{});
  }
}

TEST(SurfaceDefinition, FewerTrianglesFollowTheMore) {
  Surface s = sphere(2);
  for (std::size_t t = 1; t < s.triangles.size(); ++t) std::swap(s.triangles[t][1], s.triangles[t][2]);
  EXPECT_EQ(mend(s).defects.flipped_triangles, 1U);  // the first, though the others are wound inwards
  EXPECT_EQ(mend(s).result.surface.triangles[1], s.triangles[1]);
  // Of as many, those unlike the first.
  const auto [defects, result] = mend(drawing(4, {{0, 1, 2}, {1, 2, 3}}));
  expect_defects(defects, only(&SurfaceDefects::flipped_triangles, 1));
  EXPECT_EQ(result.surface.triangles, (Triangles{{0, 1, 2}, {1, 3, 2}}));
}

TEST(SurfaceDefinition, MoebiusStripIsCutWhereItsEndsMeet) {
  const Surface s = with_numbers(moebius(12));
  const auto [defects, result] = mend(s);
  expect_defects(defects, only(&SurfaceDefects::unorientable_edges, 2));
  expect_carried(s, result);
  EXPECT_EQ(original_triangles(result), s.triangles);
  EXPECT_EQ(locked_originals(result), (Numbers{0, 0, 1, 1, 2, 2}));
  EXPECT_TRUE(is_manifold(result.surface));
  EXPECT_EQ(euler_characteristic(result.surface), 1);  // a plain strip

  Surface turned = s;
  std::swap(turned.triangles[20][1], turned.triangles[20][2]);
  SurfaceDefects wanted = only(&SurfaceDefects::unorientable_edges, 2);
  wanted.flipped_triangles = 1;
  const Mended back = mend(turned);
  expect_defects(back.defects, wanted);
  expect_same(back.result.surface, result.surface);
}

TEST(SurfaceDefinition, UnreferencedVerticesAreRemoved) {
  const Surface s = drawing(7, {{1, 3, 6}, {3, 1, 4}});
  const auto [defects, result] = mend(s);
  expect_defects(defects, only(&SurfaceDefects::unreferenced_vertices, 3));
  EXPECT_EQ(result.original_vertex, (Numbers{1, 3, 4, 6}));
  EXPECT_EQ(result.surface.triangles, (Triangles{{0, 1, 3}, {1, 0, 2}}));
  expect_carried(s, result);
  EXPECT_EQ(mend(drawing(3, {})).defects.unreferenced_vertices, 3U);
}

TEST(SurfaceDefinition, WhatIsNoSurfaceIsRefused) {
  SurfaceDefects defects;
  const Surface s = drawing(4, tetrahedron);
  Surface bad = s;
  bad.triangles[2][1] = 4;
  EXPECT_THROW(manifold_of(bad, defects), InputError);
  for (const double x : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    bad = s;
    bad.position[3][2] = x;
    EXPECT_THROW(manifold_of(bad, defects), InputError);
    bad = s;
    bad.attributes[1].values[5] = static_cast<float>(x);
    EXPECT_THROW(manifold_of(bad, defects), InputError);
  }
  bad = s;
  bad.attributes[1].values.pop_back();
  EXPECT_THROW(manifold_of(bad, defects), InputError);
}

// ---------------------------------------------------------------- random triangles

std::size_t below(std::mt19937_64& generator, std::size_t n) { return generator() % n; }

/// Any triangles over a few vertices.
Surface random_soup(std::mt19937_64& generator) {
  const std::size_t n_vertices = 3 + below(generator, 12);
  Triangles triangles(1 + below(generator, 40));
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = static_cast<std::uint32_t>(below(generator, n_vertices));
  return drawing(n_vertices, std::move(triangles));
}

/// A surface with triangles turned over, taken away and doubled, and vertices made one.
Surface random_damage(std::mt19937_64& generator) {
  const std::array<Surface, 4> shapes{sphere(2), torus(5, 4), open_sheet(4), moebius(9)};
  Surface s = with_normals(with_numbers(shapes[below(generator, shapes.size())]));
  for (std::size_t n = below(generator, 6); n > 0; --n) {
    Triangle& t = s.triangles[below(generator, s.triangles.size())];
    std::swap(t[1], t[2]);
  }
  for (std::size_t n = below(generator, 4); n > 0; --n)
    s.triangles.erase(s.triangles.begin() + static_cast<std::ptrdiff_t>(below(generator, s.triangles.size())));
  for (std::size_t n = below(generator, 3); n > 0; --n) {
    const auto a = static_cast<std::uint32_t>(below(generator, s.position.size()));
    const auto b = static_cast<std::uint32_t>(below(generator, s.position.size()));
    for (Triangle& t : s.triangles) std::replace(t.begin(), t.end(), a, b);
  }
  if (below(generator, 2) == 0) s.triangles.push_back(s.triangles[below(generator, s.triangles.size())]);
  std::shuffle(s.triangles.begin(), s.triangles.end(), generator);
  return s;
}

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

bool is_turned(const Triangle& from, const Triangle& to) {
  const auto first = static_cast<std::size_t>(std::find(to.begin(), to.end(), from[0]) - to.begin());
  return to[(first + 1) % 3] != from[1];
}

/// Those with three different vertices, the first of each.
Triangles triangles_to_keep(const Surface& s) {
  Triangles kept;
  std::set<Triangle> seen;
  for (const Triangle& t : s.triangles)
    if (std::set<std::uint32_t>(t.begin(), t.end()).size() == 3 && seen.insert(sorted(t)).second) kept.push_back(t);
  return kept;
}

/// Triangles on both sides of edges that have two.
std::vector<std::array<std::size_t, 2>> neighbours(const Triangles& triangles) {
  std::map<std::array<std::uint32_t, 2>, std::vector<std::size_t>> at_edge;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b, c] = sorted(triangles[t]);
    for (const auto& edge : {std::array{a, b}, std::array{b, c}, std::array{a, c}}) at_edge[edge].push_back(t);
  }
  std::vector<std::array<std::size_t, 2>> pairs;
  for (const auto& [edge, both] : at_edge)
    if (both.size() == 2) pairs.push_back({both[0], both[1]});
  return pairs;
}

bool agree(const Triangle& a, const Triangle& b) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      if (a[i] == b[(j + 1) % 3] && a[(i + 1) % 3] == b[j]) return true;
  return false;
}

/// No part has a triangle that would have to be on both sides: node t stands for it as it is, n + t for it turned.
bool is_orientable(const Triangles& triangles) {
  const std::size_t n = triangles.size();
  UnionFind nodes(2 * n);
  for (const auto& [t, u] : neighbours(triangles)) {
    const bool is_like = agree(triangles[t], triangles[u]);
    nodes.unite(t, is_like ? u : n + u);
    nodes.unite(n + t, is_like ? n + u : u);
  }
  for (std::size_t t = 0; t < n; ++t)
    if (nodes.find(t) == nodes.find(n + t)) return false;
  return true;
}

void expect_orientation_by_majority(const Triangles& before, const Triangles& after,
                                    const SurfaceDefects& defects) {
  UnionFind parts(before.size());
  std::uint64_t n_disagreeing = 0, n_turned = 0;
  for (const auto& [t, u] : neighbours(before)) {
    parts.unite(t, u);
    n_disagreeing += agree(after[t], after[u]) ? 0 : 1;
  }
  std::vector<int> majority(before.size());
  for (std::size_t t = 0; t < before.size(); ++t) {
    const bool turned = is_turned(before[t], after[t]);
    n_turned += turned ? 1 : 0;
    majority[parts.find(t)] += turned ? -1 : 1;
  }
  EXPECT_EQ(defects.flipped_triangles, n_turned);
  EXPECT_EQ(defects.unorientable_edges, n_disagreeing);
  EXPECT_EQ(n_disagreeing == 0, is_orientable(before));
  EXPECT_TRUE(std::none_of(majority.begin(), majority.end(), [](int n) { return n < 0; }));
}

/// Locked is what was cut apart or ends an edge with more than two triangles, nothing else.
void expect_locked_where_bad(const Surface& kept, const ManifoldSurface& result) {
  std::vector<int> n_copies(kept.position.size());
  for (const std::uint32_t v : result.original_vertex) ++n_copies[v];
  std::vector<bool> is_bad(kept.position.size());
  for (std::size_t v = 0; v < n_copies.size(); ++v) is_bad[v] = n_copies[v] > 1;
  for (const EdgeUse& use : edge_uses(kept))
    if (use.forward + use.backward > 2) is_bad[use.edge[0]] = is_bad[use.edge[1]] = true;
  for (std::size_t v = 0; v < result.is_locked.size(); ++v)
    EXPECT_EQ(result.is_locked[v] != 0, is_bad[result.original_vertex[v]]);
}

void expect_mended(const Surface& s, const SurfaceDefects& defects, const ManifoldSurface& result) {
  EXPECT_TRUE(is_manifold(result.surface));
  expect_carried(s, result);
  const Triangles wanted = triangles_to_keep(s), is = original_triangles(result);
  ASSERT_EQ(is.size(), wanted.size());
  for (std::size_t t = 0; t < is.size(); ++t) ASSERT_EQ(sorted(is[t]), sorted(wanted[t]));
  expect_orientation_by_majority(wanted, is, defects);

  const Surface kept{s.position, wanted, {}};
  expect_locked_where_bad(kept, result);
  const std::vector<EdgeUse> uses = edge_uses(kept);
  EXPECT_EQ(defects.non_manifold_edges,
            static_cast<std::uint64_t>(std::count_if(
                uses.begin(), uses.end(), [](const EdgeUse& use) { return use.forward + use.backward > 2; })));
  EXPECT_EQ(defects.non_manifold_vertices, count_pinched_vertices(kept));
  std::set<std::uint32_t> used;
  for (const Triangle& t : wanted) used.insert(t.begin(), t.end());
  EXPECT_EQ(defects.unreferenced_vertices, s.position.size() - used.size());

  const auto [defects_again, again] = mend(result.surface);
  expect_same(again.surface, result.surface);
  EXPECT_EQ(locked_originals(again), Numbers{});
}

TEST(SurfaceDefinition, AnyTrianglesBecomeManifoldAndNoneIsLost) {
  constexpr int kRounds = 1500;
  constexpr std::array kKinds{&SurfaceDefects::duplicated_triangles,  &SurfaceDefects::degenerate_triangles,
                              &SurfaceDefects::flipped_triangles,     &SurfaceDefects::non_manifold_edges,
                              &SurfaceDefects::non_manifold_vertices, &SurfaceDefects::unorientable_edges,
                              &SurfaceDefects::unreferenced_vertices};
  std::array<int, kKinds.size()> n_with{};  // rounds with a defect of the kind
  for (int seed = 0; seed < kRounds && !HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
    const Surface s = seed % 2 == 0 ? random_soup(generator) : random_damage(generator);
    const auto [defects, result] = mend(s);
    expect_mended(s, defects, result);
    for (std::size_t k = 0; k < kKinds.size(); ++k) n_with[k] += defects.*kKinds[k] > 0 ? 1 : 0;
  }
  for (const int n : n_with) EXPECT_GE(n, kRounds / 20);
}

/// The same with one more vertex at the end, without triangles: it is never taken as it is.
Surface with_lone_vertex(Surface s) {
  s.position.push_back({-1, -1, -1});
  for (SurfaceAttribute& a : s.attributes)
    a.values.resize(a.values.size() + static_cast<std::size_t>(a.components()));
  return s;
}

TEST(SurfaceDefinition, WhatIsTakenAsItIsIsWhatMendingLeaves) {
  for (int seed = 0; seed < 1500 && !HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 generator(static_cast<std::uint64_t>(seed));
    const Surface any = seed % 2 == 0 ? random_soup(generator) : random_damage(generator);
    for (const Surface& s : {any, mend(any).result.surface}) {
      auto [defects, result] = mend(s);
      const auto [with_lone, wanted] = mend(with_lone_vertex(s));
      ++defects.unreferenced_vertices;
      expect_defects(defects, with_lone);
      expect_same(result.surface, wanted.surface);
      EXPECT_EQ(result.original_vertex, wanted.original_vertex);
      EXPECT_EQ(result.is_locked, wanted.is_locked);
    }
  }
}

TEST(SurfaceDefinition, FanThatMeetsANeighbourTwiceIsNoSurface) {
  // Around vertex 0 one fan of five triangles, that has three at the edge to vertex 1.
  const Surface s = drawing(6, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 4}, {0, 4, 5}});
  EXPECT_EQ(mend(s).defects.non_manifold_edges, 1U);
}

}  // namespace
}  // namespace tinsmith::test
