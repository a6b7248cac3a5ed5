#include "samples/triangle_error.hpp"

#include "samples/triangle_sweep.hpp"

namespace tinsmith {

namespace {

template <class L>
struct ErrorSweep {
  SampleRows samples;
  double reference;
  L largest = L::all(0);
  L worst_at = L::all(0);  // index of the sample
  L squares = L::all(0);

  TINSMITH_INLINE ErrorSweep(const HeightGrid& grid, double height) : samples(grid), reference(height) {}

  TINSMITH_INLINE void operator()(const SweptTriangle& t, const Four<L>& four) {
    const L zero = L::all(0);
    const L inside = min(min(four.area_a, four.area_b), four.area_p(t));
    const L z = samples.template load<L>(four.index);
    // Divided, not multiplied by an inverse: an exact plane has no error.
    const L plane = (four.area_a * L::all(t.height_a) + four.area_b * L::all(t.height_b)) / L::all(t.area);
    const L error = where_less(inside, zero, zero, (z - L::all(reference)) - plane);
    const L distance = max(error, zero - error);
    worst_at = where_less(largest, distance, four.indices(), worst_at);
    largest = max(distance, largest);
    squares = squares + error * error;
  }
};

template <class L>
TINSMITH_INLINE TriangleError error_of(const HeightGrid& samples, const Corner& a, const Corner& b,
                                       const Corner& c) {
  ErrorSweep<L> sweep(samples, a.height);
  sweep_triangle<L>(sweep.samples, a, b, c, sweep);
  TriangleError result;
  result.largest = sweep.largest.largest();
  result.worst =
      sweep.samples.place(where_less(sweep.largest, L::all(result.largest), L::all(0), sweep.worst_at).largest());
  result.sum_of_squares = sweep.squares.sum();
  return result;
}

#ifdef TINSMITH_HAS_AVX2_VARIANT
__attribute__((target("avx2"))) TriangleError error_avx2(const HeightGrid& samples, const Corner& a,
                                                         const Corner& b, const Corner& c) {
  return error_of<Lanes<Quad>>(samples, a, b, c);
}
#endif

}  // namespace

TriangleError triangle_error_portable(const HeightGrid& samples, const Corner& a, const Corner& b,
                                      const Corner& c) {
  return error_of<Lanes<Pair>>(samples, a, b, c);
}

TriangleError triangle_error(const HeightGrid& samples, const Corner& a, const Corner& b, const Corner& c) {
#ifdef TINSMITH_HAS_AVX2_VARIANT
  if (has_avx2()) return error_avx2(samples, a, b, c);
#endif
  return triangle_error_portable(samples, a, b, c);
}

}  // namespace tinsmith
