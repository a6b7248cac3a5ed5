#include "mesh/window_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "support/mesh_drawings.hpp"

namespace tinsmith {
namespace {

using namespace test;

TEST(Connect, ClosesTheFanAroundAnInnerVertex) {
  const WindowMesh mesh = hexagon();
  EXPECT_EQ(validate(mesh), "");
  EXPECT_EQ(fan_size(mesh, 0), 6);
  EXPECT_FALSE(mesh.is_border_vertex(0));
  for (std::int32_t v = 1; v <= 6; ++v) {
    EXPECT_TRUE(mesh.is_border_vertex(v));
    EXPECT_EQ(fan_size(mesh, v), 2);
  }
}

TEST(Connect, StartsAnOpenFanAtItsBorder) {
  // 0 (0,0) is the middle of the lower side; the fan around it is open.
  const WindowMesh mesh =
      drawn({{0, 0}, {64, 0}, {48, 48}, {-48, 48}, {-64, 0}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  EXPECT_EQ(validate(mesh), "");
  EXPECT_TRUE(mesh.is_border_vertex(0));
  EXPECT_EQ(mesh.destination(mesh.out[0]), 1);
  EXPECT_EQ(fan_size(mesh, 0), 3);
  EXPECT_EQ(n_twinless(mesh), 5);
}

TEST(Connect, SplitsAPinchIntoLockedVerticesOfOneFanEach) {
  // Two triangles that touch in vertex 0 only.
  const WindowMesh mesh = drawn({{0, 0}, {32, 16}, {32, 32}, {-32, -16}, {-32, -32}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(validate(mesh), "");
  ASSERT_EQ(mesh.n_vertices(), 6);
  EXPECT_EQ(mesh.position[5], mesh.position[0]);
  EXPECT_EQ(mesh.height[5], mesh.height[0]);
  EXPECT_EQ(mesh.kind[0], VertexKind::kLocked);
  EXPECT_EQ(mesh.kind[5], VertexKind::kLocked);
  for (const std::int32_t v : {1, 2, 3, 4})
    EXPECT_EQ(mesh.kind[static_cast<std::size_t>(v)], VertexKind::kInterior);
  EXPECT_EQ(fan_size(mesh, 0), 1);
  EXPECT_EQ(fan_size(mesh, 5), 1);
}

TEST(Connect, SplitsThreeFansIntoThreeVertices) {
  const WindowMesh mesh = drawn({{0, 0}, {32, 0}, {32, 16}, {-16, 32}, {-32, 32}, {-32, -32}, {0, -32}},
                                {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}});
  EXPECT_EQ(validate(mesh), "");
  EXPECT_EQ(mesh.n_vertices(), 9);
  EXPECT_EQ(std::count(mesh.kind.begin(), mesh.kind.end(), VertexKind::kLocked), 3);
}

TEST(Connect, LeavesVerticesWithoutTriangleDead) {
  const WindowMesh mesh = drawn({{0, 0}, {16, 0}, {0, 16}, {99, 99}}, {{0, 1, 2}});
  EXPECT_EQ(validate(mesh), "");
  EXPECT_FALSE(mesh.is_alive(3));
}

// The two hexagons' centres 0 and 1 share an edge; both ends may survive.
TEST(CollapseEdge, JoinsTwoClosedFansAtEitherEnd) {
  for (const bool keep_origin : {true, false}) {
    WindowMesh mesh = grid_mesh(6, 4);
    const std::int32_t v0 = 6 + 2;
    const std::int32_t v1 = 6 + 3;
    const Place place{{2 * 16 + 8, 16}, 7.5};
    const std::int32_t kept = keep_origin ? v0 : v1;
    const std::int32_t gone = keep_origin ? v1 : v0;
    const std::int64_t area2 = area2_of(mesh);
    const std::int64_t triangles = n_triangles(mesh);
    collapse_edge(mesh, halfedge(mesh, v0, v1), kept, place);
    EXPECT_EQ(validate(mesh), "");
    EXPECT_FALSE(mesh.is_alive(gone));
    EXPECT_EQ(mesh.position[static_cast<std::size_t>(kept)], place.position);
    EXPECT_EQ(mesh.height[static_cast<std::size_t>(kept)], place.height);
    EXPECT_EQ(fan_size(mesh, kept), 8);
    EXPECT_EQ(n_triangles(mesh), triangles - 2);
    EXPECT_EQ(area2_of(mesh), area2);
    EXPECT_EQ(euler_number(mesh), 1);
  }
}

TEST(CollapseEdge, RemovesABorderEdgeWithItsOneTriangle) {
  for (const bool keep_origin : {true, false}) {
    WindowMesh mesh = grid_mesh(5, 3);
    const std::int32_t kept = keep_origin ? 1 : 2;
    const std::int64_t area2 = area2_of(mesh);
    collapse_edge(mesh, halfedge(mesh, 1, 2), kept, {{24, 0}, 0});
    EXPECT_EQ(validate(mesh), "");
    EXPECT_EQ(n_triangles(mesh), 2 * 4 * 2 - 1);
    EXPECT_EQ(area2_of(mesh), area2);
    EXPECT_TRUE(mesh.is_border_vertex(kept));
    EXPECT_EQ(euler_number(mesh), 1);
  }
}

TEST(CollapseEdge, MovesAnInnerVertexOntoTheBorder) {
  WindowMesh mesh = grid_mesh(5, 4);
  const std::int64_t area2 = area2_of(mesh);
  collapse_edge(mesh, halfedge(mesh, 5 + 2, 2), 2, {mesh.position[2], 0});
  EXPECT_EQ(validate(mesh), "");
  EXPECT_TRUE(mesh.is_border_vertex(2));
  EXPECT_EQ(area2_of(mesh), area2);
  EXPECT_EQ(euler_number(mesh), 1);
}

// 3 lies inside the triangle 0 1 2, with three triangles around it.
TEST(CollapseEdge, RemovesAVertexOfValenceThree) {
  for (const std::int32_t into : {0, 1, 2}) {
    WindowMesh mesh = drawn({{0, 0}, {96, 0}, {0, 96}, {32, 32}}, {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    collapse_edge(mesh, halfedge(mesh, 3, into), into, {mesh.position[static_cast<std::size_t>(into)], 0});
    EXPECT_EQ(validate(mesh), "");
    EXPECT_EQ(n_triangles(mesh), 1);
    EXPECT_EQ(area2_of(mesh), 96 * 96);
    EXPECT_EQ(n_twinless(mesh), 3);
  }
}

// The apex of the edge's left triangle hangs on it with its last neighbour on the other side: its `out` moves on.
TEST(CollapseEdge, KeepsTheApexOnItsBorder) {
  WindowMesh mesh = drawn({{0, 0}, {64, 0}, {32, 32}, {96, 48}}, {{0, 1, 2}, {1, 3, 2}});
  collapse_edge(mesh, halfedge(mesh, 0, 1), 1, {{64, 0}, 0});
  EXPECT_EQ(validate(mesh), "");
  EXPECT_EQ(n_triangles(mesh), 1);
  EXPECT_TRUE(mesh.is_border_vertex(2));
}

TEST(Validate, NamesEachBrokenInvariant) {
  const WindowMesh whole = grid_mesh(4, 4);
  ASSERT_EQ(validate(whole), "");
  const std::int32_t h = halfedge(whole, 5, 6);
  const auto i = static_cast<std::size_t>(h);
  const auto broken = [&](auto&& damage) {
    WindowMesh mesh = whole;
    damage(mesh);
    return validate(mesh).substr(0, 2);
  };
  EXPECT_EQ(broken([&](WindowMesh& m) { m.twin[i] = 0; }), "I1");
  EXPECT_EQ(broken([&](WindowMesh& m) {  // two pairs of twins, crossed
              std::swap(m.twin[i], m.twin[i + 1]);
              m.twin[static_cast<std::size_t>(m.twin[i])] = h;
              m.twin[static_cast<std::size_t>(m.twin[i + 1])] = h + 1;
            }),
            "I1");
  EXPECT_EQ(broken([&](WindowMesh& m) { m.position[5] = m.position[15]; }), "I2");
  EXPECT_EQ(broken([&](WindowMesh& m) { m.position[5] = m.position[6]; }), "I2");
  EXPECT_NE(broken([&](WindowMesh& m) { m.out[5] = kNone; }), "");
  EXPECT_NE(broken([&](WindowMesh& m) { m.out[5] = m.out[6]; }), "");
  // On a border the fan has to begin at the halfedge without twin, else it is not met whole.
  EXPECT_NE(broken([&](WindowMesh& m) { m.out[1] = m.turn(m.out[1]); }), "");
}

}  // namespace
}  // namespace tinsmith
