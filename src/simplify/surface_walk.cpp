#include "simplify/surface_walk.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

Vec<3> times(const Vec<3>& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }

const Vec<3>& point(const WalkedSurface& surface, std::int32_t h) {
  return surface.position[at(surface.mesh.origin[at(h)])];
}

// On the side from corner k of the triangle of h, the first of its halfedges.
void improve_on_side(const WalkedSurface& surface, std::int32_t h, std::int32_t k, const Vec<3>& p, Nearest& best) {
  const std::int32_t other = (k + 1) % 3;
  const Vec<3>& a = point(surface, h + k);
  const Vec<3> side = point(surface, h + other) - a;
  const double along = dot(p - a, side);
  const double length = dot(side, side);
  const double t = along > 0 ? (along < length ? along / length : 1) : 0;
  const Vec<3> off = p - a - times(side, t);
  const double squared = dot(off, off);
  if (!(squared < best.squared)) return;
  best = {squared, h, {}, off};
  best.share[at(k)] = 1 - t;
  best.share[at(other)] = t;
}

// Whether the triangle of h, the first of its halfedges, is nearer to p than the best so far.
bool improve(const WalkedSurface& surface, std::int32_t h, const Vec<3>& p, Nearest& best) {
  // Made anew each time: that takes less time than fetching it, and no memory. Without area the shares are no
  // numbers, so that nothing lies over it.
  const Vec<3>& a = point(surface, h);
  const Vec<3> side1 = point(surface, h + 1) - a;
  const Vec<3> side2 = point(surface, h + 2) - a;
  const Vec<3> normal = cross(side1, side2);
  const Vec<3> d = p - a;
  const double inverse = 1 / dot(normal, normal);
  const double height = dot(d, normal);  // times the length of the normal
  const double squared = height * height * inverse;
  if (squared >= best.squared) return false;
  const double share1 = dot(cross(d, side2), normal) * inverse;
  const double share2 = dot(cross(side1, d), normal) * inverse;
  const double share0 = 1 - share1 - share2;
  if (share0 >= 0 && share1 >= 0 && share2 >= 0) {
    best = {squared, h, {share0, share1, share2}, times(normal, height * inverse)};
    return true;
  }
  // The nearest point lies on a side that p is beyond.
  const double before = best.squared;
  if (!(share2 >= 0)) improve_on_side(surface, h, 0, p, best);
  if (!(share0 >= 0)) improve_on_side(surface, h, 1, p, best);
  if (!(share1 >= 0)) improve_on_side(surface, h, 2, p, best);
  return best.squared < before;
}

bool improve_around(const WalkedSurface& surface, std::int32_t v, const Vec<3>& p, Nearest& best) {
  const double before = best.squared;
  for_each_out(surface.mesh, v, [&](std::int32_t h) { improve(surface, h - h % 3, p, best); });
  return best.squared < before;
}

// Across the side, or around the corner, on which the nearest point lies, as long as that comes nearer.
void descend(const WalkedSurface& surface, const Vec<3>& p, double enough, Nearest& best) {
  constexpr int kMaxSteps = 32;
  for (int n_steps = 0; n_steps < kMaxSteps && best.squared > enough; ++n_steps) {
    std::int32_t k = 0;  // the corner after the side without a share of the opposite one, or the only one
    while (k < 3 && best.share[at(k)] > 0) ++k;
    if (k == 3) return;
    const bool has_next = best.share[at((k + 1) % 3)] > 0;
    const bool has_previous = best.share[at((k + 2) % 3)] > 0;
    if (has_next && has_previous) {
      const std::int32_t g = surface.mesh.twin[at(best.halfedge + (k + 1) % 3)];
      if (g == kNone || !improve(surface, g - g % 3, p, best)) return;
    } else {
      const std::int32_t corner = best.halfedge + (has_next ? (k + 1) % 3 : (k + 2) % 3);
      if (!improve_around(surface, surface.mesh.origin[at(corner)], p, best)) return;
    }
  }
}

}  // namespace

Vec<3> normal_of(const WalkedSurface& surface, std::int32_t h) {
  const std::int32_t first = h - h % 3;
  const Vec<3>& a = point(surface, first);
  return cross(point(surface, first + 1) - a, point(surface, first + 2) - a);
}

Nearest nearest(const WalkedSurface& surface, const Vec<3>& p, std::int32_t triangle, std::int32_t v,
                double enough) {
  Nearest best;
  if (triangle != kNone)
    improve(surface, triangle, p, best);
  else
    improve_around(surface, v, p, best);
  if (best.halfedge != kNone) descend(surface, p, enough, best);
  return best;
}

}  // namespace tinsmith
