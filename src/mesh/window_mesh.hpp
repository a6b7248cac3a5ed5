#pragma once
// The mesh that a window task works on: triangles with their neighbours, 32-bit indices.
//
// Invariant beyond those of Halfedges: I2 every triangle is counter-clockwise in plan.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/colour.hpp"
#include "geometry/lattice.hpp"
#include "mesh/halfedges.hpp"
#include "mesh/vertex_kind.hpp"

namespace tinsmith {

struct WindowMesh : Halfedges {
  // by vertex
  std::vector<LatticePoint> position;
  std::vector<double> height;
  std::vector<VertexKind> kind;
  std::vector<std::uint8_t> is_settled;  // was free among free neighbours in an earlier round
  std::vector<Levels> colour;            // empty: the surface has none

  std::int32_t n_vertices() const { return static_cast<std::int32_t>(position.size()); }
};

/// A point of the surface.
struct Place {
  LatticePoint position;
  double height = 0;
};

/// Fills origin, twin and out from triangles over the vertices already in the mesh, and splits every vertex
/// with more than one fan into one vertex a fan (marked: kind kLocked). Other kinds are left to the caller.
void connect(WindowMesh& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles);

/// As for Halfedges; `kept` moves to `place`.
void collapse_edge(WindowMesh& mesh, std::int32_t h, std::int32_t kept, const Place& place);

/// Empty when all invariants hold, else the first broken one with its place. For tests: O(n).
std::string validate(const WindowMesh& mesh);

}  // namespace tinsmith
