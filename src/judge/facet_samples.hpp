#pragma once
// The samples in or on a triangle, with what each corner bears there.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "judge/plan.hpp"
#include "samples/height_grid.hpp"

namespace tinsmith {

/// The corners of a facet, counter-clockwise in the grid, and how much of each there is at a sample: not negative,
/// not normalised.
struct CornerWeights {
  std::array<std::size_t, 3> corner;
  std::array<double, 3> weight;

  /// The mean of value(corner).
  template <class Value>
  double mean(Value value) const {
    const auto& [wa, wb, wc] = weight;
    return (wa * value(corner[0]) + wb * value(corner[1]) + wc * value(corner[2])) / (wa + wb + wc);
  }
};

namespace detail {

/// The side on which a triangle lies of one of its edges: value(x, y) = length times the distance inside.
struct FacetSide {
  FacetSide(const PlanPoint& from, const PlanPoint& to)
      : start(from), nx(from.y - to.y), ny(to.x - from.x), slack(kPlanEpsilon * std::hypot(nx, ny)) {}
  double value(double x, double y) const { return nx * (x - start.x) + ny * (y - start.y); }

  PlanPoint start;
  double nx, ny;  // inward normal, as long as the edge
  double slack;
};

struct Range {
  double low, high;
};

struct WholeRange {
  std::int32_t first;
  std::int32_t last;  // smaller when empty
};

/// Whole numbers within [low, high] and [least, most].
inline WholeRange whole_within(const Range& range, std::int32_t least, std::int32_t most) {
  return {static_cast<std::int32_t>(std::clamp(std::ceil(range.low), double{0} + least, most + 1.0)),
          static_cast<std::int32_t>(std::clamp(std::floor(range.high), least - 1.0, double{0} + most))};
}

/// The columns that may lie in the triangle on a row, of those in `all`: at least all that do.
inline Range columns_on(double y, const std::array<FacetSide, 3>& sides, Range all) {
  for (const FacetSide& side : sides) {
    if (side.nx == 0) continue;
    const double x = side.start.x - (side.ny * (y - side.start.y) + side.slack) / side.nx;
    if (side.nx > 0) all.low = std::max(all.low, x);
    if (side.nx < 0) all.high = std::min(all.high, x);
  }
  return {all.low - kPlanEpsilon, all.high + kPlanEpsilon};
}

}  // namespace detail

/// Calls visit(x, y, CornerWeights, is_strict) for each sample of the rectangle that is no farther than the epsilon
/// outside any edge; strict when it is farther than the epsilon inside all. Within the slack outside an edge the
/// weights are those of the edge: nothing is extrapolated.
template <class Visit>
void for_each_sample_in(const Facet& facet, const GridRect& rect, Visit visit) {
  CornerWeights at{{0, 1, 2}, {}};
  if (doubled_area(facet.position[0], facet.position[1], facet.position[2]) < 0)
    std::swap(at.corner[1], at.corner[2]);
  const PlanPoint a = facet.position[at.corner[0]];
  const PlanPoint b = facet.position[at.corner[1]];
  const PlanPoint c = facet.position[at.corner[2]];
  if (!(doubled_area(a, b, c) > 0)) return;
  const std::array<detail::FacetSide, 3> sides{detail::FacetSide(b, c), detail::FacetSide(c, a),
                                               detail::FacetSide(a, b)};  // opposite
  const detail::Range columns{std::min({a.x, b.x, c.x}), std::max({a.x, b.x, c.x})};
  const detail::WholeRange rows =
      detail::whole_within({std::min({a.y, b.y, c.y}) - kPlanEpsilon, std::max({a.y, b.y, c.y}) + kPlanEpsilon},
                           rect.y0, rect.y0 + rect.height - 1);
  for (std::int32_t y = rows.first; y <= rows.last; ++y) {
    const auto [first, last] =
        detail::whole_within(detail::columns_on(y, sides, columns), rect.x0, rect.x0 + rect.width - 1);
    for (std::int32_t x = first; x <= last; ++x) {
      const std::array<double, 3> e{sides[0].value(x, y), sides[1].value(x, y), sides[2].value(x, y)};
      if (e[0] < -sides[0].slack || e[1] < -sides[1].slack || e[2] < -sides[2].slack) continue;
      at.weight = {std::max(e[0], 0.0), std::max(e[1], 0.0), std::max(e[2], 0.0)};
      visit(x, y, at, e[0] > sides[0].slack && e[1] > sides[1].slack && e[2] > sides[2].slack);
    }
  }
}

}  // namespace tinsmith
