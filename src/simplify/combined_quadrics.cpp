#include <algorithm>
#include <cmath>
#include <optional>

#include "simplify/surface_attributes.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kDraw = 1e-3;  // to the values between, where the quadric leaves them open

class Combined : public AttributeQuadrics {
 public:
  Combined(const SurfaceMesh& mesh, const WedgeValues& all, const SimplifySurfaceOptions& options)
      : scale_(std::sqrt(attribute_weight(mesh, options))), quadric_(mesh.original_vertex.size()) {
    for (const WedgeValues::Block& block : all.blocks) {
      if (!offset_ && block.kind != AttributeKind::kScalar) offset_ = block.offset;
    }
    for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
      const auto point = [&](std::int32_t k) {
        return point_of(mesh.position[at(mesh.origin[at(h + k)])], all.of(mesh.wedge[at(h + k)]));
      };
      const auto [e1, e2] = directions_of(point(0), point(1), point(2), 1e-12);
      Quadric<6> quadric;
      quadric.add_flat(point(0), e1, e2, triangle_weight(mesh, h, options.area_weights));
      for (std::int32_t k = 0; k < 3; ++k) quadric_[at(mesh.wedge[at(h + k)])] += quadric;
    }
  }

  // The Schur complement: the minimum over the values, as a quadric of the place.
  void add_cost_of_place(const WedgePair& pair, Quadric<3>& geometry) const override {
    const Quadric<6> q = sum(pair);
    using Q6 = Quadric<6>;
    using Q3 = Quadric<3>;
    const Quadric<3> values = values_part(q);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) geometry.q[Q3::a(i, j)] += q.q[Q6::a(i, j)];
      geometry.q[Q3::b(i)] += q.q[Q6::b(i)];
    }
    geometry.q[Q3::c()] += q.q[Q6::c()];
    // Columns of the coupling and the linear part, each solved with the values' own matrix.
    std::array<Vec<3>, 4> right{};
    std::array<Vec<3>, 4> solved{};
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t i = 0; i < 3; ++i) right[i][k] = q.q[Q6::a(i, 3 + k)];
      right[3][k] = q.q[Q6::b(3 + k)];
    }
    for (std::size_t i = 0; i < 4; ++i) {
      if (!solve(values, right[i], 1e-9, solved[i])) return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) geometry.q[Q3::a(i, j)] -= dot(right[i], solved[j]);
      geometry.q[Q3::b(i)] -= dot(right[i], solved[3]);
    }
    geometry.q[Q3::c()] -= dot(right[3], solved[3]);
  }

  void find_best(const WedgePair& pair, const Vec<3>& place, std::span<double> values) const override {
    if (!offset_) return;
    const Quadric<6> q = sum(pair);
    using Q6 = Quadric<6>;
    Quadric<3> of_values = values_part(q);
    for (std::size_t k = 0; k < 3; ++k) {
      double linear = q.q[Q6::b(3 + k)];
      for (std::size_t i = 0; i < 3; ++i) linear += q.q[Q6::a(i, 3 + k)] * place[i];
      of_values.q[Quadric<3>::b(k)] = linear;
    }
    using Q3 = Quadric<3>;
    const double trace = of_values.q[Q3::a(0, 0)] + of_values.q[Q3::a(1, 1)] + of_values.q[Q3::a(2, 2)];
    const Vec<6> between = point_of(place, values);
    of_values.add_point({between[3], between[4], between[5]}, kDraw * trace);
    Vec<3> best{};
    if (!minimum(of_values, best, 1e-9) || scale_ == 0) return;
    for (std::size_t k = 0; k < 3; ++k) values[*offset_ + k] = best[k] / scale_;
  }

  double cost(const WedgePair& pair, const Vec<3>& place, std::span<const double> values) const override {
    return std::max(0.0, sum(pair).at(point_of(place, values)));
  }

  void unite(std::int32_t kept, std::int32_t gone) override { quadric_[at(kept)] += quadric_[at(gone)]; }

 private:
  Vec<6> point_of(const Vec<3>& place, std::span<const double> values) const {
    Vec<6> p{place[0], place[1], place[2], 0, 0, 0};
    for (std::size_t k = 0; offset_ && k < 3; ++k) p[3 + k] = scale_ * values[*offset_ + k];
    return p;
  }

  static Quadric<3> values_part(const Quadric<6>& q) {
    Quadric<3> part;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) part.q[Quadric<3>::a(i, j)] = q.q[Quadric<6>::a(3 + i, 3 + j)];
    }
    return part;
  }

  Quadric<6> sum(const WedgePair& pair) const {
    Quadric<6> quadric = quadric_[at(pair.w0)];
    if (pair.w1 != pair.w0) quadric += quadric_[at(pair.w1)];
    return quadric;
  }

  double scale_;
  std::optional<std::size_t> offset_;  // of the first colour or normal
  std::vector<Quadric<6>> quadric_;    // by wedge
};

}  // namespace

std::unique_ptr<AttributeQuadrics> combined_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                     const SimplifySurfaceOptions& options) {
  return std::make_unique<Combined>(mesh, all, options);
}

}  // namespace tinsmith
