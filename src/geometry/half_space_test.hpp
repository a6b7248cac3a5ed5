#pragma once
// The paper's half-space test, eq. 12-24: the new vertex sees the whole link of the collapse, in the average plane
// of its new triangles, so that none of them turns over.

#include <span>
#include <vector>

#include "geometry/quadric.hpp"

namespace tinsmith {

/// A side of the link: with the new vertex v the triangle (v, a, b), counter-clockwise from outside.
struct LinkSide {
  Vec<3> a;
  Vec<3> b;
};

/// Whether v lies strictly inside the half-space of every side. Border sides are left out by the caller.
inline bool is_inside_half_spaces(std::span<const LinkSide> link, const Vec<3>& v) {
  // Eq. 12: the sum of the triangles' normals, each as long as twice its area.
  Vec<3> n{};
  for (const LinkSide& side : link) {
    const Vec<3> normal = cross(side.a - v, side.b - v);
    for (std::size_t i = 0; i < 3; ++i) n[i] += normal[i];
  }
  // Eq. 16-24 in the basis (b1, b2) of the plane come to this: L_j(0, 0) = x_j y_{j+1} - x_{j+1} y_j is the
  // component along n of a_j x b_j, for any orthonormal basis with b1 x b2 = n.
  for (const LinkSide& side : link) {
    if (!(dot(cross(side.a - v, side.b - v), n) > 0)) return false;
  }
  return true;
}

}  // namespace tinsmith
