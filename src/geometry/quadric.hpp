#pragma once
// Quadrics in N dimensions: sums of squared distances from planes, stored as (N + 1)(N + 2) / 2 coefficients (the
// paper's tables 1 and 2). Planes: the paper's eq. 1-5 (Garland and Heckbert 1997); triangles in more than three
// dimensions: Garland and Heckbert 1998.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace tinsmith {

template <std::size_t N>
using Vec = std::array<double, N>;

template <std::size_t N>
Vec<N> operator-(const Vec<N>& a, const Vec<N>& b) {
  Vec<N> result;
  for (std::size_t i = 0; i < N; ++i) result[i] = a[i] - b[i];
  return result;
}
template <std::size_t N>
double dot(const Vec<N>& a, const Vec<N>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += a[i] * b[i];
  return sum;
}
inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Q(v) = v^T A v + 2 b^T v + c.
template <std::size_t N>
struct Quadric {
  static constexpr std::size_t kCoefficients = (N + 1) * (N + 2) / 2;
  std::array<double, kCoefficients> q{};  // A row by row from the diagonal on, then b, then c

  static constexpr std::size_t a(std::size_t i, std::size_t j) {
    const std::size_t row = i < j ? i : j;
    const std::size_t column = i < j ? j : i;
    return row * N - row * (row + 1) / 2 + column;
  }
  static constexpr std::size_t b(std::size_t i) { return N * (N + 1) / 2 + i; }
  static constexpr std::size_t c() { return kCoefficients - 1; }

  Quadric& operator+=(const Quadric& other) {
    for (std::size_t i = 0; i < kCoefficients; ++i) q[i] += other.q[i];
    return *this;
  }

  /// Of A: the sum of the weights of all planes.
  double trace() const {
    double sum = 0;
    for (std::size_t i = 0; i < N; ++i) sum += q[a(i, i)];
    return sum;
  }

  double at(const Vec<N>& v) const {
    double value = q[c()];
    for (std::size_t i = 0; i < N; ++i) {
      double row = 2 * q[b(i)] + q[a(i, i)] * v[i];
      for (std::size_t j = i + 1; j < N; ++j) row += 2 * q[a(i, j)] * v[j];
      value += row * v[i];
    }
    return value;
  }

  /// Adds weight x (squared distance from the hyperplane through p with the unit normal n).
  void add_plane(const Vec<N>& n, const Vec<N>& p, double weight) {
    const double d = -dot(n, p);
    for (std::size_t i = 0; i < N; ++i) {
      for (std::size_t j = i; j < N; ++j) q[a(i, j)] += weight * n[i] * n[j];
      q[b(i)] += weight * d * n[i];
    }
    q[c()] += weight * d * d;
  }

  /// Adds weight x (squared distance from p).
  void add_point(const Vec<N>& p, double weight) {
    for (std::size_t i = 0; i < N; ++i) {
      q[a(i, i)] += weight;
      q[b(i)] -= weight * p[i];
    }
    q[c()] += weight * dot(p, p);
  }

  /// Adds weight x (squared distance from the flat through p that is spanned by the orthonormal e1 and e2; either
  /// may be zero, then it is a line or a point).
  void add_flat(const Vec<N>& p, const Vec<N>& e1, const Vec<N>& e2, double weight) {
    add_point(p, weight);
    for (const Vec<N>& e : {e1, e2}) {
      const double along = dot(p, e);
      for (std::size_t i = 0; i < N; ++i) {
        for (std::size_t j = i; j < N; ++j) q[a(i, j)] -= weight * e[i] * e[j];
        q[b(i)] += weight * along * e[i];
      }
      q[c()] -= weight * along * along;
    }
  }
};

