// The sweep over the samples of a star.

#include <algorithm>
#include <limits>

#include "samples/triangle_sweep.hpp"
#include "simplify/star.hpp"

namespace tinsmith {

namespace {

constexpr double kMax = std::numeric_limits<double>::max();

// The normal equations of a step in x, y and z, summed by triangles: moving the middle by (x, y, z) changes what a
// sample of weight w is off by w (slope . (x, y) - z).
struct StepSums {
  double xx = 0, xy = 0, yy = 0;
  double x = 0, y = 0;
  double rx = 0, ry = 0;

  void add(const SweptTriangle& t, double ww, double wr) {
    const double slope_x = (t.height_a * t.by - t.height_b * t.ay) * t.inverse_area;
    const double slope_y = (t.height_b * t.ax - t.height_a * t.bx) * t.inverse_area;
    xx += ww * slope_x * slope_x;
    xy += ww * slope_x * slope_y;
    yy += ww * slope_y * slope_y;
    x += ww * slope_x;
    y += ww * slope_y;
    rx += wr * slope_x;
    ry += wr * slope_y;
  }

  PlanSystem without_height(double ww, double wr) const {
    if (!(ww > 0)) return {};
    const double mean_x = x / ww;
    const double mean_y = y / ww;
    return {xx - x * mean_x, xy - x * mean_y, yy - y * mean_y, mean_x * wr - rx, mean_y * wr - ry};
  }
};

// What the samples seen so far say, those of each lane apart. For an interval it is noted which samples set its
// ends.
template <class L, bool kForFit>
class StarSweep {
 public:
  TINSMITH_INLINE StarSweep(const Bound& bound, LatticePoint p)
      : samples_(bound.samples), tolerance_(bound.tolerance), reference_(bound.reference), p_(p) {}

  TINSMITH_INLINE void add(const Side& side) {
    sweep_triangle<L>(samples_, {p_, reference_}, side.a, side.b, *this);
  }

  TINSMITH_INLINE void add(const Side& side, StepSums& sums) {
    const double ww = sum_ww_.sum();
    const double wr = sum_wr_.sum();
    add(side);
    sums.add({p_, side.a, side.b, reference_}, sum_ww_.sum() - ww, sum_wr_.sum() - wr);
  }

  TINSMITH_INLINE bool is_empty() const { return lowest_.largest() > highest_.smallest(); }

  // Of the height that is best for the samples so far; it never falls.
  TINSMITH_INLINE double least_squared_error() const {
    const double ww = sum_ww_.sum();
    const double wr = sum_wr_.sum();
    return ww > 0 ? sum_rr_.sum() - wr * wr / ww : 0;
  }

  TINSMITH_INLINE HeightInterval result() const {
    HeightInterval interval;
    interval.lowest = lowest_.largest();
    interval.highest = highest_.smallest();
    if constexpr (!kForFit) {
      interval.lowest_at =
          samples_.place(where_less(lowest_, L::all(interval.lowest), L::all(0), lowest_at_).largest());
      interval.highest_at =
          samples_.place(where_less(L::all(interval.highest), highest_, L::all(0), highest_at_).largest());
    }
    interval.sum_wr = sum_wr_.sum();
    interval.sum_ww = sum_ww_.sum();
    interval.sum_rr = sum_rr_.sum();
    const double low = lowest_sample_.smallest() - tolerance_ - reference_;
    const double high = highest_sample_.largest() + tolerance_ - reference_;
    if (low <= high) {
      interval.lowest = std::max(interval.lowest, low);
      interval.highest = std::min(interval.highest, high);
    }
    return interval;
  }

  TINSMITH_INLINE void operator()(const SweptTriangle& t, const Four<L>& four) {
    const L zero = L::all(0);
    const L area_p = four.area_p(t);
    // Not negative inside. On the far side (a, b) the vertex changes nothing; the areas are integers.
    const L inside = min(min(four.area_a, four.area_b), area_p - L::all(1));
    const L z = samples_.template load<L>(four.index);
    const L r = (z - L::all(reference_)) - four.base(t);
    const L per_weight = L::all(t.area) / area_p;
    const L lowest = where_less(inside, zero, L::all(-kMax), (r - L::all(tolerance_)) * per_weight);
    const L highest = where_less(inside, zero, L::all(kMax), (r + L::all(tolerance_)) * per_weight);
    if constexpr (!kForFit) {
      const L at = four.indices();
      lowest_at_ = where_less(lowest_, lowest, at, lowest_at_);
      highest_at_ = where_less(highest, highest_, at, highest_at_);
    }
    lowest_ = max(lowest, lowest_);
    highest_ = min(highest, highest_);

    const L weight = where_less(inside, zero, zero, area_p * L::all(t.inverse_area));
    const L residual = where_less(inside, zero, zero, r);
    sum_wr_ = sum_wr_ + weight * residual;
    sum_ww_ = sum_ww_ + weight * weight;
    sum_rr_ = sum_rr_ + residual * residual;
    lowest_sample_ = min(where_less(inside, zero, L::all(kMax), z), lowest_sample_);
    highest_sample_ = max(where_less(inside, zero, L::all(-kMax), z), highest_sample_);
  }

