#include "simplify/surface_flips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "simplify/surface_star.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// A flip must be worth its disturbance.
constexpr double kWorthwhile = 0.98;
// Twice the area over the square of the longest side: 0.87 of an equilateral triangle.
constexpr double kThin = 0.1;

using Triangle = std::array<Vec<3>, 3>;

Vec<3> normal_of(const Triangle& t) { return cross(t[1] - t[0], t[2] - t[0]); }

double squared_length(const Vec<3>& v) { return dot(v, v); }

double thickness(const Triangle& t) {
  const double longest =
      std::max({squared_length(t[1] - t[0]), squared_length(t[2] - t[1]), squared_length(t[0] - t[2])});
  return std::sqrt(squared_length(normal_of(t))) / longest;
}

// Samples by triangle, as one array with offsets.
class ByTriangle {
 public:
  ByTriangle(const std::vector<std::int32_t>& triangle, std::size_t n_triangles) : first_(n_triangles + 1, 0) {
    for (const std::int32_t t : triangle) {
      if (t != kNone) ++first_[at(t / 3) + 1];
    }
    for (std::size_t t = 0; t < n_triangles; ++t) first_[t + 1] += first_[t];
    sample_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < triangle.size(); ++i) {
      if (triangle[i] != kNone) sample_[next[at(triangle[i] / 3)]++] = static_cast<std::uint32_t>(i);
    }
  }

  std::span<const std::uint32_t> of(std::int32_t h) const {
    return {sample_.data() + first_[at(h / 3)], sample_.data() + first_[at(h / 3) + 1]};
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> sample_;
};

//        c          The edge of h from a to b, and what becomes of its triangles.
//      /   \        .
//     a --> b       .
//      \   /        .
//        d          .
struct Quadrilateral {
  std::int32_t h, g;
  std::int32_t a, b, c, d;
  std::array<Triangle, 2> before;
  std::array<Triangle, 2> after;

  Quadrilateral(const SurfaceMesh& mesh, std::int32_t halfedge)
      : h(halfedge),
        g(mesh.twin[at(h)]),
        a(mesh.origin[at(h)]),
        b(mesh.origin[at(g)]),
        c(mesh.origin[at(Halfedges::previous(h))]),
        d(mesh.origin[at(Halfedges::previous(g))]) {
    const auto p = [&](std::int32_t v) -> const Vec<3>& { return mesh.position[at(v)]; };
    before = {Triangle{p(a), p(b), p(c)}, Triangle{p(b), p(a), p(d)}};
    after = {Triangle{p(d), p(c), p(a)}, Triangle{p(c), p(d), p(b)}};
  }
};

bool has_edge(const SurfaceMesh& mesh, std::int32_t v, std::int32_t other) {
  bool has = false;
  for_each_out(mesh, v, [&](std::int32_t h) {
    has = has || mesh.destination(h) == other || mesh.origin[at(Halfedges::previous(h))] == other;
  });
  return has;
}

// Edges with normals more than 90 degrees apart: that between the two triangles, and those with their neighbours.
int count_turned(const SurfaceMesh& mesh, const std::array<Triangle, 2>& two,
                 const std::array<std::int32_t, 4>& sides) {
  const std::array normals{normal_of(two[0]), normal_of(two[1])};
  int n = dot(normals[0], normals[1]) < 0 ? 1 : 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::int32_t beyond = mesh.twin[at(sides[i])];
    if (beyond == kNone) continue;
    const auto p = [&](std::int32_t h) -> const Vec<3>& { return mesh.position[at(mesh.origin[at(h)])]; };
    const Vec<3> other = normal_of({p(beyond), p(Halfedges::next(beyond)), p(Halfedges::previous(beyond))});
    n += dot(normals[i / 2], other) < 0 ? 1 : 0;
  }
  return n;
}

// As seen along the mean normal of its triangles.
bool is_convex(const Quadrilateral& q) {
  const Vec<3> n0 = normal_of(q.before[0]);
  const Vec<3> n1 = normal_of(q.before[1]);
  return std::all_of(q.after.begin(), q.after.end(), [&](const Triangle& t) {
    const Vec<3> n = normal_of(t);
    return dot(n, n0) + dot(n, n1) > 0;
  });
}

bool keeps_shape(const SurfaceMesh& mesh, const Quadrilateral& q) {
  const double thinnest = std::min(thickness(q.after[0]), thickness(q.after[1]));
  if (!(thinnest > std::min(kThin, 0.5 * std::min(thickness(q.before[0]), thickness(q.before[1]))))) return false;
  const std::int32_t bc = Halfedges::next(q.h);
  const std::int32_t ca = Halfedges::previous(q.h);
  const std::int32_t ad = Halfedges::next(q.g);
  const std::int32_t db = Halfedges::previous(q.g);
  return count_turned(mesh, q.after, {ca, ad, db, bc}) <= count_turned(mesh, q.before, {bc, ca, ad, db});
}

double power(double squared) { return squared * std::sqrt(std::sqrt(squared)); }

// Of the place in the triangle that is about the nearest: below p, or on the side that p is beyond.
Vec<3> shares_of(const Vec<3>& p, const Triangle& t) {
  const Vec<3> normal = normal_of(t);
  const double squared = squared_length(normal);
  if (!(squared > 0)) return {1, 0, 0};
  const Vec<3> d = p - t[0];
  Vec<3> share{0, dot(cross(d, t[2] - t[0]), normal) / squared, dot(cross(t[1] - t[0], d), normal) / squared};
  share[0] = 1 - share[1] - share[2];
  for (double& x : share) x = std::max(0.0, x);
  const double sum = share[0] + share[1] + share[2];
  for (double& x : share) x /= sum;
  return share;
}

