#pragma once
// What a window task leaves: a piece of the surface. A vertex is known everywhere by its place on the lattice,
// of which there is one height and one colour only (at a pinch, too): pieces need no numbers in common to be
// welded.

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/colour.hpp"
#include "geometry/lattice.hpp"
#include "mesh/window_mesh.hpp"
#include "tile/windows.hpp"

namespace tinsmith {

struct Chunk {
  std::vector<LatticePoint> position;
  std::vector<double> height;
  std::vector<std::uint8_t> is_settled;  // see WindowMesh
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<Levels> colour;  // by vertex; empty: the surface has none

  bool is_empty() const { return triangles.empty(); }
};

/// A chunk's triangles with their neighbours; kinds are not set.
WindowMesh mesh_of(Chunk&& chunk);

/// The live part of a mesh. Settled from now on is what was free and had no locked neighbour.
Chunk chunk_of(WindowMesh&& mesh);

/// The part of a chunk that belongs to a window, for each window that it touches, in the order of the windows.
struct ChunkPart {
  std::int64_t window = 0;
  Chunk chunk;
};
std::vector<ChunkPart> split(const Chunk& chunk, const WindowGrid& windows);

/// One chunk of several, all with colours or none: vertices at the same place become one. Vertices are sorted by
/// place.
Chunk weld(const std::vector<const Chunk*>& parts);

}  // namespace tinsmith
