#include "simplify/surface_values.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

double difference(const ValuedSurface& surface, std::size_t sample, const PlaceInTriangle& place,
                  std::size_t component) {
  const std::size_t n = surface.values.n_components;
  double off = surface.samples.values[sample * n + component];
  for (std::size_t k = 0; k < 3; ++k)
    off -= place.share[k] * surface.values.values[at(place.wedge[k]) * n + component];
  return off;
}

void add(Vec<3>& to, const Vec<3>& what, double factor) {
  for (std::size_t i = 0; i < 3; ++i) to[i] += factor * what[i];
}

// By how much the shares of a triangle's corners grow with the place; false without area.
bool slopes_of_shares(const SurfaceMesh& mesh, std::int32_t h, std::array<Vec<3>, 3>& slopes) {
  const std::array<Vec<3>, 3> corners = corners_of(mesh, h);
  const Vec<3> normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double squared = dot(normal, normal);
  if (!(squared > 0)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    slopes[k] = {};
    add(slopes[k], cross(normal, corners[(k + 2) % 3] - corners[(k + 1) % 3]), 1 / squared);
  }
  return true;
}

// One step of Jacobi's, with shares for their squares, as steps of vertices.
void step_values(const ValuedSurface& surface, const std::vector<std::int32_t>& triangle) {
  const SurfaceMesh& mesh = surface.mesh;
  WedgeValues& values = surface.values;
  const std::size_t n = values.n_components;
  std::vector<double> pulls(values.values.size(), 0);
  std::vector<double> weights(mesh.original_vertex.size(), 0);
  for_each_valued(surface, triangle, [&](std::size_t i, const Nearest& there) {
    const PlaceInTriangle place = place_in(mesh, there);
    for (std::size_t k = 0; k < 3; ++k) weights[at(place.wedge[k])] += surface.samples.weight[i] * place.share[k];
    for (std::size_t c = 0; c < n; ++c) {
      const double off = surface.samples.weight[i] * difference(surface, i, place, c);
      for (std::size_t k = 0; k < 3; ++k) pulls[at(place.wedge[k]) * n + c] += place.share[k] * off;
    }
  });
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    if (!mesh.is_alive(static_cast<std::int32_t>(v)) || mesh.kind[v] != SurfaceVertexKind::kInterior) continue;
    const std::int32_t w = mesh.wedge[at(mesh.out[v])];
    if (!(weights[at(w)] > 0)) continue;
    for (std::size_t c = 0; c < n; ++c) values.values[at(w) * n + c] += pulls[at(w) * n + c] / weights[at(w)];
    put_in_range(values, values.of(w));
  }
}

// Of the values at a vertex and the mean of its neighbours', summed over the components.
double squared_difference_around(const ValuedSurface& surface, std::int32_t v) {
  const SurfaceMesh& mesh = surface.mesh;
  const std::span<const double> own = surface.values.of(mesh.wedge[at(mesh.out[at(v)])]);
  double sum = 0;
  for (std::size_t c = 0; c < own.size(); ++c) {
    double of_neighbours = 0;
    int n = 0;
    for_each_out(mesh, v, [&](std::int32_t h) {
      of_neighbours += surface.values.of(mesh.wedge[at(Halfedges::next(h))])[c];
      ++n;
    });
    const double off = own[c] - of_neighbours / n;
    sum += off * off;
  }
  return sum;
}

}  // namespace

PlaceInTriangle place_in(const SurfaceMesh& mesh, const Nearest& there) {
  PlaceInTriangle place{{}, there.share};
  for (std::int32_t k = 0; k < 3; ++k) place.wedge[at(k)] = mesh.wedge[at(there.halfedge + k)];
  return place;
}

double squared_difference(const ValuedSurface& surface, std::size_t sample, const PlaceInTriangle& place) {
  double sum = 0;
  for (std::size_t c = 0; c < surface.values.n_components; ++c) {
    const double off = difference(surface, sample, place, c);
    sum += off * off;
  }
  return sum;
}

