#include "simplify/surface_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "simplify/surface_farthest.hpp"
#include "simplify/surface_flips.hpp"
#include "simplify/surface_star.hpp"
#include "simplify/surface_values.hpp"
#include "simplify/surface_walk.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A third takes 1 to 3 % off the RMS distance, for a quarter more time of the fit.
constexpr int kRounds = 2;
// Before the steps of the first of them edges flip: 1 to 9 % off the RMS distance, most where few triangles are
// left. Before those of the second only to fit in what was added: at 50 % the RMS distance would be up to 1.03
// times.
constexpr int kFlipRounds = 1;
// Of the vertices that are added, so many come before the last round, whose steps fit them in, the rest in the end.
constexpr double kBeforeLastRound = 0.9;
// Rounds where values draw at the vertices too. Of a checkered bunny at 1 % the RMS distance is 1.01 times as large
// with four, and with two the colours' error 1 % more.
constexpr int kValuedRounds = 6;

constexpr double kTiny = 1e-9;  // of the largest extent: a sample that near lies on the surface

Vec<3> times(const Vec<3>& v, double factor) { return {v[0] * factor, v[1] * factor, v[2] * factor}; }

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

// Where the fit stands.
struct Fit {
  std::vector<std::int32_t> triangle;   // by sample: the first halfedge of that with the nearest point; kNone: none
  std::vector<float> squared;           // by sample: its squared distance
  std::vector<Quadric<3>> pulls;        // by vertex
  std::vector<std::uint8_t> is_astray;  // by vertex: a triangle of it has a sample that is too far
  std::vector<Vec<3>> home;             // by vertex: where it was at the start
  std::vector<std::int32_t> below;      // by vertex: as triangle, of the input; kNone: not sought yet
  float largest = 0;                    // squared distance at the start
  bool is_input_turned = false;         // has edges with normals more than 90 degrees apart
  double value_weight = 0;              // of squared differences beside distances to the power 2.5
};

// What is nearly as far off as the farthest sample was at the start counts more than the power 2.5 gives it: this
// rises from 0 to 1.
double urgency(double squared, const Fit& fit) {
  if (!(fit.largest > 0)) return 0;
  const double share = std::min(1.0, squared / fit.largest);
  return share * share;
}

void pull(const WalkedSurface& surface, const Nearest& there, double weight, Fit& fit) {
  const Vec<3> across = there.squared > kTiny * kTiny ? there.off : normal_of(surface, there.halfedge);
  const double length = std::sqrt(dot(across, across));
  if (!(length > 0)) return;
  const Vec<3> direction = times(across, 1 / length);
  // With kOfUrgentVertices below, beside none of both: the largest distance of an elephant at 50 % is 0.92 times,
  // of a sphere at 50 % 0.95 and at 1 % 0.87 times, of a head at 5 % 1.08 times; the RMS distance at most 1.02
  // times.
  constexpr double kOfUrgentSamples = 4;
  weight *= std::sqrt(std::sqrt(there.squared) + kTiny) * (1 + kOfUrgentSamples * urgency(there.squared, fit));
  for (std::int32_t k = 0; k < 3; ++k) {
    if (there.share[at(k)] > 0)
      pull_at(fit.pulls[at(surface.mesh.origin[at(there.halfedge + k)])], weight * there.share[at(k)], direction,
              there.off);
  }
}

// The middles of triangles that are left are sought there first.
void start_nearby(const SurfaceMesh& mesh, const FitSamples& samples, Fit& fit) {
  fit.triangle.assign(samples.place.size(), kNone);
  const std::size_t first_middle = mesh.position.size();
  for (std::size_t h = 0; h < mesh.origin.size(); h += 3) {
    if (mesh.origin[h] != kNone) fit.triangle[first_middle + h / 3] = static_cast<std::int32_t>(h);
  }
}

// Where each sample lies now; calls found(surface, sample, nearest) for those that lie anywhere. Where one is
// nearer than the square root of `enough` it may lie nearer yet.
template <class Found>
void find_nearest(const SurfaceMesh& mesh, const FitSamples& samples, double enough, Fit& fit, Found&& found) {
  const WalkedSurface surface{mesh, mesh.position};
  for (std::size_t i = 0; i < samples.place.size(); ++i) {
    if (!mesh.is_alive(samples.vertex[i])) continue;
    const Nearest there = nearest(surface, samples.place[i], fit.triangle[i], samples.vertex[i], enough);
    fit.triangle[i] = there.halfedge;
    if (there.halfedge == kNone) continue;
    fit.squared[i] = static_cast<float>(there.squared);
    found(surface, i, there);
  }
}

