#include "simplify/error_bound.hpp"

#include "geometry/triangle_rows.hpp"

namespace tinsmith {

namespace {

// Below this weight a sample lies on the far side (a, b), which the collapse does not change.
constexpr double kOnFarSide = 1e-9;

bool narrow_row(HeightInterval& interval, const double* z, std::int32_t n, double tolerance,
                std::array<double, 4> at) {
  auto [w, w_step, base, base_step] = at;
  double lowest = interval.lowest;
  double highest = interval.highest;
  double sum_wr = 0;
  double sum_ww = 0;
  for (std::int32_t i = 0; i < n; ++i) {
    const double weight = w + i * w_step;
    if (weight < kOnFarSide) continue;
    const double r = z[i] - (base + i * base_step);
    sum_wr += weight * r;
    sum_ww += weight * weight;
    if (r - tolerance > lowest * weight) lowest = (r - tolerance) / weight;
    if (r + tolerance < highest * weight) highest = (r + tolerance) / weight;
    if (lowest > highest) return false;
  }
  interval.lowest = lowest;
  interval.highest = highest;
  interval.sum_wr += sum_wr;
  interval.sum_ww += sum_ww;
  return true;
}

}  // namespace

bool narrow(HeightInterval& interval, const Bound& bound, LatticePoint p, const Corner& a, const Corner& b) {
  const TriangleRows rows(p, a.position, b.position);
  const Plane weight = plane_through(p, 1, a.position, 0, b.position, 0);
  const Plane base =
      plane_through(p, 0, a.position, a.height - bound.reference, b.position, b.height - bound.reference);
  const GridRect& rect = bound.samples.rect;
  for (std::int32_t y = rows.first_row; y <= rows.last_row; ++y) {
    const auto [first, last] = rows.columns(y);
    if (first > last) continue;
    const double* z =
        bound.samples.z.data() + (static_cast<std::int64_t>(y - rect.y0) * rect.width + (first - rect.x0));
    const std::array<double, 4> start{weight.at(first, y), weight.dx, bound.reference + base.at(first, y), base.dx};
    if (!narrow_row(interval, z, last - first + 1, bound.tolerance, start)) return false;
  }
  return true;
}

}  // namespace tinsmith
