#include "simplify/surface_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/half_space_test.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Measured on scans at 1 and 5 %: the RMS distance is 0.76 times that of the collapses alone after 4 rounds, 0.72
// times after 8.
constexpr int kRounds = 4;

constexpr double kTiny = 1e-9;  // of the largest extent: a sample that near lies on the surface

std::array<Vec<3>, 3> corners_of(const SurfaceMesh& mesh, std::int32_t h) {
  return {mesh.position[at(mesh.origin[at(h)])], mesh.position[at(mesh.destination(h))],
          mesh.position[at(mesh.origin[at(Halfedges::previous(h))])]};
}

Vec<3> normal_of(const SurfaceMesh& mesh, std::int32_t h) {
  const auto [a, b, c] = corners_of(mesh, h);
  return cross(b - a, c - a);
}

Vec<3> times(const Vec<3>& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }

// ---- the point of the surface that is nearest to a sample

struct Nearest {
  double squared = std::numeric_limits<double>::infinity();
  std::int32_t halfedge = kNone;  // of its triangle
  Vec<3> share{};                 // of the triangle's corners, from halfedge on
  Vec<3> off{};                   // from there to the sample
};

// On one of the three sides.
Nearest nearest_on_sides(const std::array<Vec<3>, 3>& corner, const Vec<3>& p) {
  Nearest best;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec<3>& a = corner[k];
    const Vec<3> side = corner[(k + 1) % 3] - a;
    const double length = dot(side, side);
    const double t = length > 0 ? std::clamp(dot(p - a, side) / length, 0.0, 1.0) : 0;
    const Vec<3> off = p - a - times(side, t);
    if (!(dot(off, off) < best.squared)) continue;
    best = {dot(off, off), kNone, {}, off};
    best.share[k] = 1 - t;
    best.share[(k + 1) % 3] = t;
  }
  return best;
}

Nearest nearest_in_triangle(const SurfaceMesh& mesh, std::int32_t h, const Vec<3>& p) {
  const std::array<Vec<3>, 3> corner = corners_of(mesh, h);
  const Vec<3> n = cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double squared = dot(n, n);
  Nearest inside;
  bool is_inside = squared > 0;
  for (std::size_t k = 0; k < 3 && is_inside; ++k) {
    inside.share[k] = dot(cross(corner[(k + 1) % 3] - p, corner[(k + 2) % 3] - p), n) / squared;
    is_inside = inside.share[k] >= 0;
  }
  if (is_inside) {
    inside.off = times(n, dot(p - corner[0], n) / squared);
    inside.squared = dot(inside.off, inside.off);
  } else {
    inside = nearest_on_sides(corner, p);
  }
  inside.halfedge = h;
  return inside;
}

// Around v, then around the corner that is nearest so far, as long as that comes nearer; v follows.
Nearest nearest_from(const SurfaceMesh& mesh, std::int32_t& v, const Vec<3>& p) {
  constexpr int kMaxSteps = 16;
  Nearest best;
  for (int n_steps = 0; n_steps < kMaxSteps; ++n_steps) {
    const double before = best.squared;
    for_each_out(mesh, v, [&](std::int32_t h) {
      const Nearest here = nearest_in_triangle(mesh, h, p);
      if (here.squared < best.squared) best = here;
    });
    if (!(best.squared < before)) break;
    std::int32_t h = best.halfedge;
    if (best.share[1] > std::max(best.share[0], best.share[2])) h = Halfedges::next(h);
    if (best.share[2] > std::max(best.share[0], best.share[1])) h = Halfedges::previous(h);
    if (mesh.origin[at(h)] == v) break;
    v = mesh.origin[at(h)];
  }
  return best;
}

// ---- steps of the vertices

bool may_move(const SurfaceMesh& mesh, std::int32_t v) {
  return mesh.is_alive(v) && mesh.kind[at(v)] == SurfaceVertexKind::kInterior;
}

