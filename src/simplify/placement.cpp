#include "simplify/placement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tinsmith {

namespace {

constexpr double kCell = 1.0 / kLatticePerCell;

// A plan position in cells, relative to v0.
struct PlanPoint {
  double x = 0;
  double y = 0;
};

void add_colour(PlanError& error, const EdgeColour& colour, PlanPoint d) {
  for (std::size_t c = 0; c < colour.n_channels; ++c)
    error.add_channel(PlanError(colour.v0[c], colour.v1[c], d.x, d.y, colour.rise[c]));
}

// The edge in cells, relative to v0.
struct EdgeFrame {
  const Edge& edge;
  PlanPoint d;
  double dz;
  PlanError error;

  explicit EdgeFrame(const Edge& e)
      : edge(e),
        d{(e.v1.position.x - e.v0.position.x) * kCell, (e.v1.position.y - e.v0.position.y) * kCell},
        dz(e.v1.height - e.v0.height),
        error(e.v0.quadric, e.v1.quadric, d.x, d.y, dz) {
    if (e.colour != nullptr) add_colour(error, *e.colour, d);
  }
};

Freedom freedom_of(const Edge& edge) {
  const bool needs_border = edge.v0.kind != VertexKind::kInterior && edge.v1.kind != VertexKind::kInterior;
  return needs_border && !edge.is_border ? Freedom::kNever : freedom(edge.v0.kind, edge.v1.kind);
}

bool has_fixed_height(const EdgeEnd& end, const PlacementRules& rules) {
  return rules.placement == Placement::kSubset || end.kind == VertexKind::kLocked;
}

double cost_at_end(const EdgeFrame& frame, bool at_second, const PlacementRules& rules) {
  const PlanPoint p = at_second ? frame.d : PlanPoint{};
  if (!has_fixed_height(at_second ? frame.edge.v1 : frame.edge.v0, rules)) return frame.error.at(p.x, p.y);
  return frame.error.at(p.x, p.y, at_second ? frame.dz : 0);
}

// At an end of the edge: the plan position is kept, and the height too where the end's kind demands it.
Candidate at_end(const EdgeFrame& frame, bool at_second, const PlacementRules& rules) {
  const EdgeEnd& end = at_second ? frame.edge.v1 : frame.edge.v0;
  if (has_fixed_height(end, rules)) return {end.position, end.height, true};
  const PlanPoint p = at_second ? frame.d : PlanPoint{};
  return {end.position, frame.edge.v0.height + frame.error.height(p.x, p.y), false};
}

Candidate at_plan(const EdgeFrame& frame, PlanPoint p) {
  const auto to_lattice = [](std::int32_t from, double cells) {
    return from + static_cast<std::int32_t>(std::floor(cells * kLatticePerCell + 0.5));
  };
  const EdgeEnd& v0 = frame.edge.v0;
  return {{to_lattice(v0.position.x, p.x), to_lattice(v0.position.y, p.y)},
          v0.height + frame.error.height(p.x, p.y),
          false};
}

// The best point between v0 and v1.
PlanPoint on_segment(const EdgeFrame& frame, const PlacementRules& rules) {
  const PlanError& e = frame.error;
  const auto [dx, dy] = frame.d;
  const double weight = e.szz * rules.slope_noise * rules.slope_noise * (dx * dx + dy * dy);
  const double curvature = dx * (e.kxx * dx + 2 * e.kxy * dy) + dy * e.kyy * dy + weight;
  const double rise = e.kx * dx + e.ky * dy + weight / 2;
  const double t = curvature > 0 ? std::clamp(rise / curvature, 0.0, 1.0) : 0.5;
  return {t * dx, t * dy};
}

// The minimum of the plan error, drawn to the middle of the edge where the quadric leaves it open: the
// gradient of f(q) + weight * |q - middle|^2 vanishes. (Paper eq. 6-10 with a rank test would jump there.)
PlanPoint anywhere(const EdgeFrame& frame, const PlacementRules& rules) {
  const PlanError& e = frame.error;
  const auto [dx, dy] = frame.d;
  constexpr double kRelativeWeight = 1e-3;
  const double weight = kRelativeWeight * (e.kxx + e.kyy) + e.szz * rules.slope_noise * rules.slope_noise;
  const double xx = e.kxx + weight;
  const double yy = e.kyy + weight;
  const double rx = e.kx + weight * dx / 2;
  const double ry = e.ky + weight * dy / 2;
  const double inverse = 1 / (xx * yy - e.kxy * e.kxy);
  const PlanPoint p{(rx * yy - ry * e.kxy) * inverse, (ry * xx - rx * e.kxy) * inverse};
  // Farther off than the edge is long it hardly ever lies in the kernel, and lattice numbers have an end.
  const double reach = 2 * (std::abs(dx) + std::abs(dy));
  const bool is_near = std::abs(p.x) <= reach && std::abs(p.y) <= reach;  // false for NaN
  return is_near ? p : on_segment(frame, rules);
}

PlanPoint best_point(const EdgeFrame& frame, Freedom free, const PlacementRules& rules) {
  const bool is_bound = free == Freedom::kAlong || rules.placement == Placement::kSegment;
  return is_bound ? on_segment(frame, rules) : anywhere(frame, rules);
}

}  // namespace

double edge_cost(const Edge& edge, const PlacementRules& rules) {
  const Freedom free = freedom_of(edge);
  if (free == Freedom::kNever) return std::numeric_limits<double>::infinity();
  const EdgeFrame frame(edge);
  if (free == Freedom::kAtFirst || free == Freedom::kAtSecond)
    return cost_at_end(frame, free == Freedom::kAtSecond, rules);
  if (rules.placement == Placement::kSubset)
    return std::min(cost_at_end(frame, false, rules), cost_at_end(frame, true, rules));
  const PlanPoint p = best_point(frame, free, rules);
  return frame.error.at(p.x, p.y);
}

Candidates place(const Edge& edge, const PlacementRules& rules) {
  Candidates result;
  const Freedom free = freedom_of(edge);
  if (free == Freedom::kNever) return result;
  const EdgeFrame frame(edge);
  if (free == Freedom::kAtFirst || free == Freedom::kAtSecond) {
    result.add(at_end(frame, free == Freedom::kAtSecond, rules));
    return result;
  }
  if (rules.placement != Placement::kSubset) result.add(at_plan(frame, best_point(frame, free, rules)));
  const bool second_first = cost_at_end(frame, true, rules) < cost_at_end(frame, false, rules);
  result.add(at_end(frame, second_first, rules));
  result.add(at_end(frame, !second_first, rules));
  return result;
}

}  // namespace tinsmith
