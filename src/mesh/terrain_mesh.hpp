#pragma once
// The finished surface of a grid: an indexed triangle mesh on the lattice.

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/lattice.hpp"

namespace tinsmith {

/// Triangles are counter-clockwise in the grid frame (see lattice.hpp); heights are in the vertical unit of
/// the input. Vertices that pinch the surface (two fans at one place) are there once for each fan.
struct TerrainMesh {
  std::vector<LatticePoint> position;
  std::vector<double> height;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace tinsmith
