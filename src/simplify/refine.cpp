#include "simplify/refine.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/triangle_rows.hpp"
#include "samples/triangle_error.hpp"
#include "simplify/colour_fit.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A step must be worth its disturbance.
constexpr double kWorthwhile = 0.98;
constexpr std::array kParts{1.0, 0.4};  // of the step that are tried
constexpr double kReach = 0.5;          // of the mean edge length

Corner corner(const WindowMesh& mesh, std::int32_t v) { return {mesh.position[at(v)], mesh.height[at(v)]}; }

double squared(std::int32_t v) { return static_cast<double>(v) * v; }

// Gathers the star and returns how far its middle may go, in lattice units.
double gather(const WindowMesh& mesh, std::int32_t v, Star& star) {
  star.clear();
  const LatticePoint p = mesh.position[at(v)];
  double length = 0;
  for_each_out(mesh, v, [&](std::int32_t h) {
    const Corner a = corner(mesh, mesh.destination(h));
    star.push_back({a, corner(mesh, mesh.origin[at(WindowMesh::previous(h))])});
    length += std::sqrt(squared(a.position.x - p.x) + squared(a.position.y - p.y));
  });
  return kReach * length / static_cast<double>(star.size());
}

struct Step {
  double x = 0;
  double y = 0;

  friend Step operator*(double factor, Step s) { return {factor * s.x, factor * s.y}; }
};

// Where the gradient of the system vanishes. A little damped, since stars of equal slopes leave it open.
Step solve(const PlanSystem& s) {
  constexpr double kDamping = 0.002;
  const double damping = kDamping * (s.xx + s.yy);
  const double xx = s.xx + damping;
  const double yy = s.yy + damping;
  const double determinant = xx * yy - s.xy * s.xy;
  if (!(determinant > 0)) return {};
  return {(s.rx * yy - s.ry * s.xy) / determinant, (s.ry * xx - s.rx * s.xy) / determinant};
}

double step_along(double curvature, double slope) { return curvature > 0 ? slope / curvature : 0; }

// As far as the kind of the vertex lets it go.
Step best_step(const WindowMesh& mesh, std::int32_t v, const PlanSystem& system) {
  if (mesh.kind[at(v)] == VertexKind::kInterior) return solve(system);
  if (mesh.kind[at(v)] != VertexKind::kBorder) return {};
  const LatticePoint p = mesh.position[at(v)];
  const LatticePoint q = mesh.position[at(mesh.destination(mesh.out[at(v)]))];
  if (p.y == q.y) return {step_along(system.xx, system.rx), 0};
  return {0, step_along(system.yy, system.ry)};
}

Step at_most(double length, Step s) {
  const double squared_length = s.x * s.x + s.y * s.y;
  return squared_length > length * length ? length / std::sqrt(squared_length) * s : s;
}

LatticePoint moved(LatticePoint p, Step s) {
  return {p.x + static_cast<std::int32_t>(std::lround(s.x)), p.y + static_cast<std::int32_t>(std::lround(s.y))};
}

// The border's own line bounds a sliding vertex too: it must not pass its neighbours.
bool stays_between(const WindowMesh& mesh, std::int32_t v, LatticePoint p) {
  if (mesh.kind[at(v)] != VertexKind::kBorder) return true;
  const LatticePoint after = mesh.position[at(mesh.destination(mesh.out[at(v)]))];
  std::int32_t last = kNone;
  for_each_out(mesh, v, [&](std::int32_t h) { last = h; });
  const LatticePoint before = mesh.position[at(mesh.origin[at(WindowMesh::previous(last))])];
  return std::min(before, after) < p && p < std::max(before, after);
}

// What the colours of a star add to its squared error. Nothing when there are none.
class StarColour {
 public:
  StarColour(const WindowMesh& mesh, const RefineBound& bound, std::int32_t v) : bound_(bound) {
    if (bound.colours == nullptr) return;
    add_colour_sides(mesh, v, kNone, star_);
    colour_ = mesh.colour[at(v)];
  }

  // With the colour that the middle has.
  double squared_error(LatticePoint p) const {
    if (bound_.colours == nullptr) return 0;
    return bound_.squared_height_per_level * fit_colour(star_, *bound_.colours, p).squared_error(colour_);
  }

  struct Fit {
    Levels colour{};
    double squared_error = 0;
  };
  Fit fit(LatticePoint p) const {
    if (bound_.colours == nullptr) return {};
    const ColourFit fit = fit_colour(star_, *bound_.colours, p);
    const Levels best = fit.best(colour_);
    return {best, bound_.squared_height_per_level * fit.squared_error(best)};
  }

