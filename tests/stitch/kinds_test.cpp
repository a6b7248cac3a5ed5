#include "stitch/kinds.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/mesh_drawings.hpp"
#include "support/random_grid.hpp"

namespace tinsmith {
namespace {

using namespace test;

constexpr auto kI = VertexKind::kInterior;
constexpr auto kB = VertexKind::kBorder;
constexpr auto kC = VertexKind::kCorner;
constexpr auto kL = VertexKind::kLocked;

HeightGrid flat(std::int32_t width, std::int32_t height, const std::vector<LatticePoint>& voids = {}) {
  HeightGrid grid = grid_of(width, height, [](int, int) { return 1.0; });
  for (const LatticePoint p : voids)
    grid.z[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(p.x)] = kVoid;
  return grid;
}

// The mesh of the part of a grid that begins at (0, 0), with the kinds that the whole grid gives it.
WindowMesh mesh_with_kinds(const HeightGrid& grid, std::int32_t columns, std::int32_t rows) {
  WindowMesh mesh = full_mesh(GridField(grid).read({0, 0, columns, rows}));
  set_kinds(mesh, GridField(grid).read({-1, -1, grid.rect.width + 2, grid.rect.height + 2}));
  return mesh;
}

// Kinds of live vertices, row by row.
std::vector<VertexKind> kinds_of(const WindowMesh& mesh) {
  std::vector<VertexKind> kinds;
  for (std::int32_t v = 0; v < mesh.n_vertices(); ++v) {
    if (mesh.is_alive(v)) kinds.push_back(mesh.kind[static_cast<std::size_t>(v)]);
  }
  return kinds;
}

TEST(SetKinds, OfAWholeRasterAreCornersBorderAndInterior) {
  EXPECT_EQ(kinds_of(mesh_with_kinds(flat(4, 3), 4, 3)), (std::vector{kC, kB, kB, kC,  //
                                                                      kB, kI, kI, kB,  //
                                                                      kC, kB, kB, kC}));
}

TEST(SetKinds, LockASeamAndItsEnds) {
  EXPECT_EQ(kinds_of(mesh_with_kinds(flat(8, 3), 4, 3)), (std::vector{kC, kB, kB, kL,  //
                                                                      kB, kI, kI, kL,  //
                                                                      kC, kB, kB, kL}));
  EXPECT_EQ(kinds_of(mesh_with_kinds(flat(4, 7), 4, 3)), (std::vector{kC, kB, kB, kC,  //
                                                                      kB, kI, kI, kB,  //
                                                                      kL, kL, kL, kL}));
}

// Along column 3 there are no cells of another window in rows 0 and 1: rim of a void first, then seam.
TEST(SetKinds, FreeTheVerticesOfASeamlineWhereAVoidLiesBeyond) {
  EXPECT_EQ(kinds_of(mesh_with_kinds(flat(8, 5, {{4, 1}}), 4, 5)), (std::vector{kC, kB, kB, kC,  //
                                                                                kB, kI, kI, kB,  //
                                                                                kB, kI, kI, kL,  //
                                                                                kB, kI, kI, kL,  //
                                                                                kC, kB, kB, kL}));
}

TEST(SetKinds, MakeCornersWhereTheOutlineTurnsInAndOut) {
  // The sample (3, 0) is void: the cell (2, 0) is not there.
  EXPECT_EQ(kinds_of(mesh_with_kinds(flat(4, 3, {{3, 0}}), 4, 3)), (std::vector{kC, kB, kC,      //
                                                                                kB, kI, kC, kC,  //
                                                                                kC, kB, kB, kC}));
}

TEST(SetKinds, LockBothVerticesOfAPinch) {
  // Cells (0, 0) and (1, 1) touch in the sample (1, 1).
  const WindowMesh mesh = mesh_with_kinds(flat(3, 3, {{2, 0}, {0, 2}}), 3, 3);
  int n_locked = 0;
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    if (mesh.position[v] != LatticePoint{16, 16}) continue;
    EXPECT_EQ(mesh.kind[v], kL);
    ++n_locked;
  }
  EXPECT_EQ(n_locked, 2);
}

// The other fan belongs to another window: the mesh does not show that it is a pinch, the samples do.
TEST(SetKinds, LockAPinchWhoseOtherFanIsElsewhere) {
  EXPECT_EQ(kinds_of(mesh_with_kinds(flat(3, 3, {{2, 0}, {0, 2}}), 2, 2)), (std::vector{kC, kC, kC, kL}));
}

TEST(SetKinds, LockWhatIsOffTheLinesOfTheGrid) {
  // One triangle whose hypotenuse runs through valid cells.
  WindowMesh mesh = drawn({{0, 0}, {48, 0}, {0, 48}}, {{0, 1, 2}});
  set_kinds(mesh, GridField(flat(4, 4)).read({-1, -1, 6, 6}));
  EXPECT_EQ(kinds_of(mesh), (std::vector{kC, kL, kL}));
}

// Two places of a border edge between samples: the line still is the outline.
TEST(SetKinds, KnowTheOutlineBetweenSamples) {
  WindowMesh mesh =
      drawn({{0, 0}, {20, 0}, {48, 0}, {48, 48}, {0, 48}, {0, 7}}, {{0, 1, 5}, {1, 2, 3}, {1, 3, 5}, {5, 3, 4}});
  set_kinds(mesh, GridField(flat(4, 4)).read({-1, -1, 6, 6}));
  EXPECT_EQ(kinds_of(mesh), (std::vector{kC, kB, kC, kC, kC, kB}));
}

}  // namespace
}  // namespace tinsmith
