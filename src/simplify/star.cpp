#include "simplify/star.hpp"

#include <algorithm>

#include "geometry/half_space_test.hpp"

namespace tinsmith {

namespace {

std::size_t index_of(const GridRect& rect, LatticePoint sample) {
  return static_cast<std::size_t>(static_cast<std::int64_t>(sample.y - rect.y0) * rect.width +
                                  (sample.x - rect.x0));
}

// Narrows by the one sample, in whichever triangle of the star it lies now.
void narrow_by_sample(HeightInterval& interval, const Star& star, const Bound& bound, LatticePoint p,
                      LatticePoint sample) {
  const LatticePoint s{sample.x * kLatticePerCell, sample.y * kLatticePerCell};
  for (const Side& side : star) {
    const LatticePoint a = side.a.position;
    const LatticePoint b = side.b.position;
    const std::int64_t area_p = orient(a, b, s);
    const std::int64_t area_a = orient(b, p, s);
    const std::int64_t area_b = orient(p, a, s);
    if (area_p < 0 || area_a < 0 || area_b < 0) continue;
    if (area_p == 0) return;  // on the far side, which the vertex does not change
    const auto area = static_cast<double>(area_p + area_a + area_b);
    const double r = bound.samples.z[index_of(bound.samples.rect, sample)] - bound.reference -
                     (static_cast<double>(area_a) * (side.a.height - bound.reference) +
                      static_cast<double>(area_b) * (side.b.height - bound.reference)) /
                         area;
    const double per_weight = area / static_cast<double>(area_p);
    interval.lowest = std::max(interval.lowest, (r - bound.tolerance) * per_weight);
    interval.highest = std::min(interval.highest, (r + bound.tolerance) * per_weight);
    return;
  }
}

}  // namespace

double HeightInterval::best() const { return std::clamp(sum_ww > 0 ? sum_wr / sum_ww : 0, lowest, highest); }

bool is_still_empty(const HeightInterval& earlier, const Star& star, const Bound& bound, LatticePoint p) {
  HeightInterval interval;
  narrow_by_sample(interval, star, bound, p, earlier.lowest_at);
  narrow_by_sample(interval, star, bound, p, earlier.highest_at);
  return interval.is_empty();
}

bool is_in_kernel(const Star& star, LatticePoint p) {
  return is_inside_half_spaces(
      star, [p](const Side& side) { return orient(p, side.a.position, side.b.position); },
      [](const Side& /*side*/) { return false; });
}

}  // namespace tinsmith
