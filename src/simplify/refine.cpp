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
constexpr double kStep = 0.25;  // of the mean edge length

Corner corner(const WindowMesh& mesh, std::int32_t v) { return {mesh.position[at(v)], mesh.height[at(v)]}; }

// Where a vertex of this kind may go, one step of `step` lattice units.
struct Directions {
  std::array<LatticePoint, 8> list;
  std::size_t n = 0;
};

Directions directions(const WindowMesh& mesh, std::int32_t v, std::int32_t step, std::size_t n) {
  const auto diagonal = static_cast<std::int32_t>(std::lround(step * 0.7071));
  if (mesh.kind[at(v)] == VertexKind::kInterior) {
    // Two: neighbours, whose numbers are near, look along different diagonals.
    if (n == 2 && v % 2 == 1) return {{{{-diagonal, diagonal}, {diagonal, -diagonal}}}, n};
    return {{{{diagonal, diagonal},
              {-diagonal, -diagonal},
              {-diagonal, diagonal},
              {diagonal, -diagonal},
              {step, 0},
              {0, step},
              {-step, 0},
              {0, -step}}},
            n};
  }
  if (mesh.kind[at(v)] != VertexKind::kBorder) return {};
  const LatticePoint p = mesh.position[at(v)];
  const LatticePoint q = mesh.position[at(mesh.destination(mesh.out[at(v)]))];
  if (p.y == q.y) return {{{{step, 0}, {-step, 0}}}, 2};
  return {{{{0, step}, {0, -step}}}, 2};
}

double squared(std::int32_t v) { return static_cast<double>(v) * v; }

// Gathers the star and returns the step.
std::int32_t gather(const WindowMesh& mesh, std::int32_t v, Star& star) {
  star.clear();
  const LatticePoint p = mesh.position[at(v)];
  double length = 0;
  for_each_out(mesh, v, [&](std::int32_t h) {
    const Corner a = corner(mesh, mesh.destination(h));
    star.push_back({a, corner(mesh, mesh.origin[at(WindowMesh::previous(h))])});
    length += std::sqrt(squared(a.position.x - p.x) + squared(a.position.y - p.y));
  });
  return std::max(1, static_cast<std::int32_t>(std::lround(kStep * length / static_cast<double>(star.size()))));
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
  const std::int32_t step = gather(mesh, v, star);
  const Bound star_bound{bound.samples, bound.tolerance, mesh.height[at(v)]};
  const LatticePoint p = mesh.position[at(v)];
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();
  HeightFit best = fit_height(star, star_bound, p, kNoLimit);
  if (!best.is_feasible) return false;  // by rounding only
  LatticePoint best_position = p;
  const StarColour colour(mesh, bound, v);
  StarColour::Fit best_colour = colour.fit(p);
  const double worth = kWorthwhile * (best.squared_error_at_reference + colour.squared_error(p));
  const Directions where = directions(mesh, v, step, bound.directions);
  for (std::size_t i = 0; i < where.n; ++i) {
    const LatticePoint q{p.x + where.list[i].x, p.y + where.list[i].y};
    if (!is_in_kernel(star, q) || !stays_between(mesh, v, q)) continue;
    const double limit = best.squared_error + best_colour.squared_error;
    const HeightFit there = fit_height(star, star_bound, q, limit);
    if (!there.is_feasible) continue;
    const StarColour::Fit colour_there = colour.fit(q);
    if (!(there.squared_error + colour_there.squared_error < limit)) continue;
    best = there;
    best_colour = colour_there;
    best_position = q;
  }
  if (!(best.squared_error + best_colour.squared_error < worth)) return false;
  mesh.position[at(v)] = best_position;
  mesh.height[at(v)] += best.height;
  if (bound.colours != nullptr) mesh.colour[at(v)] = best_colour.colour;
  return true;
}

bool improve_edge(WindowMesh& mesh, const RefineBound& bound, std::int32_t h) {
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
  const TriangleError left = triangle_error(bound.samples, d, c, a);
  if (!(left.largest <= bound.tolerance)) return false;
  const TriangleError right = triangle_error(bound.samples, c, d, b);
  if (!(right.largest <= bound.tolerance)) return false;
  const double before =
      triangle_error(bound.samples, a, b, c).sum_of_squares + triangle_error(bound.samples, b, a, d).sum_of_squares;
  const double colour_before = colour_error(mesh, bound, {va, vb, vc, vd});
  const double after = left.sum_of_squares + right.sum_of_squares + colour_error(mesh, bound, {vd, vc, va, vb});
  if (!(after < kWorthwhile * (before + colour_before))) return false;
  flip_edge(mesh, h);
  return true;
}

}  // namespace tinsmith