void find_nearest(const SurfaceMesh& mesh, const FitSamples& samples, double enough, Fit& fit) {
  find_nearest(mesh, samples, enough, fit, [](const WalkedSurface&, std::size_t, const Nearest&) {});
}

// And how they pull at the vertices.
void find_pulls(const ValuedSurface& valued, Fit& fit) {
  const FitSamples& samples = valued.samples;
  fit.pulls.assign(valued.mesh.position.size(), {});
  find_nearest(valued.mesh, samples, 0, fit,
               [&](const WalkedSurface& surface, std::size_t i, const Nearest& there) {
                 pull(surface, there, samples.weight[i], fit);
                 if (fit.value_weight > 0 && samples.is_valued(i))
                   pull_by_values(valued, i, there, fit.value_weight * samples.weight[i], fit.pulls);
               });
}

// The corners under samples that are farther off than any was at the start.
void find_astray(const SurfaceMesh& mesh, Fit& fit) {
  fit.is_astray.assign(mesh.position.size(), 0);
  for (std::size_t i = 0; i < fit.squared.size(); ++i) {
    if (fit.triangle[i] == kNone || !(fit.squared[i] > fit.largest)) continue;
    for (std::int32_t k = 0; k < 3; ++k) fit.is_astray[at(mesh.origin[at(fit.triangle[i] + k)])] = 1;
  }
}

bool has_turned_edges(const WalkedSurface& surface) {
  for (std::int32_t h = 0; h < surface.mesh.n_halfedges(); ++h) {
    const std::int32_t g = surface.mesh.twin[at(h)];
    if (g > h && dot(normal_of(surface, h), normal_of(surface, g)) < 0) return true;
  }
  return false;
}

// Whether a place of the surface, near the vertex v, is farther from the input than any sample was from the
// surface at the start, or the normal there turned away from the input's. Where the input is folded itself, the
// nearest place is often beyond the fold, where the normal says nothing.
bool is_astray(const WalkedSurface& input, const Fit& fit, const Vec<3>& place, const Vec<3>& normal,
               std::int32_t v) {
  const Nearest there = nearest(input, place, fit.below[at(v)], v);
  if (there.halfedge == kNone) return true;
  if (there.squared > fit.largest) return true;
  return !fit.is_input_turned && dot(normal, normal_of(input, there.halfedge)) < 0;
}

// The corners of triangles that are, by their middles and those of their sides.
void find_astray_back(const WalkedSurface& input, const SurfaceMesh& mesh, Fit& fit) {
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[at(h)] == kNone) continue;
    const auto [a, b, c] = corners_of(mesh, h);
    const Vec<3> side = times(a - times(b, -1), 0.5);
    const Vec<3> middle = times(a - times(b, -1) - times(c, -1), 1.0 / 3);
    const std::int32_t v = mesh.origin[at(h)];
    const bool is_first = h % 3 == 0;
    const bool is_once = h > mesh.twin[at(h)];
    if (!(is_first && is_astray(input, fit, middle, cross(b - a, c - a), v)) &&
        !(is_once && nearest(input, side, fit.below[at(v)], v, fit.largest).squared > fit.largest))
      continue;
    for (const std::int32_t corner : {h, Halfedges::next(h), Halfedges::previous(h)})
      fit.is_astray[at(mesh.origin[at(corner)])] = 1;
  }
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

void move_by(SurfaceMesh& mesh, std::int32_t v, const Vec<3>& step, SurfaceStar& star) {
  const Vec<3> now = mesh.position[at(v)] - times(step, -1);
  clear(star);
  for_each_out(mesh, v, [&](std::int32_t h) { add_side(mesh, h, star); });
  if (!is_inside_half_spaces(star.sides, now) || turns_more(star, now)) return;
  mesh.position[at(v)] = now;
}