// Least squares of the step d of a vertex: each sample wants share x weight x (direction . d - distance)^2, the
// weight anew by the root of the distance: the fit is to the power 2.5, which leaves the RMS distance as it is with
// 2 and takes 4 % off the largest. With the share and not its square the steps of all vertices, made at once, never
// go too far: the surface under a sample moves by the mean of its corners' steps, weighed by shares.
void pull_at(Quadric<3>& pull, double weight, const Vec<3>& direction, const Vec<3>& off) {
  using Q = Quadric<3>;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = i; j < 3; ++j) pull.q[Q::a(i, j)] += weight * direction[i] * direction[j];
    pull.q[Q::b(i)] -= weight * off[i];
  }
  pull.q[Q::c()] += weight * dot(off, off);
}

std::vector<Quadric<3>> pulls_of_samples(const SurfaceMesh& mesh, FitSamples& samples) {
  std::vector<Quadric<3>> pulls(mesh.position.size());
  for (std::size_t i = 0; i < samples.place.size(); ++i) {
    if (!mesh.is_alive(samples.vertex[i])) continue;
    const Nearest there = nearest_from(mesh, samples.vertex[i], samples.place[i]);
    if (there.halfedge == kNone) continue;
    const Vec<3> across = there.squared > kTiny * kTiny ? there.off : normal_of(mesh, there.halfedge);
    const double length = std::sqrt(dot(across, across));
    if (!(length > 0)) continue;
    std::int32_t h = there.halfedge;
    const double weight = samples.weight[i] * std::sqrt(std::sqrt(there.squared) + kTiny);
    for (std::size_t k = 0; k < 3; ++k, h = Halfedges::next(h))
      pull_at(pulls[at(mesh.origin[at(h)])], weight * there.share[k], times(across, 1 / length), there.off);
  }
  return pulls;
}

// What the samples leave open stays.
bool find_step(Quadric<3> pull, Vec<3>& step) {
  using Q = Quadric<3>;
  constexpr double kDraw = 1e-2;
  const double trace = pull.q[Q::a(0, 0)] + pull.q[Q::a(1, 1)] + pull.q[Q::a(2, 2)];
  for (std::size_t i = 0; i < 3; ++i) pull.q[Q::a(i, i)] += kDraw * trace;
  if (!(trace > 0) || !minimum(pull, step, kDraw * kDraw)) return false;
  // No farther than its samples are off: of a brain at 5 % the largest distance would be twice as large.
  constexpr double kReach = 1.0;
  const double reach = kReach * std::sqrt(pull.q[Q::c()] / trace);
  const double length = std::sqrt(dot(step, step));
  if (length > reach) step = times(step, reach / length);
  return true;
}

// Edges in and around the star of v whose triangles have normals more than 90 degrees apart.
int count_turned(const SurfaceMesh& mesh, std::int32_t v) {
  int n_turned = 0;
  for_each_out(mesh, v, [&](std::int32_t h) {
    const Vec<3> n = normal_of(mesh, h);
    for (const std::int32_t side : {Halfedges::next(h), Halfedges::previous(h)}) {
      const std::int32_t g = mesh.twin[at(side)];
      if (g != kNone && !(dot(n, normal_of(mesh, g)) > 0)) ++n_turned;
    }
  });
  return n_turned;
}

void move_by(SurfaceMesh& mesh, std::int32_t v, const Vec<3>& step, std::vector<LinkSide>& star) {
  const Vec<3> before = mesh.position[at(v)];
  const Vec<3> now = before - times(step, -1);
  star.clear();
  for_each_out(mesh, v, [&](std::int32_t h) {
    const auto [own, a, b] = corners_of(mesh, h);
    star.push_back({a, b, own});
  });
  if (!is_inside_half_spaces(star, now)) return;
  const int n_turned = count_turned(mesh, v);
  mesh.position[at(v)] = now;
  if (count_turned(mesh, v) > n_turned) mesh.position[at(v)] = before;
}

void fit_places(SurfaceMesh& mesh, FitSamples& samples) {
  std::vector<LinkSide> star;
  const std::vector<Quadric<3>> pulls = pulls_of_samples(mesh, samples);
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(pulls.size()); ++v) {
    Vec<3> step{};
    if (may_move(mesh, v) && find_step(pulls[at(v)], step)) move_by(mesh, v, step, star);
  }
}