 private:
  const RefineBound& bound_;
  ColourStar star_;
  Levels colour_{};
};

// Of the triangles (p, q, left) and (q, p, right).
double colour_error(const WindowMesh& mesh, const RefineBound& bound, const std::array<std::int32_t, 4>& corners) {
  if (bound.colours == nullptr) return 0;
  const auto [p, q, left, right] = corners;
  const auto side = [&](std::int32_t a, std::int32_t b) {
    return ColourSide{mesh.position[at(a)], mesh.position[at(b)], mesh.colour[at(a)], mesh.colour[at(b)]};
  };
  const ColourFit fit = fit_colour({side(q, left), side(right, q)}, *bound.colours, mesh.position[at(p)]);
  return bound.squared_height_per_level * fit.squared_error(mesh.colour[at(p)]);
}

}  // namespace

bool improve_vertex(WindowMesh& mesh, const RefineBound& bound, std::int32_t v, Star& star) {
  if (!bound.may_move || mesh.kind[at(v)] == VertexKind::kLocked) return false;
  const double reach = gather(mesh, v, star);
  const Bound star_bound{bound.samples, bound.tolerance, mesh.height[at(v)]};
  const LatticePoint p = mesh.position[at(v)];
  PlanSystem system;
  HeightFit best = fit_height(star, star_bound, p, system);
  if (!best.is_feasible) return false;  // by rounding only
  LatticePoint best_position = p;
  const StarColour colour(mesh, bound, v);
  StarColour::Fit best_colour = colour.fit(p);
  const double worth = kWorthwhile * (best.squared_error_at_reference + colour.squared_error(p));
  if (!(worth > 0)) return false;
  const Step step = at_most(reach, best_step(mesh, v, system));
  for (const double part : kParts) {
    const LatticePoint q = moved(p, part * step);
    if (q == p) break;
    if (!is_in_kernel(star, q) || !stays_between(mesh, v, q)) continue;
    const double limit = best.squared_error + best_colour.squared_error;
    const HeightFit there = fit_height(star, star_bound, q, limit);
    if (!there.is_feasible) continue;
    const StarColour::Fit colour_there = colour.fit(q);
    if (!(there.squared_error + colour_there.squared_error < limit)) continue;
    best = there;
    best_colour = colour_there;
    best_position = q;
    break;
  }
  if (!(best.squared_error + best_colour.squared_error < worth)) return false;
  mesh.position[at(v)] = best_position;
  mesh.height[at(v)] += best.height;
  if (bound.colours != nullptr) mesh.colour[at(v)] = best_colour.colour;
  return true;
}

bool improve_edge(WindowMesh& mesh, const RefineBound& bound, std::int32_t h, std::vector<float>& squared_error) {
  if (mesh.is_border_edge(h)) return false;
  const std::int32_t g = mesh.twin[at(h)];
  const std::int32_t va = mesh.origin[at(h)];
  const std::int32_t vb = mesh.origin[at(g)];
  const std::int32_t vc = mesh.origin[at(WindowMesh::previous(h))];
  const std::int32_t vd = mesh.origin[at(WindowMesh::previous(g))];
  const Corner a = corner(mesh, va);
  const Corner b = corner(mesh, vb);
  const Corner c = corner(mesh, vc);
  const Corner d = corner(mesh, vd);
  if (orient(d.position, c.position, a.position) <= 0 || orient(c.position, d.position, b.position) <= 0)
    return false;
  const auto known = [&](std::int32_t halfedge, const Corner& p, const Corner& q, const Corner& r) {
    float& squared = squared_error[at(halfedge / 3)];
    if (std::isnan(squared)) squared = static_cast<float>(triangle_error(bound.samples, p, q, r).sum_of_squares);
    return static_cast<double>(squared);
  };
  const double before = known(h, a, b, c) + known(g, b, a, d);
  const double worth = kWorthwhile * (before + colour_error(mesh, bound, {va, vb, vc, vd}));
  const TriangleError left = triangle_error(bound.samples, d, c, a);
  if (!(left.largest <= bound.tolerance && left.sum_of_squares < worth)) return false;
  const TriangleError right = triangle_error(bound.samples, c, d, b);
  if (!(right.largest <= bound.tolerance)) return false;
  const double after = left.sum_of_squares + right.sum_of_squares + colour_error(mesh, bound, {vd, vc, va, vb});
  if (!(after < worth)) return false;
  flip_edge(mesh, h);
  return true;
}

}  // namespace tinsmith