// A vertex with a share in the place that steps by d takes the values along: there they change by -share x slope .
// d (Gauss and Newton's linear form). With the share and not its square, as for places.
void pull_by_values(const ValuedSurface& surface, std::size_t sample, const Nearest& there, double weight,
                    std::vector<Quadric<3>>& pulls) {
  using Q = Quadric<3>;
  std::array<Vec<3>, 3> slopes;
  if (!slopes_of_shares(surface.mesh, there.halfedge, slopes)) return;
  const PlaceInTriangle place = place_in(surface.mesh, there);
  Q pull;
  for (std::size_t c = 0; c < surface.values.n_components; ++c) {
    Vec<3> slope{};
    for (std::size_t k = 0; k < 3; ++k) add(slope, slopes[k], surface.values.of(place.wedge[k])[c]);
    const double off = difference(surface, sample, place, c);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = i; j < 3; ++j) pull.q[Q::a(i, j)] += slope[i] * slope[j];
      pull.q[Q::b(i)] += slope[i] * off;
    }
    pull.q[Q::c()] += off * off;
  }
  for (std::int32_t k = 0; k < 3; ++k) {
    const double factor = weight * place.share[at(k)];
    if (!(factor > 0)) continue;
    Q& sum = pulls[at(surface.mesh.origin[at(there.halfedge + k)])];
    for (std::size_t i = 0; i < pull.q.size(); ++i) sum.q[i] += factor * pull.q[i];
  }
}

void fit_values(const ValuedSurface& surface, const std::vector<std::int32_t>& triangle) {
  constexpr int kSteps = 4;
  for (int step = 0; step < kSteps; ++step) step_values(surface, triangle);
}

SurfaceErrors errors_of(const ValuedSurface& surface) {
  const std::vector<std::int32_t> not_known(surface.samples.has_values.size(), kNone);
  SurfaceErrors sums;
  double weights = 0;
  for_each_valued(surface, not_known, [&](std::size_t i, const Nearest& there) {
    const double weight = surface.samples.weight[i];
    weights += weight;
    sums.squared_distance += weight * there.squared;
    sums.squared_difference += weight * squared_difference(surface, i, place_in(surface.mesh, there));
  });
  if (!(weights > 0)) return {};
  return {sums.squared_distance / weights, sums.squared_difference / weights};
}

// What a linear function between vertices is off by grows with the square of their distance, as long as the values
// are smooth; where they are not this foresees too much, and the weight is the usual one. Of a smoothly coloured
// sphere at 20 and 5 % the largest distance would be 1.2 times that of geometry alone, not 1.06 and 1.05 times.
double seen_weight(double usual, const ValuedSurface& input, double times_fewer) {
  double sum = 0;
  double n = 0;
  for (std::size_t v = 0; v < input.samples.has_values.size(); ++v) {
    if (!input.samples.is_valued(v)) continue;
    sum += squared_difference_around(input, static_cast<std::int32_t>(v));
    ++n;
  }
  if (!(n > 0)) return usual;
  const double foreseen = std::sqrt(sum / n) / 2 * times_fewer;
  return usual * std::min(1.0, foreseen * foreseen / (kSmallDifference * kSmallDifference));
}

// As in attribute_weight(), the ratio of the squared errors grows with the cube of the length. The usual weight is
// right for what is rough; the smoother a shape, the more it costs to move its vertices, hence the power. Of a
// checkered sphere and torus at 1 % the colours' error is 0.89 times that of geometry alone, the RMS distance 1.05
// and 0.95 times; with the usual weight the latter was 1.27 and 1.08 times, with a least weight of 0.1 the
// sphere's 1.12.
double balanced_weight(double usual, const SurfaceErrors& errors, double times_fewer) {
  constexpr double kPower = 5;
  constexpr double kLeast = 0.05;  // on flat ground too
  const double length = std::sqrt(times_fewer);
  const double off = errors.squared_distance * length * length * length;
  if (!(off < usual * errors.squared_difference)) return usual;
  return usual * std::max(kLeast, std::pow(off / (usual * errors.squared_difference), kPower));
}

}  // namespace tinsmith
