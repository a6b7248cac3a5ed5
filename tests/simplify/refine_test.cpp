// Refinement: vertex moves and edge flips keep every promise, and lower the squared error.

#include "simplify/refine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "samples/array_field.hpp"
#include "samples/triangle_error.hpp"
#include "simplify/simplify.hpp"
#include "stitch/kinds.hpp"
#include "support/mesh_drawings.hpp"
#include "support/random_grid.hpp"
#include "support/surface_check.hpp"
#include "triangulate/triangulate.hpp"

namespace tinsmith {
namespace {

using namespace test;

// A square of 4 x 4 cells around its middle, cut along its falling diagonal; heights bend along the rising one.
HeightGrid roof(double height) {
  HeightGrid grid{{0, 0, 5, 5}, std::vector<double>(25)};
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x)
      grid.z[static_cast<std::size_t>(y) * 5 + static_cast<std::size_t>(x)] = height * std::abs(x - y) / 4.0;
  }
  return grid;
}

WindowMesh square_with_wrong_diagonal(double height) {
  WindowMesh mesh;
  mesh.position = {{0, 0}, {64, 0}, {64, 64}, {0, 64}};
  mesh.height = {0, height, 0, height};
  mesh.is_settled.assign(4, 0);
  connect(mesh, {{0, 1, 3}, {1, 2, 3}});
  return mesh;
}

std::int32_t inner_halfedge(const WindowMesh& mesh) {
  std::int32_t h = 0;
  while (mesh.is_border_edge(h)) ++h;
  return h;
}

std::vector<float> nothing_known(const WindowMesh& mesh) {
  return std::vector<float>(mesh.origin.size() / 3, std::numeric_limits<float>::quiet_NaN());
}

TEST(ImproveEdge, TakesTheDiagonalThatFollowsTheTerrain) {
  const HeightGrid grid = roof(8);
  WindowMesh mesh = square_with_wrong_diagonal(8);
  std::vector<float> squared_error = nothing_known(mesh);
  EXPECT_TRUE(improve_edge(mesh, {grid, 10}, inner_halfedge(mesh), squared_error));
  EXPECT_EQ(validate(mesh), "");
  const std::int32_t h = inner_halfedge(mesh);
  EXPECT_EQ(mesh.origin[static_cast<std::size_t>(h)] % 2, 0);
  EXPECT_EQ(mesh.destination(h) % 2, 0);
  squared_error = nothing_known(mesh);
  EXPECT_FALSE(improve_edge(mesh, {grid, 10}, h, squared_error));  // and stays there
}

TEST(ImproveEdge, KeepsAnEdgeWhoseOtherDiagonalLiesOutside) {
  const HeightGrid grid = roof(8);
  WindowMesh mesh = square_with_wrong_diagonal(8);
  mesh.position[3] = {60, 6};  // just above the line from vertex 0 to vertex 2, which now leaves the quadrilateral
  ASSERT_EQ(validate(mesh), "");
  std::vector<float> squared_error = nothing_known(mesh);
  EXPECT_FALSE(improve_edge(mesh, {grid, 10}, inner_halfedge(mesh), squared_error));
}

// A pyramid is a star around its top.
TEST(ImproveVertex, FindsTheTopOfAPyramidFromBesideIt) {
  HeightGrid grid{{0, 0, 17, 17}, std::vector<double>(289)};
  for (int y = 0; y < 17; ++y) {
    for (int x = 0; x < 17; ++x)
      grid.z[static_cast<std::size_t>(y) * 17 + static_cast<std::size_t>(x)] =
          40 - 5.0 * std::max(std::abs(x - 8), std::abs(y - 8));
  }
  WindowMesh mesh;
  constexpr std::int32_t kSide = 16 * kLatticePerCell;
  mesh.position = {{0, 0}, {kSide, 0}, {kSide, kSide}, {0, kSide}, {kSide / 2 + 45, kSide / 2 - 21}};
  mesh.height = {0, 0, 0, 0, 25};
  mesh.is_settled.assign(5, 0);
  connect(mesh, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  mesh.kind = {VertexKind::kCorner, VertexKind::kCorner, VertexKind::kCorner, VertexKind::kCorner,
               VertexKind::kInterior};
  Star star;
  int n_steps = 0;
  while (improve_vertex(mesh, {grid, 40}, 4, star)) ++n_steps;
  EXPECT_LE(n_steps, 6);
  EXPECT_EQ(mesh.position[4], (LatticePoint{kSide / 2, kSide / 2}));
  EXPECT_NEAR(mesh.height[4], 40, 1e-9);
}

TEST(FlipEdge, KeepsTheMeshValidAnywhere) {
  WindowMesh mesh = triangulate(around(mountains(49, 49, 901), {0, 0, 49, 49}), {0, 0, 49, 49}, {40, 1});
  int n_flips = 0;
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.is_border_edge(h)) continue;
    const auto apex = [&](std::int32_t e) {
      return mesh
          .position[static_cast<std::size_t>(mesh.origin[static_cast<std::size_t>(WindowMesh::previous(e))])];
    };
    const std::int32_t g = mesh.twin[static_cast<std::size_t>(h)];
    const LatticePoint a = mesh.position[static_cast<std::size_t>(mesh.origin[static_cast<std::size_t>(h)])];
    const LatticePoint b = mesh.position[static_cast<std::size_t>(mesh.destination(h))];
    if (orient(apex(g), apex(h), a) <= 0 || orient(apex(h), apex(g), b) <= 0) continue;
    flip_edge(mesh, h);
    ++n_flips;
    ASSERT_EQ(validate(mesh), "") << "halfedge " << h;
  }
  EXPECT_GT(n_flips, 100);
}