 private:
  SampleRows samples_;
  double tolerance_;
  double reference_;
  LatticePoint p_;
  L lowest_ = L::all(-kMax);
  L highest_ = L::all(kMax);
  L lowest_at_ = L::all(0);  // index of the sample
  L highest_at_ = L::all(0);
  L sum_wr_ = L::all(0);
  L sum_ww_ = L::all(0);
  L sum_rr_ = L::all(0);
  L lowest_sample_ = L::all(kMax);
  L highest_sample_ = L::all(-kMax);
};

template <class L>
TINSMITH_INLINE HeightInterval sweep(const Star& star, const Bound& bound, LatticePoint p) {
  StarSweep<L, false> so_far(bound, p);
  for (const Side& side : star) {
    so_far.add(side);
    if (so_far.is_empty()) break;
  }
  return so_far.result();
}

TINSMITH_INLINE HeightFit fit_of(const HeightInterval& interval) {
  if (interval.is_empty()) return {};
  const double height = interval.best();
  return {height, interval.squared_error(height), interval.sum_rr, true};
}

template <class L>
TINSMITH_INLINE HeightFit sweep_for_fit(const Star& star, const Bound& bound, LatticePoint p, double limit) {
  StarSweep<L, true> so_far(bound, p);
  for (const Side& side : star) {
    so_far.add(side);
    if (so_far.is_empty() || so_far.least_squared_error() >= limit) return {};
  }
  const HeightFit fit = fit_of(so_far.result());
  return fit.squared_error < limit ? fit : HeightFit{};
}

template <class L>
TINSMITH_INLINE HeightFit sweep_for_step(const Star& star, const Bound& bound, LatticePoint p, PlanSystem& system) {
  StarSweep<L, true> so_far(bound, p);
  StepSums sums;
  for (const Side& side : star) so_far.add(side, sums);
  const HeightInterval interval = so_far.result();
  system = sums.without_height(interval.sum_ww, interval.sum_wr);
  return fit_of(interval);
}

#ifdef TINSMITH_HAS_AVX2_VARIANT
__attribute__((target("avx2"))) HeightInterval sweep_avx2(const Star& star, const Bound& bound, LatticePoint p) {
  return sweep<Lanes<Quad>>(star, bound, p);
}
__attribute__((target("avx2"))) HeightFit sweep_for_fit_avx2(const Star& star, const Bound& bound, LatticePoint p,
                                                             double limit) {
  return sweep_for_fit<Lanes<Quad>>(star, bound, p, limit);
}
__attribute__((target("avx2"))) HeightFit sweep_for_step_avx2(const Star& star, const Bound& bound, LatticePoint p,
                                                              PlanSystem& system) {
  return sweep_for_step<Lanes<Quad>>(star, bound, p, system);
}
#endif

}  // namespace

HeightInterval feasible_heights_portable(const Star& star, const Bound& bound, LatticePoint p) {
  return sweep<Lanes<Pair>>(star, bound, p);
}

HeightFit fit_height_portable(const Star& star, const Bound& bound, LatticePoint p, double limit) {
  return sweep_for_fit<Lanes<Pair>>(star, bound, p, limit);
}

HeightFit fit_height_portable(const Star& star, const Bound& bound, LatticePoint p, PlanSystem& system) {
  return sweep_for_step<Lanes<Pair>>(star, bound, p, system);
}

HeightInterval feasible_heights(const Star& star, const Bound& bound, LatticePoint p) {
#ifdef TINSMITH_HAS_AVX2_VARIANT
  if (has_avx2()) return sweep_avx2(star, bound, p);
#endif
  return feasible_heights_portable(star, bound, p);
}

HeightFit fit_height(const Star& star, const Bound& bound, LatticePoint p, double limit) {
#ifdef TINSMITH_HAS_AVX2_VARIANT
  if (has_avx2()) return sweep_for_fit_avx2(star, bound, p, limit);
#endif
  return fit_height_portable(star, bound, p, limit);
}

HeightFit fit_height(const Star& star, const Bound& bound, LatticePoint p, PlanSystem& system) {
#ifdef TINSMITH_HAS_AVX2_VARIANT
  if (has_avx2()) return sweep_for_step_avx2(star, bound, p, system);
#endif
  return fit_height_portable(star, bound, p, system);
}

}  // namespace tinsmith
