#include <algorithm>
#include <cmath>
#include <limits>

#include "simplify/surface_attributes.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A linear function of the place: slope . p + start.
struct Linear {
  Vec<3> slope{};
  double start = 0;
  double at(const Vec<3>& p) const { return dot(slope, p) + start; }
};

// Sums over triangles of weight x (value - linear function)^2, of which the value's own part is weight_sum x
// value^2.
class Gradient : public AttributeQuadrics {
 public:
  Gradient(const SurfaceMesh& mesh, const WedgeValues& all, const SimplifySurfaceOptions& options)
      : attribute_weight_(attribute_weight(mesh, options)),
        n_(all.n_components),
        square_(mesh.original_vertex.size()),
        linear_(mesh.original_vertex.size() * n_),
        weight_(mesh.original_vertex.size(), 0),
        steepest_(steepest(mesh, options)) {
    for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) add_triangle(mesh, all, h, options.area_weights);
  }

  void add_cost_of_place(const WedgePair& pair, Quadric<3>& geometry) const override {
    const double weight = sum_weight(pair);
    if (!(weight > 0)) return;
    const Quadric<3> square = sum_square(pair);
    for (std::size_t i = 0; i < square.q.size(); ++i) geometry.q[i] += attribute_weight_ * square.q[i];
    for (std::size_t c = 0; c < n_; ++c) add_square(geometry, sum_linear(pair, c), -attribute_weight_ / weight);
  }

  void find_best(const WedgePair& pair, const Vec<3>& place, std::span<double> values) const override {
    const double weight = sum_weight(pair);
    if (!(weight > 0)) return;
    for (std::size_t c = 0; c < n_; ++c) values[c] = sum_linear(pair, c).at(place) / weight;
  }

  double cost(const WedgePair& pair, const Vec<3>& place, std::span<const double> values) const override {
    double sum = sum_square(pair).at(place);
    const double weight = sum_weight(pair);
    for (std::size_t c = 0; c < n_; ++c)
      sum += values[c] * (weight * values[c] - 2 * sum_linear(pair, c).at(place));
    return attribute_weight_ * std::max(0.0, sum);
  }

  void unite(std::int32_t kept, std::int32_t gone) override {
    square_[at(kept)] += square_[at(gone)];
    weight_[at(kept)] += weight_[at(gone)];
    for (std::size_t c = 0; c < n_; ++c) add(linear(kept, c), linear(gone, c), 1);
  }

  void set_weight(double weight) override { attribute_weight_ = weight; }

 private:
  Linear& linear(std::int32_t w, std::size_t c) { return linear_[at(w) * n_ + c]; }
  const Linear& linear(std::int32_t w, std::size_t c) const { return linear_[at(w) * n_ + c]; }

  static void add(Linear& to, const Linear& what, double factor) {
    for (std::size_t i = 0; i < 3; ++i) to.slope[i] += factor * what.slope[i];
    to.start += factor * what.start;
  }

  // Adds factor x (the linear function)^2.
  static void add_square(Quadric<3>& quadric, const Linear& f, double factor) {
    using Q = Quadric<3>;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) quadric.q[Q::a(i, j)] += factor * f.slope[i] * f.slope[j];
      quadric.q[Q::b(i)] += factor * f.start * f.slope[i];
    }
    quadric.q[Q::c()] += factor * f.start * f.start;
  }

  // Its value at the middle stays.
  void make_less_steep(Linear& f, const Vec<3>& middle) const {
    const double steepness = std::sqrt(dot(f.slope, f.slope));
    if (!(steepness > steepest_)) return;
    f.start = f.at(middle);
    for (double& x : f.slope) x *= steepest_ / steepness;
    f.start -= dot(f.slope, middle);
  }

  double sum_weight(const WedgePair& pair) const {
    return weight_[at(pair.w0)] + (pair.w1 != pair.w0 ? weight_[at(pair.w1)] : 0);
  }
  Quadric<3> sum_square(const WedgePair& pair) const {
    Quadric<3> quadric = square_[at(pair.w0)];
    if (pair.w1 != pair.w0) quadric += square_[at(pair.w1)];
    return quadric;
  }
  Linear sum_linear(const WedgePair& pair, std::size_t c) const {
    Linear f = linear(pair.w0, c);
    if (pair.w1 != pair.w0) add(f, linear(pair.w1, c), 1);
    return f;
  }

  // The function within the triangle's plane that has the values at its corners, with no slope across (eq. 5 of
  // Hoppe); of one that is too steep the mean, with less slope.
  void add_triangle(const SurfaceMesh& mesh, const WedgeValues& all, std::int32_t h, bool area_weights) {
    const auto [p, q, r] = corners_of(mesh, h);
    const Vec<3> u = q - p;
    const Vec<3> v = r - p;
    const Vec<3> normal = cross(u, v);
    const double squared = dot(normal, normal);
    const double weight = triangle_weight(mesh, h, area_weights);
    const Vec<3> middle{p[0] + (u[0] + v[0]) / 3, p[1] + (u[1] + v[1]) / 3, p[2] + (u[2] + v[2]) / 3};
    const Vec<3> along_u = cross(v, normal);  // u . along_u = squared, v . along_u = 0
    const Vec<3> along_v = cross(normal, u);
    for (std::size_t c = 0; c < n_; ++c) {
      const auto value = [&](std::int32_t k) { return all.of(mesh.wedge[at(h + k)])[c]; };
      Linear f{{}, value(0)};
      if (squared > 0) {
        for (std::size_t i = 0; i < 3; ++i)
          f.slope[i] = ((value(1) - value(0)) * along_u[i] + (value(2) - value(0)) * along_v[i]) / squared;
        f.start -= dot(f.slope, p);
        make_less_steep(f, middle);
      }
      for (std::int32_t k = 0; k < 3; ++k) {
        const std::int32_t w = mesh.wedge[at(h + k)];
        add_square(square_[at(w)], f, weight);
        add(linear(w, c), f, weight);
      }
    }
    for (std::int32_t k = 0; k < 3; ++k) weight_[at(mesh.wedge[at(h + k)])] += weight;
  }

  // What rises through the whole range within two edges of the result is a jump there: as a slope it would go on
  // beyond its triangle, and say of all places around that their values are wrong. Of a checkered bunny at 20, 5
  // and 1 % the RMS distance would be 1.10, 1.16 and 1.17 times as large without, at 5 and 1 % the colours'
  // error 1.06 times.
  static double steepest(const SurfaceMesh& mesh, const SimplifySurfaceOptions& options) {
    constexpr double kEdges = 2;
    const double length = length_in_result(mesh, options);
    return length > 0 ? 1 / (kEdges * length) : std::numeric_limits<double>::infinity();
  }

  double attribute_weight_;
  std::size_t n_;
  std::vector<Quadric<3>> square_;  // by wedge
  std::vector<Linear> linear_;      // by wedge, then by component
  std::vector<double> weight_;      // by wedge
  double steepest_;                 // no slope is steeper
};

}  // namespace

std::unique_ptr<AttributeQuadrics> gradient_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                     const SimplifySurfaceOptions& options) {
  return std::make_unique<Gradient>(mesh, all, options);
}

}  // namespace tinsmith