// ---- steps of the values, in the same way; seams, where a sample has several, stay

void fit_values(const SurfaceMesh& mesh, WedgeValues& values, FitSamples& samples) {
  const std::size_t n = values.n_components;
  std::vector<double> pulls(values.values.size(), 0);
  std::vector<double> weights(mesh.original_vertex.size(), 0);
  for (std::size_t i = 0; i < mesh.kind.size(); ++i) {
    if (!mesh.is_alive(samples.vertex[i]) || mesh.kind[i] != SurfaceVertexKind::kInterior) continue;
    const Nearest there = nearest_from(mesh, samples.vertex[i], samples.place[i]);
    if (there.halfedge == kNone) continue;
    std::array<std::size_t, 3> wedge{};
    std::int32_t h = there.halfedge;
    for (std::size_t k = 0; k < 3; ++k, h = Halfedges::next(h)) {
      wedge[k] = at(mesh.wedge[at(h)]);
      weights[wedge[k]] += samples.weight[i] * there.share[k];
    }
    for (std::size_t c = 0; c < n; ++c) {
      double off = samples.values[i * n + c];
      for (std::size_t k = 0; k < 3; ++k) off -= there.share[k] * values.values[wedge[k] * n + c];
      for (std::size_t k = 0; k < 3; ++k) pulls[wedge[k] * n + c] += samples.weight[i] * there.share[k] * off;
    }
  }
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.position.size()); ++v) {
    if (!may_move(mesh, v)) continue;
    const std::size_t w = at(mesh.wedge[at(mesh.out[at(v)])]);
    if (!(weights[w] > 0)) continue;
    for (std::size_t c = 0; c < n; ++c) values.values[w * n + c] += pulls[w * n + c] / weights[w];
    put_in_range(values, values.of(static_cast<std::int32_t>(w)));
  }
}

// From collapse to collapse to the vertex that is left.
void follow_collapses(const SurfaceMesh& mesh, std::vector<std::int32_t>& vertex) {
  for (std::int32_t& v : vertex) {
    while (!mesh.is_alive(v) && vertex[at(v)] != v) v = vertex[at(v)];
  }
}

}  // namespace

FitSamples fit_samples(const SurfaceMesh& mesh, const WedgeValues& values, const SimplifySurfaceOptions& options) {
  FitSamples samples;
  samples.place = mesh.position;
  samples.weight.assign(mesh.position.size(), 0);
  samples.vertex.resize(mesh.position.size());
  for (std::size_t v = 0; v < samples.vertex.size(); ++v) samples.vertex[v] = static_cast<std::int32_t>(v);
  // Exact for the squares of linear functions: a twelfth of the triangle at each corner, the rest in the middle.
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    const auto twelfth = static_cast<float>(triangle_weight(mesh, h, options.area_weights) / 12);
    const auto [a, b, c] = corners_of(mesh, h);
    for (std::int32_t k = 0; k < 3; ++k) samples.weight[at(mesh.origin[at(h + k)])] += twelfth;
    samples.place.push_back(times(a - times(b, -1) - times(c, -1), 1.0 / 3));
    samples.weight.push_back(9 * twelfth);
    samples.vertex.push_back(mesh.origin[at(h)]);
  }
  if (values.n_components == 0 || attribute_weight(options) == 0) return samples;
  samples.values.reserve(mesh.position.size() * values.n_components);
  for (const std::int32_t h : mesh.out) {
    for (const double x : values.of(mesh.wedge[at(h)])) samples.values.push_back(static_cast<float>(x));
  }
  return samples;
}

void fit(SurfaceMesh& mesh, WedgeValues& values, FitSamples& samples) {
  follow_collapses(mesh, samples.vertex);
  for (int round = 0; round < kRounds; ++round) fit_places(mesh, samples);
  for (int round = 0; round < kRounds && !samples.values.empty(); ++round) fit_values(mesh, values, samples);
}

}  // namespace tinsmith
