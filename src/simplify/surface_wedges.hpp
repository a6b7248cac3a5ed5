#pragma once
// What a collapse does to the wedges of its ends: which become one, and what undoes that.

#include <array>
#include <cstddef>

#include "simplify/simplified_mesh.hpp"
#include "simplify/surface_attributes.hpp"
#include "simplify/surface_mesh.hpp"

namespace tinsmith {

/// One or two pairs of wedges, w0 at the origin and w1 at the destination of the collapsed edge.
struct WedgePairs {
  std::array<WedgePair, 2> pair;
  std::size_t n = 0;

  const WedgePair* begin() const { return pair.data(); }
  const WedgePair* end() const { return pair.data() + n; }
};

/// The pairs that the collapse of h makes one: those of its left triangle, and of its right one if they differ.
WedgePairs wedge_pairs(const SurfaceMesh& mesh, std::int32_t h);

/// Of the pair the wedge at the end of h that stays (0: its origin, 1: its destination), and the other one.
inline std::int32_t kept_of(const WedgePair& pair, int kept_end) { return kept_end == 0 ? pair.w0 : pair.w1; }
inline std::int32_t gone_of(const WedgePair& pair, int kept_end) { return kept_end == 0 ? pair.w1 : pair.w0; }

/// The vertex of h that goes when the given end stays.
std::int32_t gone_vertex(const SurfaceMesh& mesh, std::int32_t h, int kept_end);

/// Whether every wedge of the vertex that goes has a partner at the one that stays.
bool has_partners(const SurfaceMesh& mesh, std::int32_t h, int kept_end);

/// What undoes the collapse: for each wedge that goes the triangles that change hands, and the triangles that go.
/// To be asked before the collapse.
SurfaceCollapse noted_collapse(const SurfaceMesh& mesh, std::int32_t h, int kept_end);

/// Gives the corners of one wedge around a vertex to another wedge.
void hand_over(SurfaceMesh& mesh, std::int32_t vertex, std::int32_t from, std::int32_t to);

}  // namespace tinsmith
