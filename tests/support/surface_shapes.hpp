#pragma once
// Surfaces for tests: closed, open, creased, noisy and one-sided, with colours and normals. Each depends on its
// arguments only, and none has a vertex twice at a place.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "tinsmith/surface.hpp"

namespace tinsmith::test {

using Point3 = std::array<double, 3>;

inline Point3 minus(const Point3& a, const Point3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point3 plus(const Point3& a, const Point3& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point3 times(const Point3& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
inline double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point3 cross(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double norm(const Point3& a) { return std::sqrt(dot(a, a)); }

/// Normal of a triangle, as long as twice its area.
inline Point3 doubled_area_normal(const Surface& s, const std::array<std::uint32_t, 3>& t) {
  return cross(minus(s.position[t[1]], s.position[t[0]]), minus(s.position[t[2]], s.position[t[0]]));
}

/// In [0, 1), the same on every platform.
inline double unit_random(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

/// The cube [-1, 1]^3, each face n x n squares of two triangles, welded at its edges: 12 n n triangles.
inline Surface cube_with_creases(int n) {
  Surface s;
  std::map<std::array<int, 3>, std::uint32_t> number_of;
  const auto vertex = [&](const std::array<int, 3>& lattice) {
    const auto [it, is_new] = number_of.try_emplace(lattice, static_cast<std::uint32_t>(s.position.size()));
    const auto at = [&](std::size_t k) { return 2.0 * lattice[k] / n - 1; };
    if (is_new) s.position.push_back({at(0), at(1), at(2)});
    return it->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const int side : {0, n})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const auto corner = [&](int di, int dj) {
            std::array<int, 3> lattice{};
            lattice[axis] = side;
            // The other two axes in cyclic order look out of the upper side, swapped out of the lower one.
            lattice[(axis + (side > 0 ? 1 : 2)) % 3] = i + di;
            lattice[(axis + (side > 0 ? 2 : 1)) % 3] = j + dj;
            return vertex(lattice);
          };
          const std::uint32_t a = corner(0, 0), b = corner(1, 0), c = corner(1, 1), d = corner(0, 1);
          s.triangles.push_back({a, b, c});
          s.triangles.push_back({a, c, d});
        }
  return s;
}

/// The unit sphere: a cube with n x n squares on a face, blown up. 12 n n triangles.
inline Surface sphere(int n) {
  Surface s = cube_with_creases(n);
  for (Point3& p : s.position) {
    for (double& x : p) x = std::tan(x * std::numbers::pi / 4);  // squares of nearly the same size
    p = times(p, 1 / norm(p));
  }
  return s;
}

/// n sections around the axis (radius 1), m around the tube (radius 0.4): 2 n m triangles, genus 1.
inline Surface torus(int n, int m) {
  Surface s;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const double u = 2 * std::numbers::pi * i / n, v = 2 * std::numbers::pi * j / m;
      const double r = 1 + 0.4 * std::cos(v);
      s.position.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
    }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(i % n * m + j % m); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      s.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      s.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return s;
}

/// Waves over the unit square, n x n squares, seen from above; one border.
inline Surface open_sheet(int n, std::uint64_t seed = 1) {
  std::mt19937_64 generator(seed);
  std::array<std::array<double, 4>, 6> waves{};
  for (auto& [kx, ky, phase, height] : waves) {
    kx = 40 * (unit_random(generator) - 0.5);
    ky = 40 * (unit_random(generator) - 0.5);
    phase = 2 * std::numbers::pi * unit_random(generator);
    height = 0.05 * unit_random(generator);
  }
  Surface s;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      double z = 0;
      for (const auto& [kx, ky, phase, height] : waves) z += height * std::sin(kx * x + ky * y + phase);
      s.position.push_back({x, y, z});
    }
  const auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      s.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      s.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return s;
}

/// A closed blob of different widths with bumps of all sizes, and noise of a tenth of an edge along the ray from
/// the middle, so that it never cuts itself: 12 n n triangles, genus 0.
inline Surface scan(int n, std::uint64_t seed = 1) {
  Surface s = sphere(n);
  std::mt19937_64 generator(seed);
  const auto direction = [&] {
    const double z = 2 * unit_random(generator) - 1, turn = 2 * std::numbers::pi * unit_random(generator);
    const double r = std::sqrt(1 - z * z);
    return Point3{r * std::cos(turn), r * std::sin(turn), z};
  };
  struct Bump {
    Point3 at;
    double width, height;
  };
  std::vector<Bump> bumps(40);
  for (Bump& bump : bumps) {
    bump.at = direction();
    bump.width = 0.08 + 0.4 * unit_random(generator);
    bump.height = bump.width * (0.6 * unit_random(generator) - 0.2);
  }
  const double noise = 0.1 * std::numbers::pi / 2 / n;
  for (Point3& p : s.position) {
    double radius = 1 + noise * (2 * unit_random(generator) - 1);
    for (const Bump& bump : bumps) {
      const double away = norm(minus(p, bump.at)) / bump.width;
      radius += bump.height * std::exp(-away * away);
    }
    p = {radius * p[0], 0.7 * radius * p[1], 1.3 * radius * p[2]};
  }
  return s;
}

/// Moebius's strip, n squares long and two wide: 4 n triangles, one side and one border. They follow one
/// orientation but for the edges where the ends meet.
inline Surface moebius(int n) {
  constexpr int kWidth = 2;
  Surface s;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j <= kWidth; ++j) {
      const double turn = 2 * std::numbers::pi * i / n, across = 0.4 * (2.0 * j / kWidth - 1);
      const double r = 1 + across * std::cos(turn / 2);
      s.position.push_back({r * std::cos(turn), r * std::sin(turn), across * std::sin(turn / 2)});
    }
  const auto vertex = [&](int i, int j) {
    return static_cast<std::uint32_t>(i < n ? i * (kWidth + 1) + j : kWidth - j);
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < kWidth; ++j) {
      s.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      s.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return s;
}

/// Lowest and highest corner of the box around the positions.
inline std::pair<Point3, Point3> bounding_box(const Surface& s) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Point3& p : s.position)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], p[k]);
      high[k] = std::max(high[k], p[k]);
    }
  return {low, high};
}

