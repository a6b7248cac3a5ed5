#include "simplify/star.hpp"

#include <algorithm>
#include <array>

#include "geometry/triangle_rows.hpp"

namespace tinsmith {

namespace {

constexpr double kCell = 1.0 / kLatticePerCell;

// Below this weight a sample lies on the far side (a, b), which the new vertex does not change.
constexpr double kOnFarSide = 1e-9;

// Over the triangle (p, a, b), d being a plan position relative to p in cells: the weight of p is
// 1 + weight_x d.x + weight_y d.y, and a and b bear the height base_x d.x + base_y d.y.
struct Shares {
  double px, py;
  double weight_x, weight_y;
  double base_x, base_y;

  Shares(LatticePoint p, const Side& side, double reference) : px(p.x * kCell), py(p.y * kCell) {
    const double ax = (side.a.position.x - p.x) * kCell;
    const double ay = (side.a.position.y - p.y) * kCell;
    const double bx = (side.b.position.x - p.x) * kCell;
    const double by = (side.b.position.y - p.y) * kCell;
    const double za = side.a.height - reference;
    const double zb = side.b.height - reference;
    const double inverse = 1 / (ax * by - ay * bx);
    weight_x = (ay - by) * inverse;
    weight_y = (bx - ax) * inverse;
    base_x = (za * by - zb * ay) * inverse;
    base_y = (zb * ax - za * bx) * inverse;
  }
  double weight(double x, double y) const { return 1 + weight_x * (x - px) + weight_y * (y - py); }
  double base(double x, double y) const { return base_x * (x - px) + base_y * (y - py); }
};

const double* sample_at(const HeightGrid& samples, std::int32_t x, std::int32_t y) {
  const GridRect& r = samples.rect;
  return samples.z.data() + (static_cast<std::int64_t>(y - r.y0) * r.width + (x - r.x0));
}

// One sample; returns false when the interval is empty.
inline bool narrow_by(HeightInterval& interval, double weight, double r, double tolerance, LatticePoint at) {
  if (r - tolerance > interval.lowest * weight) {
    interval.lowest = (r - tolerance) / weight;
    interval.lowest_at = at;
  }
  if (r + tolerance < interval.highest * weight) {
    interval.highest = (r + tolerance) / weight;
    interval.highest_at = at;
  }
  return interval.lowest <= interval.highest;
}

bool contains(LatticePoint p, const Side& side, LatticePoint s) {
  return orient(p, side.a.position, s) >= 0 && orient(side.a.position, side.b.position, s) >= 0 &&
         orient(side.b.position, p, s) >= 0;
}

// Narrows by the one sample, in whichever triangle of the star it lies now.
bool narrow_by_sample(HeightInterval& interval, const Star& star, const Bound& bound, LatticePoint p,
                      LatticePoint sample) {
  const LatticePoint s{sample.x * kLatticePerCell, sample.y * kLatticePerCell};
  for (const Side& side : star) {
    if (!contains(p, side, s)) continue;
    const Shares shares(p, side, bound.reference);
    const double weight = shares.weight(sample.x, sample.y);
    if (weight < kOnFarSide) return true;
    const double r =
        *sample_at(bound.samples, sample.x, sample.y) - bound.reference - shares.base(sample.x, sample.y);
    return narrow_by(interval, weight, r, bound.tolerance, sample);
  }
  return true;
}

}  // namespace

double HeightInterval::best() const { return std::clamp(sum_ww > 0 ? sum_wr / sum_ww : 0, lowest, highest); }

bool narrow(HeightInterval& interval, const Bound& bound, LatticePoint p, const Side& side) {
  const TriangleRows rows(p, side.a.position, side.b.position);
  const Shares shares(p, side, bound.reference);
  HeightInterval now = interval;
  for (std::int32_t y = rows.first_row; y <= rows.last_row; ++y) {
    const auto [first, last] = rows.columns(y);
    if (first > last) continue;
    const double* z = sample_at(bound.samples, first, y);
    const double weight_first = shares.weight(first, y);
    const double base_first = bound.reference + shares.base(first, y);
    for (std::int32_t i = 0; i <= last - first; ++i) {
      const double weight = weight_first + i * shares.weight_x;
      if (weight < kOnFarSide) continue;
      const double r = z[i] - (base_first + i * shares.base_x);
      now.sum_wr += weight * r;
      now.sum_ww += weight * weight;
      now.sum_rr += r * r;
      now.lowest_sample = std::min(now.lowest_sample, z[i]);
      now.highest_sample = std::max(now.highest_sample, z[i]);
      if (!narrow_by(now, weight, r, bound.tolerance, {first + i, y})) {
        interval = now;
        return false;
      }
    }
  }
  interval = now;
  return true;
}

HeightInterval feasible_heights(const Star& star, const Bound& bound, LatticePoint p) {
  HeightInterval interval;
  for (const Side& side : star) {
    if (!narrow(interval, bound, p, side)) return interval;
  }
  if (interval.lowest_sample <= interval.highest_sample) {
    interval.lowest = std::max(interval.lowest, interval.lowest_sample - bound.tolerance - bound.reference);
    interval.highest = std::min(interval.highest, interval.highest_sample + bound.tolerance - bound.reference);
  }
  return interval;
}

bool is_still_empty(const HeightInterval& earlier, const Star& star, const Bound& bound, LatticePoint p) {
  HeightInterval interval;
  return !narrow_by_sample(interval, star, bound, p, earlier.lowest_at) ||
         !narrow_by_sample(interval, star, bound, p, earlier.highest_at);
}

bool is_in_kernel(const Star& star, LatticePoint p) {
  return std::all_of(star.begin(), star.end(),
                     [p](const Side& side) { return orient(p, side.a.position, side.b.position) > 0; });
}

}  // namespace tinsmith
