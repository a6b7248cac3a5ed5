#pragma once
// Small meshes drawn by hand, and what can be counted on a mesh.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/window_mesh.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith::test {

inline WindowMesh drawn(const std::vector<LatticePoint>& position,
                        const std::vector<std::array<std::int32_t, 3>>& triangles) {
  WindowMesh mesh;
  mesh.position = position;
  mesh.height.assign(position.size(), 0);
  mesh.is_settled.assign(position.size(), 0);
  connect(mesh, triangles);
  return mesh;
}

/// Vertex 0 in the middle, 1 to 6 around it, counter-clockwise.
inline WindowMesh hexagon() {
  return drawn({{0, 0}, {32, 0}, {16, 28}, {-16, 28}, {-32, 0}, {-16, -28}, {16, -28}},
               {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 6}, {0, 6, 1}});
}

/// Samples of a grid, row by row, each cell cut from its first to its last corner.
inline WindowMesh grid_mesh(std::int32_t columns, std::int32_t rows) {
  std::vector<LatticePoint> position;
  std::vector<std::array<std::int32_t, 3>> triangles;
  for (std::int32_t y = 0; y < rows; ++y) {
    for (std::int32_t x = 0; x < columns; ++x) position.push_back({x * kLatticePerCell, y * kLatticePerCell});
  }
  for (std::int32_t y = 0; y + 1 < rows; ++y) {
    for (std::int32_t x = 0; x + 1 < columns; ++x) {
      const std::int32_t v = y * columns + x;
      triangles.push_back({v, v + 1, v + columns + 1});
      triangles.push_back({v, v + columns + 1, v + columns});
    }
  }
  return drawn(position, triangles);
}

/// Every sample a vertex with its height, every valid cell two triangles: the start that loses nothing. The grid
/// begins at (0, 0).
inline WindowMesh full_mesh(const HeightGrid& grid) {
  WindowMesh mesh;
  std::vector<std::array<std::int32_t, 3>> triangles;
  const std::int32_t columns = grid.rect.width;
  for (std::int32_t y = 0; y < grid.rect.height; ++y) {
    for (std::int32_t x = 0; x < columns; ++x) {
      mesh.position.push_back({x * kLatticePerCell, y * kLatticePerCell});
      mesh.height.push_back(grid.at(x, y));
      const std::int32_t v = y * columns + x;
      if (!grid.is_valid_cell(x, y)) continue;
      triangles.push_back({v, v + 1, v + columns + 1});
      triangles.push_back({v, v + columns + 1, v + columns});
    }
  }
  mesh.is_settled.assign(mesh.position.size(), 0);
  connect(mesh, triangles);
  return mesh;
}

/// The halfedge from a to b; fails the test when there is none.
inline std::int32_t halfedge(const WindowMesh& mesh, std::int32_t a, std::int32_t b) {
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[static_cast<std::size_t>(h)] == a && mesh.destination(h) == b) return h;
  }
  ADD_FAILURE() << "no halfedge from " << a << " to " << b;
  return 0;
}

inline int fan_size(const WindowMesh& mesh, std::int32_t v) {
  int n = 0;
  for_each_out(mesh, v, [&](std::int32_t) { ++n; });
  return n;
}

inline std::int64_t n_triangles(const WindowMesh& mesh) {
  std::int64_t n = 0;
  for (std::size_t h = 0; h < mesh.origin.size(); h += 3) n += mesh.origin[h] == kNone ? 0 : 1;
  return n;
}

inline std::int64_t n_twinless(const WindowMesh& mesh) {
  std::int64_t n = 0;
  for (std::size_t h = 0; h < mesh.origin.size(); ++h)
    n += mesh.origin[h] != kNone && mesh.twin[h] == kNone ? 1 : 0;
  return n;
}

/// Vertices - edges + triangles: 1 for a disk, 0 for a disk with one hole.
inline std::int64_t euler_number(const WindowMesh& mesh) {
  std::int64_t n_vertices = 0;
  for (std::int32_t v = 0; v < mesh.n_vertices(); ++v) n_vertices += mesh.is_alive(v) ? 1 : 0;
  return n_vertices - (3 * n_triangles(mesh) + n_twinless(mesh)) / 2 + n_triangles(mesh);
}

/// Twice the area in lattice units.
inline std::int64_t area2_of(const WindowMesh& mesh) {
  std::int64_t sum = 0;
  for (std::size_t h = 0; h < mesh.origin.size(); h += 3) {
    if (mesh.origin[h] == kNone) continue;
    const auto p = [&](std::size_t k) { return mesh.position[static_cast<std::size_t>(mesh.origin[h + k])]; };
    sum += orient(p(0), p(1), p(2));
  }
  return sum;
}

}  // namespace tinsmith::test