// No farther from home than half the largest distance at the start: thin parts of scans would stand out from the
// input where it has no samples. Measured, the largest distance of a head at 20 %: 1.0 times CGAL's with a
// half, 1.2 with one, 1.3 without a bound, which makes the RMS distance 1 % less.
void hold_near_home(const Vec<3>& off_home, double roam, Vec<3>& step) {
  const Vec<3> goal = step - times(off_home, -1);
  const double length = std::sqrt(dot(goal, goal));
  if (length > roam) step = times(goal, roam / length) - off_home;
}

// A vertex wants to be near the input too, beside its samples, where it is urgent: the places that are best for
// the samples of round ground lie off it, and at 50 % many vertices were as far off as the farthest sample.
void pull_back(const Nearest& below, const Fit& fit, Quadric<3>& pull) {
  using Q = Quadric<3>;
  constexpr double kOfUrgentVertices = 0.4;  // of the weight of its samples
  const double length = std::sqrt(below.squared);
  if (below.halfedge == kNone || !(length > 0)) return;
  const double trace = pull.q[Q::a(0, 0)] + pull.q[Q::a(1, 1)] + pull.q[Q::a(2, 2)];
  pull_at(pull, kOfUrgentVertices * urgency(below.squared, fit) * trace, times(below.off, 1 / length),
          times(below.off, -1));
}

// A vertex, and the place of the input that is nearest to it.
struct Grounded {
  std::int32_t v;
  const Vec<3>& p;
  Nearest below;
};

// The largest part of the step that leaves the vertex no farther from the input than the farthest sample was from
// the surface at the start, or no farther than it is: samples know where the input is, not where the surface goes.
void hold_near_input(const WalkedSurface& input, const Grounded& vertex, Fit& fit, Vec<3>& step) {
  const double squared = std::max(static_cast<double>(fit.largest), vertex.below.squared);
  Nearest there = vertex.below;
  constexpr int kHalves = 3;
  for (int i = 0; i < kHalves; ++i) {
    there = nearest(input, vertex.p - times(step, -1), there.halfedge, vertex.v, squared);
    if (there.squared <= squared) {
      fit.below[at(vertex.v)] = there.halfedge;
      return;
    }
    step = times(step, 0.5);
  }
  step = {};
}

void step_all(const WalkedSurface& input, SurfaceMesh& mesh, Fit& fit) {
  constexpr double kRoam = 0.5;
  const double roam = kRoam * std::sqrt(static_cast<double>(fit.largest));
  SurfaceStar star;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(fit.pulls.size()); ++v) {
    if (!may_move(mesh, v) || fit.is_astray[at(v)]) continue;
    const Vec<3>& p = mesh.position[at(v)];
    const Nearest below = nearest(input, p, fit.below[at(v)], v);
    fit.below[at(v)] = below.halfedge;
    pull_back(below, fit, fit.pulls[at(v)]);
    Vec<3> step{};
    if (!find_step(fit.pulls[at(v)], step)) continue;
    hold_near_home(p - fit.home[at(v)], roam, step);
    hold_near_input(input, {v, p, below}, fit, step);
    move_by(mesh, v, step, star);
  }
}

// Half of the way home, where a sample is too far.
void draw_back(SurfaceMesh& mesh, const Fit& fit) {
  SurfaceStar star;
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(fit.home.size()); ++v) {
    if (!may_move(mesh, v) || !fit.is_astray[at(v)]) continue;
    move_by(mesh, v, times(fit.home[at(v)] - mesh.position[at(v)], 0.5), star);
  }
}

void flip(const WalkedSurface& input, const ValuedSurface& valued, SurfaceMesh& mesh, const Fit& fit) {
  const FitSamples& samples = valued.samples;
  ValueError value_error;
  if (fit.value_weight > 0) {
    value_error = [&](std::size_t i, const PlaceInTriangle& place) {
      return samples.is_valued(i) ? fit.value_weight * squared_difference(valued, i, place) : 0;
    };
  }
  flip_nearer(mesh, {samples.place, samples.weight, fit.triangle, fit.squared, value_error},
              [&](const Vec<3>& place, const Vec<3>& normal, std::int32_t v) {
                return is_astray(input, fit, place, normal, v);
              });
}