// Rounding is the caller's to take off the tolerance.
constexpr double kTolerance = 10;
constexpr double kRounding = 1e-11;

TEST(Refinement, LowersTriangleCountAndErrorAndKeepsEveryPromise) {
  for (const Mask mask : {Mask::kNone, Mask::kSparse}) {
    const HeightGrid grid = mountains(97, 97, 902, mask);
    const GridRect window{0, 0, 97, 97};
    std::size_t before = 0;
    for (const int refinements : {0, 1, 4}) {
      WindowMesh mesh = triangulate(around(grid, window), window, {10, 1});
      set_kinds(mesh, around(grid, window));
      const SimplifyCounts counts =
          simplify(mesh, around(grid, window), {kTolerance, Placement::kOptimal, {refinements}, false});
      EXPECT_EQ(validate(mesh), "");
      EXPECT_EQ(complaints(check_surface(mesh, grid), kTolerance + kRounding), "");
      std::size_t n = 0;
      for (std::size_t h = 0; h < mesh.origin.size(); h += 3) n += mesh.origin[h] != kNone ? 1 : 0;
      if (refinements > 0) {
        EXPECT_GT(counts.moves, 100U);
        EXPECT_GT(counts.flips, 50U);
        EXPECT_LT(n, before);
      }
      before = n;
    }
  }
}

TEST(Roughness, LowersTheSquaredErrorAndKeepsThePromise) {
  const HeightGrid grid = mountains(97, 97, 904);
  const GridRect window{0, 0, 97, 97};
  const auto mean_square = [&](double roughness) {
    WindowMesh mesh = triangulate(around(grid, window), window, {10, 1});
    set_kinds(mesh, around(grid, window));
    simplify(mesh, around(grid, window),
             {kTolerance, Placement::kOptimal, {0, Labour::kNoLimit, roughness}, false});
    EXPECT_EQ(complaints(check_surface(mesh, grid), kTolerance + kRounding), "");
    double sum = 0;
    for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
      if (mesh.origin[static_cast<std::size_t>(h)] == kNone) continue;
      const auto corner = [&](std::int32_t e) {
        const auto v = static_cast<std::size_t>(mesh.origin[static_cast<std::size_t>(e)]);
        return Corner{mesh.position[v], mesh.height[v]};
      };
      sum += triangle_error(grid, corner(h), corner(h + 1), corner(h + 2)).sum_of_squares;
    }
    return sum / (96 * 96);
  };
  const double free = mean_square(Labour::kNoLimit);
  EXPECT_LT(mean_square(0.3), 0.9 * free);
}

TEST(Refinement, OfSubsetPlacementKeepsVerticesOnTheirSamples) {
  const HeightGrid grid = mountains(65, 65, 903);
  const GridRect window{0, 0, 65, 65};
  WindowMesh mesh = triangulate(around(grid, window), window, {10, 1});
  set_kinds(mesh, around(grid, window));
  const SimplifyCounts counts = simplify(mesh, around(grid, window), {10, Placement::kSubset, {2}, false});
  EXPECT_GT(counts.flips, 20U);
  EXPECT_EQ(counts.moves, 0U);
  for (std::int32_t v = 0; v < mesh.n_vertices(); ++v) {
    if (!mesh.is_alive(v)) continue;
    const LatticePoint p = mesh.position[static_cast<std::size_t>(v)];
    ASSERT_TRUE(is_sample_position(p));
    EXPECT_EQ(mesh.height[static_cast<std::size_t>(v)], grid.at(p.x / kLatticePerCell, p.y / kLatticePerCell));
  }
}

}  // namespace
}  // namespace tinsmith