/// Orthonormal directions of the plane through three points: both zero where the points are one place, the second
/// where they lie on a line (differences shorter than `tiny`).
template <std::size_t N>
std::array<Vec<N>, 2> directions_of(const Vec<N>& p, const Vec<N>& q, const Vec<N>& r, double tiny) {
  const auto scaled = [](Vec<N> v, double factor) {
    for (double& x : v) x *= factor;
    return v;
  };
  Vec<N> longest = q - p;
  Vec<N> other = r - p;
  if (dot(other, other) > dot(longest, longest)) std::swap(longest, other);
  const double length = std::sqrt(dot(longest, longest));
  if (!(length > tiny)) return {};
  const Vec<N> e1 = scaled(longest, 1 / length);
  const Vec<N> across = other - scaled(e1, dot(other, e1));
  const double width = std::sqrt(dot(across, across));
  if (!(width > tiny)) return {e1, {}};
  return {e1, scaled(across, 1 / width)};
}

/// Solves the symmetric system A x = r of a quadric's upper left part by Gauss elimination with pivots. False when
/// A is nearly singular: a pivot below `relative` of its largest entry, whatever the scale.
template <std::size_t N>
bool solve(const Quadric<N>& quadric, const Vec<N>& r, double relative, Vec<N>& x) {
  std::array<Vec<N + 1>, N> rows;
  double largest = 0;
  for (std::size_t i = 0; i < N; ++i) {
    for (std::size_t j = 0; j < N; ++j) {
      rows[i][j] = quadric.q[Quadric<N>::a(i, j)];
      largest = std::max(largest, std::abs(rows[i][j]));
    }
    rows[i][N] = r[i];
  }
  Vec<N> inverse;  // of the pivots: divisions are slow
  for (std::size_t k = 0; k < N; ++k) {
    std::size_t pivot = k;
    for (std::size_t i = k + 1; i < N; ++i) {
      if (std::abs(rows[i][k]) > std::abs(rows[pivot][k])) pivot = i;
    }
    if (!(std::abs(rows[pivot][k]) > relative * largest)) return false;
    if (pivot != k) std::swap(rows[k], rows[pivot]);
    inverse[k] = 1 / rows[k][k];
    for (std::size_t i = k + 1; i < N; ++i) {
      const double factor = rows[i][k] * inverse[k];
      for (std::size_t j = k + 1; j <= N; ++j) rows[i][j] -= factor * rows[k][j];
    }
  }
  for (std::size_t k = N; k-- > 0;) {
    double sum = rows[k][N];
    for (std::size_t j = k + 1; j < N; ++j) sum -= rows[k][j] * x[j];
    x[k] = sum * inverse[k];
  }
  return true;
}

/// The minimum of a quadric, eq. 6-10: A v = -b. False when A is nearly singular, see solve.
template <std::size_t N>
bool minimum(const Quadric<N>& quadric, Vec<N>& v, double relative = 1e-3) {
  Vec<N> r;
  for (std::size_t i = 0; i < N; ++i) r[i] = -quadric.q[Quadric<N>::b(i)];
  return solve(quadric, r, relative, v);
}

/// a at 0, b at 1.
template <std::size_t N>
Vec<N> along(const Vec<N>& a, const Vec<N>& b, double t) {
  Vec<N> p;
  for (std::size_t i = 0; i < N; ++i) p[i] = a[i] + t * (b[i] - a[i]);
  return p;
}

/// The minimum of a quadric on the segment from a to b, where it is a parabola; the middle where it is flat.
template <std::size_t N>
Vec<N> minimum_between(const Quadric<N>& quadric, const Vec<N>& a, const Vec<N>& b) {
  const double at_a = quadric.at(a);
  const double at_b = quadric.at(b);
  const double middle = quadric.at(along(a, b, 0.5));
  const double curvature = 2 * (at_a + at_b - 2 * middle);
  const double t =
      curvature > 0 ? std::fmin(std::fmax((3 * at_a + at_b - 4 * middle) / (2 * curvature), 0.0), 1.0) : 0.5;
  return along(a, b, t);
}

}  // namespace tinsmith