// Two triangles, with the wedges of their corners.
struct Pair {
  const std::array<Triangle, 2>& triangle;
  std::array<std::array<std::int32_t, 3>, 2> wedge;
};

double error_in(const SurfaceSamples& samples, std::uint32_t i, double squared, const Pair& pair, std::size_t t) {
  double error = power(squared);
  if (samples.value_error)
    error += samples.value_error(i, {pair.wedge[t], shares_of(samples.place[i], pair.triangle[t])});
  return samples.weight[i] * error;
}

bool is_nearer(const SurfaceMesh& mesh, const SurfaceSamples& samples, const ByTriangle& by_triangle,
               const Quadrilateral& q) {
  const auto wedge = [&](std::int32_t h) { return mesh.wedge[at(h)]; };
  const std::int32_t a = wedge(q.h);
  const std::int32_t b = wedge(q.g);
  const std::int32_t c = wedge(Halfedges::previous(q.h));
  const std::int32_t d = wedge(Halfedges::previous(q.g));
  const Pair pair_before{q.before, {{{a, b, c}, {b, a, d}}}};
  const Pair pair_after{q.after, {{{d, c, a}, {c, d, b}}}};
  double before = 0;
  for (const std::int32_t h : {q.h, q.g}) {
    for (const std::uint32_t i : by_triangle.of(h))
      before += error_in(samples, i, samples.squared[i], pair_before, h == q.h ? 0 : 1);
  }
  double after = 0;
  for (const std::int32_t h : {q.h, q.g}) {
    for (const std::uint32_t i : by_triangle.of(h)) {
      const std::array squared{squared_distance(samples.place[i], q.after[0]),
                               squared_distance(samples.place[i], q.after[1])};
      const std::size_t t = squared[0] < squared[1] ? 0 : 1;
      after += error_in(samples, i, squared[t], pair_after, t);
      if (!(after < kWorthwhile * before)) return false;
    }
  }
  return after < kWorthwhile * before;
}

// Samples know where the input is, not where the surface goes.
bool goes_astray(const Quadrilateral& q, const IsAstray& is_astray) {
  const auto middle = [](std::span<const Vec<3>> points) {
    Vec<3> mean{};
    for (const Vec<3>& p : points) {
      for (std::size_t i = 0; i < 3; ++i) mean[i] += p[i] / static_cast<double>(points.size());
    }
    return mean;
  };
  const std::span<const Vec<3>> dc(q.after[0].data(), 2);
  return is_astray(middle(dc), {}, q.c) || is_astray(middle(q.after[0]), normal_of(q.after[0]), q.a) ||
         is_astray(middle(q.after[1]), normal_of(q.after[1]), q.b);
}

// With the wedges of its corners and the marks of its sides.
void flip(SurfaceMesh& mesh, const Quadrilateral& q) {
  const std::int32_t h_next = Halfedges::next(q.h);
  const std::int32_t h_previous = Halfedges::previous(q.h);
  const std::int32_t g_next = Halfedges::next(q.g);
  const std::int32_t g_previous = Halfedges::previous(q.g);
  const std::int32_t wedge_a = mesh.wedge[at(q.h)];
  const std::int32_t wedge_b = mesh.wedge[at(q.g)];
  const std::int32_t wedge_c = mesh.wedge[at(h_previous)];
  const std::int32_t wedge_d = mesh.wedge[at(g_previous)];
  const std::uint8_t bc = mesh.is_feature[at(h_next)];
  const std::uint8_t ca = mesh.is_feature[at(h_previous)];
  const std::uint8_t ad = mesh.is_feature[at(g_next)];
  const std::uint8_t db = mesh.is_feature[at(g_previous)];
  flip_edge(mesh, q.h);
  mesh.wedge[at(q.h)] = wedge_d;
  mesh.wedge[at(h_next)] = wedge_c;
  mesh.wedge[at(h_previous)] = wedge_a;
  mesh.wedge[at(q.g)] = wedge_c;
  mesh.wedge[at(g_next)] = wedge_d;
  mesh.wedge[at(g_previous)] = wedge_b;
  mesh.is_feature[at(h_next)] = ca;
  mesh.is_feature[at(h_previous)] = ad;
  mesh.is_feature[at(g_next)] = db;
  mesh.is_feature[at(g_previous)] = bc;
}

}  // namespace

void flip_nearer(SurfaceMesh& mesh, const SurfaceSamples& samples, const IsAstray& is_astray) {
  const ByTriangle by_triangle(samples.triangle, mesh.origin.size() / 3);
  std::vector<std::uint8_t> is_flipped(mesh.origin.size() / 3, 0);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[at(h)] == kNone || h < mesh.twin[at(h)] || mesh.is_border_edge(h) || mesh.is_feature[at(h)])
      continue;
    const Quadrilateral q(mesh, h);
    if (is_flipped[at(h / 3)] || is_flipped[at(q.g / 3)] || is_seam(mesh, h)) continue;
    if (!is_convex(q) || !is_nearer(mesh, samples, by_triangle, q) || !keeps_shape(mesh, q)) continue;
    if (q.c == q.d || has_edge(mesh, q.c, q.d) || goes_astray(q, is_astray)) continue;
    flip(mesh, q);
    is_flipped[at(h / 3)] = is_flipped[at(q.g / 3)] = 1;
  }
}

}  // namespace tinsmith