/// From 0 to 1 along each axis of the bounding box; 0 along an axis without extent.
inline Point3 place_in_box(const std::pair<Point3, Point3>& box, const Point3& p) {
  Point3 place{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = box.second[k] - box.first[k];
    place[k] = extent > 0 ? (p[k] - box.first[k]) / extent : 0;
  }
  return place;
}

/// Red grows along x, green along y, blue along z.
inline Surface with_gradient_colour(Surface s) {
  const auto box = bounding_box(s);
  SurfaceAttribute colour{AttributeKind::kColour, {}, {}};
  for (const Point3& p : s.position)
    for (const double x : place_in_box(box, p)) colour.values.push_back(static_cast<float>(x));
  s.attributes.push_back(std::move(colour));
  return s;
}

/// Dice of two colours, k along each axis of the bounding box. The colour changes within an edge's length.
inline Surface with_checker_colour(Surface s, int k) {
  const auto box = bounding_box(s);
  SurfaceAttribute colour{AttributeKind::kColour, {}, {}};
  for (const Point3& p : s.position) {
    int parity = 0;
    for (const double x : place_in_box(box, p)) parity += std::min(static_cast<int>(x * k), k - 1);
    const bool is_dark = parity % 2 == 0;
    for (const float x : is_dark ? std::array{0.1F, 0.2F, 0.6F} : std::array{0.9F, 0.8F, 0.3F})
      colour.values.push_back(x);
  }
  s.attributes.push_back(std::move(colour));
  return s;
}

/// Unit normals at the vertices, averaged over their triangles by area; upwards where there is none.
inline Surface with_normals(Surface s) {
  std::vector<Point3> sum(s.position.size());
  for (const auto& t : s.triangles)
    for (const std::uint32_t v : t) sum[v] = plus(sum[v], doubled_area_normal(s, t));
  SurfaceAttribute normal{AttributeKind::kNormal, {}, {}};
  for (const Point3& n : sum)
    for (const double x : norm(n) > 0 ? times(n, 1 / norm(n)) : Point3{0, 0, 1})
      normal.values.push_back(static_cast<float>(x));
  s.attributes.push_back(std::move(normal));
  return s;
}

}  // namespace tinsmith::test
