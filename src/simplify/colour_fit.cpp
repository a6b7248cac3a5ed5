#include "simplify/colour_fit.hpp"

#include <algorithm>
#include <optional>

#include "samples/triangle_sweep.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The sums over the samples seen so far, those of each lane apart.
template <class L>
class ColourSweep {
 public:
  TINSMITH_INLINE ColourSweep(const ColourGrid& samples, LatticePoint p)
      : rows_(samples.channels.front()), n_channels_(samples.channels.size()), p_(p) {
    for (std::size_t c = 0; c < n_channels_; ++c) channels_[c].emplace(samples.channels[c]);
    wr_.fill(L::all(0));
    rr_.fill(L::all(0));
  }

  TINSMITH_INLINE void add(const ColourSide& side) {
    side_ = &side;
    sweep_triangle<L>(rows_, {p_, 0}, {side.a, 0}, {side.b, 0}, *this);
  }

  TINSMITH_INLINE void operator()(const SweptTriangle& t, const Four<L>& four) {
    const L zero = L::all(0);
    const L area_p = four.area_p(t);
    // Not negative inside. On the far side (a, b) the middle changes nothing; the areas are integers.
    const L inside = min(min(four.area_a, four.area_b), area_p - L::all(1));
    const L weight = where_less(inside, zero, zero, area_p * L::all(t.inverse_area));
    const L weight_a = four.area_a * L::all(t.inverse_area);
    const L weight_b = four.area_b * L::all(t.inverse_area);
    ww_ = ww_ + weight * weight;
    for (std::size_t c = 0; c < n_channels_; ++c) {
      const auto a = static_cast<double>(side_->colour_a[c]);
      const auto b = static_cast<double>(side_->colour_b[c]);
      const L level = channels_[c]->template load<L>(four.index);
      const L r = where_less(inside, zero, zero, level - weight_a * L::all(a) - weight_b * L::all(b));
      wr_[c] = wr_[c] + weight * r;
      rr_[c] = rr_[c] + r * r;
    }
  }

  TINSMITH_INLINE ColourFit result() const {
    ColourFit fit;
    fit.n_channels = n_channels_;
    fit.sum_ww = ww_.sum();
    for (std::size_t c = 0; c < n_channels_; ++c) {
      fit.sum_wr[c] = wr_[c].sum();
      fit.sum_rr[c] = rr_[c].sum();
    }
    return fit;
  }

 private:
  SampleRows rows_;
  std::size_t n_channels_;
  std::array<std::optional<SampleRows>, kMaxChannels> channels_;
  LatticePoint p_;
  const ColourSide* side_ = nullptr;
  L ww_ = L::all(0);
  std::array<L, kMaxChannels> wr_;
  std::array<L, kMaxChannels> rr_;
};

template <class L>
TINSMITH_INLINE ColourFit sweep(const ColourStar& star, const ColourGrid& samples, LatticePoint p) {
  ColourSweep<L> sums(samples, p);
  for (const ColourSide& side : star) sums.add(side);
  return sums.result();
}

#ifdef TINSMITH_HAS_AVX2_VARIANT
__attribute__((target("avx2"))) ColourFit sweep_avx2(const ColourStar& star, const ColourGrid& samples,
                                                     LatticePoint p) {
  return sweep<Lanes<Quad>>(star, samples, p);
}
#endif

}  // namespace

Levels ColourFit::best(const Levels& otherwise) const {
  if (!(sum_ww > 0)) return otherwise;
  Levels colour{};
  for (std::size_t c = 0; c < n_channels; ++c)
    colour[c] = static_cast<float>(std::clamp(sum_wr[c] / sum_ww, 0.0, 255.0));
  return colour;
}

double ColourFit::squared_error(const Levels& colour) const {
  double sum = 0;
  for (std::size_t c = 0; c < n_channels; ++c) {
    const auto level = static_cast<double>(colour[c]);
    sum += std::max(0.0, sum_rr[c] + level * (level * sum_ww - 2 * sum_wr[c]));
  }
  return sum;
}

void add_colour_sides(const WindowMesh& mesh, std::int32_t v, std::int32_t other, ColourStar& star) {
  for_each_out(mesh, v, [&](std::int32_t h) {
    const std::int32_t a = mesh.destination(h);
    const std::int32_t b = mesh.origin[at(WindowMesh::previous(h))];
    if (a == other || b == other) return;
    star.push_back({mesh.position[at(a)], mesh.position[at(b)], mesh.colour[at(a)], mesh.colour[at(b)]});
  });
}

double area_of(const ColourStar& star, LatticePoint p) {
  std::int64_t area = 0;
  for (const ColourSide& side : star) area += orient(p, side.a, side.b);
  return static_cast<double>(area) / (2.0 * kLatticePerCell * kLatticePerCell);
}

ColourFit fit_colour_portable(const ColourStar& star, const ColourGrid& samples, LatticePoint p) {
  return sweep<Lanes<Pair>>(star, samples, p);
}

ColourFit fit_colour(const ColourStar& star, const ColourGrid& samples, LatticePoint p) {
#ifdef TINSMITH_HAS_AVX2_VARIANT
  if (has_avx2()) return sweep_avx2(star, samples, p);
#endif
  return fit_colour_portable(star, samples, p);
}

}  // namespace tinsmith
