#include "simplify/surface_star.hpp"

#include <algorithm>
#include <limits>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

const Vec<3>& point(const SurfaceMesh& mesh, std::int32_t h) { return mesh.position[at(mesh.origin[at(h)])]; }

Vec<3> normal_of(const SurfaceMesh& mesh, std::int32_t h) {
  return cross(point(mesh, Halfedges::next(h)) - point(mesh, h),
               point(mesh, Halfedges::previous(h)) - point(mesh, h));
}

bool is_turned(const Vec<3>& n, const Vec<3>& other) { return dot(n, other) < 0; }

// apex(side) is the third corner of its triangle.
template <class Apex>
int count_turned_with(const SurfaceStar& star, Apex apex) {
  const auto normal = [&](const LinkSide& side) { return cross(side.a - apex(side), side.b - apex(side)); };
  int n_turned = 0;
  for (std::size_t i = 0; i < star.sides.size(); ++i) {
    const LinkSide& side = star.sides[i];
    const LinkSide& next = star.sides[i + 1 < star.sides.size() ? i + 1 : 0];
    const Vec<3> n = normal(side);
    const bool is_spoke = side.b == next.a && apex(side) == apex(next);
    n_turned += is_spoke && is_turned(n, normal(next)) ? 1 : 0;
    n_turned += is_turned(n, star.beyond[i]) ? 1 : 0;
  }
  return n_turned;
}

double squared_distance_to_side(const Vec<3>& q, const Vec<3>& a, const Vec<3>& b) {
  const Vec<3> side = b - a;
  const Vec<3> d = q - a;
  const double length = dot(side, side);
  const double t = length > 0 ? std::clamp(dot(d, side) / length, 0.0, 1.0) : 0;
  const Vec<3> off{d[0] - t * side[0], d[1] - t * side[1], d[2] - t * side[2]};
  return dot(off, off);
}

double squared_distance_to_triangle(const Vec<3>& q, const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
  const Vec<3> n = cross(b - a, c - a);
  const Vec<3> d = q - a;
  const double squared = dot(n, n);
  const double share_b = dot(cross(d, c - a), n);
  const double share_c = dot(cross(b - a, d), n);
  if (squared > 0 && share_b >= 0 && share_c >= 0 && share_b + share_c <= squared) {
    const double height = dot(d, n);
    return height * height / squared;
  }
  return std::min(
      {squared_distance_to_side(q, a, b), squared_distance_to_side(q, b, c), squared_distance_to_side(q, c, a)});
}

double squared_distance_to_old(const Vec<3>& q, const SurfaceStar& star) {
  double least = std::numeric_limits<double>::infinity();
  for (const LinkSide& side : star.sides)
    least = std::min(least, squared_distance_to_triangle(q, side.before, side.a, side.b));
  for (const auto& [a, b, c] : star.gone) least = std::min(least, squared_distance_to_triangle(q, a, b, c));
  return least;
}

}  // namespace

void clear(SurfaceStar& star) {
  star.sides.clear();
  star.beyond.clear();
  star.gone.clear();
}

void add_side(const SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star) {
  const std::int32_t side = Halfedges::next(h);
  star.sides.push_back({point(mesh, side), point(mesh, Halfedges::previous(h)), point(mesh, h)});
  const std::int32_t g = mesh.twin[at(side)];
  star.beyond.push_back(g == kNone ? Vec<3>{} : normal_of(mesh, g));
}

int count_turned(const SurfaceStar& star) {
  return count_turned_with(star, [](const LinkSide& side) -> const Vec<3>& { return side.before; });
}

int count_turned(const SurfaceStar& star, const Vec<3>& p) {
  return count_turned_with(star, [&](const LinkSide&) -> const Vec<3>& { return p; });
}

bool turns_more(const SurfaceStar& star, const Vec<3>& p) {
  const int n_turned = count_turned(star, p);
  return n_turned > 0 && n_turned > count_turned(star);
}

void add_gone(const SurfaceMesh& mesh, std::int32_t h, SurfaceStar& star) {
  star.gone.push_back({point(mesh, h), point(mesh, Halfedges::next(h)), point(mesh, Halfedges::previous(h))});
}

double squared_distance(const Vec<3>& q, const std::array<Vec<3>, 3>& triangle) {
  return squared_distance_to_triangle(q, triangle[0], triangle[1], triangle[2]);
}

double squared_distance(const Vec<3>& q, const SurfaceStar& star, const Vec<3>& p, double enough) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < star.sides.size() && least > enough; ++i)
    least = std::min(least, squared_distance_to_triangle(q, p, star.sides[i].a, star.sides[i].b));
  return least;
}

double squared_distance_back(const SurfaceStar& star, const Vec<3>& p) {
  double farthest = 0;
  for (const LinkSide& side : star.sides) {
    Vec<3> spoke;
    Vec<3> middle;
    for (std::size_t i = 0; i < 3; ++i) {
      spoke[i] = (p[i] + side.a[i]) / 2;
      middle[i] = (p[i] + side.a[i] + side.b[i]) / 3;
    }
    farthest = std::max({farthest, squared_distance_to_old(spoke, star), squared_distance_to_old(middle, star)});
  }
  return farthest;
}

}  // namespace tinsmith
