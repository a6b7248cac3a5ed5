#pragma once
// The paper's half-space test, eq. 12-24: the new vertex sees the whole link of the collapse in a plane, so that
// none of its triangles turns over there. Terrain has the horizontal plane, in exact integers; surfaces in space
// have the average plane of the new triangles.

#include <algorithm>
#include <span>
#include <vector>

#include "geometry/quadric.hpp"

namespace tinsmith {

/// Eq. 24: whether the new vertex lies strictly inside the half-space of every side of its link. `area_of(side)` is
/// L_j(0, 0), the area in the plane of its triangle over that side (any positive multiple; positive when
/// counter-clockwise); where it is not positive, `is_excused(side)` has the last word.
template <class Link, class Area, class Excuse>
bool is_inside_half_spaces(const Link& link, Area area_of, Excuse is_excused) {
  return std::all_of(link.begin(), link.end(),
                     [&](const auto& side) { return area_of(side) > 0 || is_excused(side); });
}

/// A side of the link in space: with the new vertex v the triangle (v, a, b), counter-clockwise from outside.
struct LinkSide {
  Vec<3> a;
  Vec<3> b;
  Vec<3> before;  // where the vertex of its triangle was
};

/// Whether v lies strictly inside the half-space of every side; border sides are left out by the caller. A side
/// that its old vertex was not inside of either, over the old average plane, is excused so long as its triangle
/// turns by no more than a right angle: rough surfaces are no height fields over any plane, and triangles without
/// area have no side.
inline bool is_inside_half_spaces(std::span<const LinkSide> link, const Vec<3>& v) {
  // Eq. 12: the sums of the triangles' normals, each as long as twice its area.
  Vec<3> n{};
  Vec<3> n_before{};
  for (const LinkSide& side : link) {
    const Vec<3> normal = cross(side.a - v, side.b - v);
    const Vec<3> normal_before = cross(side.a - side.before, side.b - side.before);
    for (std::size_t i = 0; i < 3; ++i) {
      n[i] += normal[i];
      n_before[i] += normal_before[i];
    }
  }
  // Eq. 16-24 in the basis (b1, b2) of the plane come to this: L_j(0, 0) = x_j y_{j+1} - x_{j+1} y_j is the
  // component along n of a_j x b_j, for any orthonormal basis with b1 x b2 = n.
  const auto area_of = [&](const LinkSide& side) { return dot(cross(side.a - v, side.b - v), n); };
  const auto is_excused = [&](const LinkSide& side) {
    const Vec<3> normal_before = cross(side.a - side.before, side.b - side.before);
    return !(dot(normal_before, n_before) > 0) && !(dot(cross(side.a - v, side.b - v), normal_before) < 0);
  };
  return is_inside_half_spaces(link, area_of, is_excused);
}

}  // namespace tinsmith
