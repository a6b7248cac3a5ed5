#include <algorithm>

#include "simplify/surface_attributes.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Values closer than that are the same (eq. 28): half a step of 8 bits.
constexpr double kSameValue = 1.0 / 512;
// How strongly the best values are drawn to those between the pair, which decide what the quadric leaves open.
constexpr double kDraw = 1e-3;

// An attribute's place among the values of a wedge. A scalar lies on the first axis: where it is the same all over
// a triangle the triangle is a point (eq. 28), where it varies a line, which leaves it open.
struct Part {
  std::size_t offset = 0;
  bool is_scalar = false;

  Vec<3> of(std::span<const double> values) const {
    if (is_scalar) return {values[offset], 0, 0};
    return {values[offset], values[offset + 1], values[offset + 2]};
  }
  void set(std::span<double> values, const Vec<3>& v) const {
    std::copy_n(v.begin(), is_scalar ? 1 : 3, values.begin() + static_cast<std::ptrdiff_t>(offset));
  }
};

class Separate : public AttributeQuadrics {
 public:
  Separate(const SurfaceMesh& mesh, const WedgeValues& all, const SimplifySurfaceOptions& options)
      : weight_(attribute_weight(mesh, options)) {
    for (const WedgeValues::Block& block : all.blocks)
      parts_.push_back({block.offset, block.kind == AttributeKind::kScalar});
    quadric_.resize(parts_.size() * mesh.original_vertex.size());
    for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
      const double weight = triangle_weight(mesh, h, options.area_weights);
      for (std::size_t i = 0; i < parts_.size(); ++i) add_triangle(mesh, all, h, i, weight);
    }
  }

  void add_cost_of_place(const WedgePair& /*pair*/, Quadric<3>& /*geometry*/) const override {}

  void find_best(const WedgePair& pair, const Vec<3>& /*place*/, std::span<double> values) const override {
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Quadric<3> quadric = sum(pair, i);
      using Q = Quadric<3>;
      const double trace = quadric.q[Q::a(0, 0)] + quadric.q[Q::a(1, 1)] + quadric.q[Q::a(2, 2)];
      quadric.add_point(parts_[i].of(values), kDraw * trace);
      Vec<3> best{};
      if (minimum(quadric, best, 1e-9)) parts_[i].set(values, best);
    }
  }

  double cost(const WedgePair& pair, const Vec<3>& /*place*/, std::span<const double> values) const override {
    double sum_of_costs = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      sum_of_costs += std::max(0.0, sum(pair, i).at(parts_[i].of(values)));
    return weight_ * sum_of_costs;
  }

  void unite(std::int32_t kept, std::int32_t gone) override {
    for (std::size_t i = 0; i < parts_.size(); ++i) of(kept, i) += of(gone, i);
  }

 private:
  Quadric<3>& of(std::int32_t w, std::size_t i) { return quadric_[at(w) * parts_.size() + i]; }
  const Quadric<3>& of(std::int32_t w, std::size_t i) const { return quadric_[at(w) * parts_.size() + i]; }

  Quadric<3> sum(const WedgePair& pair, std::size_t i) const {
    Quadric<3> quadric = of(pair.w0, i);
    if (pair.w1 != pair.w0) quadric += of(pair.w1, i);
    return quadric;
  }

  void add_triangle(const SurfaceMesh& mesh, const WedgeValues& all, std::int32_t h, std::size_t i, double weight) {
    const auto value = [&](std::int32_t k) { return parts_[i].of(all.of(mesh.wedge[at(h + k)])); };
    const auto [e1, e2] = directions_of(value(0), value(1), value(2), kSameValue);
    Quadric<3> quadric;
    quadric.add_flat(value(0), e1, e2, weight);
    for (std::int32_t k = 0; k < 3; ++k) of(mesh.wedge[at(h + k)], i) += quadric;
  }

  double weight_;
  std::vector<Part> parts_;          // by attribute
  std::vector<Quadric<3>> quadric_;  // by wedge, then by attribute
};

}  // namespace

std::unique_ptr<AttributeQuadrics> separate_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                     const SimplifySurfaceOptions& options) {
  return std::make_unique<Separate>(mesh, all, options);
}

}  // namespace tinsmith
