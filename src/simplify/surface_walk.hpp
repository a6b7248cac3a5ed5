#pragma once
// The point of a surface that is nearest to a given one, by walking over the triangles as long as they come nearer.
// It takes a start nearby; where that is wrong, as on the other side of a thin part, what is found is only as near
// as its surroundings.

#include <limits>
#include <vector>

#include "geometry/quadric.hpp"
#include "mesh/halfedges.hpp"

namespace tinsmith {

/// A triangle as the search wants it. One without area has normal and duals that are no numbers, so that nothing
/// lies over it.
struct WalkedFacet {
  Vec<3> corner;
  Vec<3> dual1;  // the share of corner 1 is dual1 . (p - corner), as dual2 for corner 2
  Vec<3> dual2;
  Vec<3> normal;  // of length 1
};

/// Triangles to walk over; edges and places must outlive it.
struct WalkedSurface {
  WalkedSurface(const Halfedges& edges, const std::vector<Vec<3>>& places);

  const Halfedges& mesh;
  const std::vector<Vec<3>>& position;  // by vertex; there may be more
  std::vector<WalkedFacet> facets;      // by triangle
};

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