// So that values count about as much as places do. Of a checkered sphere and torus at 5 and 1 % the half takes up
// to 2 % off the RMS distance and adds as much to the colours' error. Values that are off by less than
// kSmallDifference count as if they were off by that: of a smoothly coloured sphere at 1 % the RMS distance is 1.05
// times that of geometry alone, not 1.20 times, for 1 % more of the colours' error. 0 where nothing is to be
// gained.
double weight_of_values(const ValuedSurface& valued, const Fit& fit) {
  constexpr double kOfValues = 3;
  constexpr double kEqual = 1e-6;  // no more than rounding
  double weights = 0;
  double off = 0;
  double different = 0;
  for_each_valued(valued, fit.triangle, [&](std::size_t i, const Nearest& there) {
    const double weight = valued.samples.weight[i];
    weights += weight;
    off += weight * there.squared * std::sqrt(std::sqrt(there.squared));
    different += weight * squared_difference(valued, i, place_in(valued.mesh, there));
  });
  if (!(different > kEqual * kEqual * weights)) return 0;
  return kOfValues * off / std::max(different, kSmallDifference * kSmallDifference * weights);
}

// Up to n triangles with them; returns how many. On a sphere all vertices lie off, equally far: they come nearer
// only so often. With no more steps beside values one of 63 coloured results, a sphere, is 1.13 times as far off as
// without colours.
std::size_t add_vertices(const ValuedSurface& valued, SurfaceMesh& mesh, std::size_t n, Fit& fit) {
  constexpr std::size_t kSteps = 10;  // for each triangle
  constexpr std::size_t kStepsBesideValues = 20;
  if (n < 2) return 0;
  const std::size_t n_steps = n * (fit.value_weight > 0 ? kStepsBesideValues : kSteps);
  find_nearest(mesh, valued.samples, 0, fit);
  std::size_t n_added = 0;
  for (const auto& [v, below] :
       bring_in_farthest(mesh, valued.values, valued.samples, {fit.triangle, fit.squared}, {n, n_steps})) {
    n_added += mesh.is_border_vertex(v) ? 1 : 2;
    fit.home[at(v)] = mesh.position[at(v)];
    fit.below[at(v)] = below;
  }
  return n_added;
}

}  // namespace

void fit(SurfaceMesh& mesh, WedgeValues& values, FitSamples& samples, bool may_flip, std::size_t n_triangles) {
  follow_collapses(mesh, samples);
  Fit fit;
  const ValuedSurface valued{mesh, values, samples};
  const bool has_values = !samples.values.empty();
  start_nearby(mesh, samples, fit);
  fit.squared.assign(samples.place.size(), 0);
  fit.home = mesh.position;
  fit.below.assign(mesh.position.size(), kNone);
  const WalkedSurface input{samples.triangles, samples.place};
  fit.is_input_turned = has_turned_edges(input);
  find_nearest(mesh, samples, 0, fit);
  fit.largest = *std::max_element(fit.squared.begin(), fit.squared.end());
  if (has_values) {
    fit_values(valued, fit.triangle);
    fit.value_weight = weight_of_values(valued, fit);
  }
  const bool is_drawn_by_values = fit.value_weight > 0;
  const int n_rounds = is_drawn_by_values ? kValuedRounds : kRounds;
  for (int round = 0; round < n_rounds; ++round) {
    std::size_t n_added = 0;
    if (round + 1 == n_rounds) {
      const std::size_t n_vertices = n_triangles / 2;
      const long n_first = std::lround(kBeforeLastRound * static_cast<double>(n_vertices));
      n_added = add_vertices(valued, mesh, 2 * static_cast<std::size_t>(n_first), fit);
      n_triangles -= n_added;
    }
    if (may_flip && (is_drawn_by_values || round < kFlipRounds || n_added > 0)) flip(input, valued, mesh, fit);
    find_pulls(valued, fit);
    find_astray(mesh, fit);
    draw_back(mesh, fit);
    step_all(input, mesh, fit);
    if (is_drawn_by_values) fit_values(valued, fit.triangle);
  }
  find_nearest(mesh, samples, fit.largest, fit);
  find_astray(mesh, fit);
  find_astray_back(input, mesh, fit);
  draw_back(mesh, fit);
  add_vertices(valued, mesh, n_triangles, fit);
  if (has_values) fit_values(valued, fit.triangle);
}

}  // namespace tinsmith
