#include "simplify/placement.hpp"

#include <algorithm>
#include <cmath>

namespace tinsmith {

namespace {

constexpr double kCell = 1.0 / kLatticePerCell;

// The edge in cells, relative to v0.
struct EdgeFrame {
  const EdgeEnd& v0;
  const EdgeEnd& v1;
  double dx, dy, dz;
  PlanError error;

  EdgeFrame(const EdgeEnd& a, const EdgeEnd& b)
      : v0(a),
        v1(b),
        dx((b.position.x - a.position.x) * kCell),
        dy((b.position.y - a.position.y) * kCell),
        dz(b.height - a.height),
        error(*a.quadric, *b.quadric, dx, dy, dz) {}
};

Candidate at_plan(const EdgeFrame& edge, double x, double y) {
  const auto to_lattice = [](std::int32_t from, double cells) {
    return from + static_cast<std::int32_t>(std::lround(cells * kLatticePerCell));
  };
  Candidate result;
  result.position = {to_lattice(edge.v0.position.x, x), to_lattice(edge.v0.position.y, y)};
  result.height = edge.v0.height + edge.error.height(x, y);
  return result;
}

// At an end of the edge: the plan position is kept, and the height too where the end's kind demands it.
Candidate at_end(const EdgeFrame& edge, bool at_second, Placement placement) {
  const EdgeEnd& end = at_second ? edge.v1 : edge.v0;
  Candidate result;
  result.position = end.position;
  result.has_fixed_height = placement == Placement::kSubset || end.kind == VertexKind::kLocked;
  result.height = result.has_fixed_height
                      ? end.height
                      : edge.v0.height + edge.error.height(at_second ? edge.dx : 0, at_second ? edge.dy : 0);
  return result;
}

double cost_at_end(const EdgeFrame& edge, bool at_second, const Candidate& candidate) {
  const double x = at_second ? edge.dx : 0;
  const double y = at_second ? edge.dy : 0;
  return candidate.has_fixed_height ? edge.error.at(x, y, candidate.height - edge.v0.height) : edge.error.at(x, y);
}

void add_ends(Candidates& result, const EdgeFrame& edge, Placement placement) {
  const Candidate first = at_end(edge, false, placement);
  const Candidate second = at_end(edge, true, placement);
  const double cost_first = cost_at_end(edge, false, first);
  const double cost_second = cost_at_end(edge, true, second);
  if (result.n == 0) result.cost = std::min(cost_first, cost_second);
  const bool second_is_better = cost_second < cost_first;
  result.add(second_is_better ? second : first);
  result.add(second_is_better ? first : second);
}

// The minimum of the plan error, drawn to the middle of the edge where the quadric leaves it open: the
// gradient of f(q) + weight * |q - middle|^2 vanishes. (Paper eq. 6-10 with a rank test would jump there.)
std::array<double, 2> optimum(const EdgeFrame& edge, double slope_noise) {
  const PlanError& e = edge.error;
  constexpr double kRelativeWeight = 1e-3;
  const double weight = kRelativeWeight * (e.kxx + e.kyy) + e.szz * slope_noise * slope_noise;
  const double xx = e.kxx + weight;
  const double yy = e.kyy + weight;
  const double rx = e.kx + weight * edge.dx / 2;
  const double ry = e.ky + weight * edge.dy / 2;
  const double determinant = xx * yy - e.kxy * e.kxy;
  if (!(determinant > 0)) return {edge.dx / 2, edge.dy / 2};
  return {(rx * yy - ry * e.kxy) / determinant, (ry * xx - rx * e.kxy) / determinant};
}

// The best fraction of the way from v0 to v1.
double best_fraction(const EdgeFrame& edge, double slope_noise) {
  const PlanError& e = edge.error;
  const double length2 = edge.dx * edge.dx + edge.dy * edge.dy;
  const double weight = e.szz * slope_noise * slope_noise * length2;
  const double curvature = edge.dx * (e.kxx * edge.dx + 2 * e.kxy * edge.dy) + edge.dy * e.kyy * edge.dy + weight;
  const double rise = e.kx * edge.dx + e.ky * edge.dy + weight / 2;
  return curvature > 0 ? std::clamp(rise / curvature, 0.0, 1.0) : 0.5;
}

void add_on_segment(Candidates& result, const EdgeFrame& edge, double slope_noise) {
  const double t = best_fraction(edge, slope_noise);
  result.add(at_plan(edge, t * edge.dx, t * edge.dy));
  result.cost = edge.error.at(t * edge.dx, t * edge.dy);
}

void add_anywhere(Candidates& result, const EdgeFrame& edge, double slope_noise) {
  const auto [x, y] = optimum(edge, slope_noise);
  // Farther off than the edge is long it hardly ever lies in the kernel, and lattice numbers have an end.
  const double reach = 2 * (std::abs(edge.dx) + std::abs(edge.dy));
  if (!(std::abs(x) <= reach && std::abs(y) <= reach)) {
    add_on_segment(result, edge, slope_noise);
    return;
  }
  result.add(at_plan(edge, x, y));
  result.cost = edge.error.at(x, y);
}

}  // namespace

Candidates place(const EdgeEnd& v0, const EdgeEnd& v1, bool is_border_edge, Placement placement,
                 double slope_noise) {
  Candidates result;
  const Freedom free = freedom(v0.kind, v1.kind);
  const bool needs_border = v0.kind != VertexKind::kInterior && v1.kind != VertexKind::kInterior;
  if (free == Freedom::kNone || (needs_border && !is_border_edge)) return result;
  const EdgeFrame edge(v0, v1);
  if (free == Freedom::kAtFirst || free == Freedom::kAtSecond) {
    const bool at_second = free == Freedom::kAtSecond;
    result.add(at_end(edge, at_second, placement));
    result.cost = cost_at_end(edge, at_second, result.list[0]);
    return result;
  }
  if (placement != Placement::kSubset) {
    if (free == Freedom::kAlong || placement == Placement::kSegment) {
      add_on_segment(result, edge, slope_noise);
    } else {
      add_anywhere(result, edge, slope_noise);
    }
  }
  add_ends(result, edge, placement);
  return result;
}

}  // namespace tinsmith
