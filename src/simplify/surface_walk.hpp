#pragma once
// The point of a surface that is nearest to a given one, by walking over the triangles as long as they come nearer.
// It takes a start nearby; where that is wrong, as on the other side of a thin part, what is found is only as near
// as its surroundings.

#include <limits>
#include <vector>

#include "geometry/quadric.hpp"
#include "mesh/halfedges.hpp"

namespace tinsmith {

/// Triangles to walk over; edges and places must outlive it.
struct WalkedSurface {
  const Halfedges& mesh;
  const std::vector<Vec<3>>& position;  // by vertex; there may be more
};

/// The normal, of any length, of the triangle of h.
Vec<3> normal_of(const WalkedSurface& surface, std::int32_t h);

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  std::int32_t halfedge = kNone;  // the first of its triangle
  Vec<3> share{};                 // of the triangle's corners
  Vec<3> off{};                   // from there to the point that was asked for
};

/// To p, from the triangle whose first halfedge is given; kNone: from those around the vertex v. Ends where the
/// squared distance is at most `enough`.
Nearest nearest(const WalkedSurface& surface, const Vec<3>& p, std::int32_t triangle, std::int32_t v,
                double enough = 0);

}  // namespace tinsmith
