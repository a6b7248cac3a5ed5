#pragma once
// The samples under a triangle, row by row.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "geometry/lattice.hpp"

namespace tinsmith {

/// floor and ceil of a lattice coordinate in cells.
inline std::int32_t floor_cell(std::int32_t v) { return v >> 4; }
inline std::int32_t ceil_cell(std::int32_t v) { return (v + (kLatticePerCell - 1)) >> 4; }
static_assert(kLatticePerCell == 16);

/// One side of a triangle as a bound on x in each row: x = x0 + slope * (row - y0), in cells.
struct RowBound {
  double x0 = 0;
  double y0 = 0;
  double slope = 0;
  double at(double row) const { return x0 + slope * (row - y0); }
};

/// The bounds of a counter-clockwise triangle: at most two on a side.
struct TriangleRows {
  std::int32_t first_row = 0;
  std::int32_t last_row = 0;
  std::array<RowBound, 2> left;
  std::array<RowBound, 2> right;

  TriangleRows(LatticePoint a, LatticePoint b, LatticePoint c) {
    first_row = ceil_cell(std::min({a.y, b.y, c.y}));
    last_row = floor_cell(std::max({a.y, b.y, c.y}));
    if (first_row > last_row) return;
    int n_left = 0;
    int n_right = 0;
    add(a, b, n_left, n_right);
    add(b, c, n_left, n_right);
    add(c, a, n_left, n_right);
    if (n_left == 1) left[1] = left[0];
    if (n_right == 1) right[1] = right[0];
  }

  /// The samples [first, last] of a row that lie in or on the triangle; none when first > last. A sample is at
  /// least 1 / (16 * side) cells away from a side that it is not on, so a slack of 1e-7 lets none in by error.
  std::array<std::int32_t, 2> columns(std::int32_t row) const {
    constexpr double kSlack = 1e-7;
    const double lo = std::max(left[0].at(row), left[1].at(row));
    const double hi = std::min(right[0].at(row), right[1].at(row));
    return {-round_down(kSlack - lo), round_down(hi + kSlack)};
  }

 private:
  // std::floor is a function call where the instruction set has no rounding.
  static std::int32_t round_down(double v) {
    const auto cut = static_cast<std::int32_t>(v);
    return cut - (cut > v ? 1 : 0);
  }

  // In (x, y) with counter-clockwise triangles a side that runs towards smaller y bounds x from below.
  void add(LatticePoint u, LatticePoint v, int& n_left, int& n_right) {
    const std::int32_t dy = v.y - u.y;
    if (dy == 0) return;
    constexpr double kCell = 1.0 / kLatticePerCell;
    const RowBound bound{u.x * kCell, u.y * kCell, static_cast<double>(v.x - u.x) / dy};
    if (dy < 0) {
      left[static_cast<std::size_t>(n_left++)] = bound;
    } else {
      right[static_cast<std::size_t>(n_right++)] = bound;
    }
  }
};

/// A point of a surface: plan position and height.
struct Corner {
  LatticePoint position;
  double height = 0;
};

/// A height as an affine function of the plan position, in cells: z = z0 + dx * (x - x0) + dy * (y - y0).
struct Plane {
  double x0 = 0;
  double y0 = 0;
  double z0 = 0;
  double dx = 0;
  double dy = 0;
  double at(double x, double y) const { return z0 + dx * (x - x0) + dy * (y - y0); }
};

/// The plane through three points that are not in line in plan.
inline Plane plane_through(const Corner& a, const Corner& b, const Corner& c) {
  constexpr double kCell = 1.0 / kLatticePerCell;
  const double bx = (b.position.x - a.position.x) * kCell;
  const double by = (b.position.y - a.position.y) * kCell;
  const double cx = (c.position.x - a.position.x) * kCell;
  const double cy = (c.position.y - a.position.y) * kCell;
  const double bz = b.height - a.height;
  const double cz = c.height - a.height;
  const double inverse = 1 / (bx * cy - by * cx);
  return {a.position.x * kCell, a.position.y * kCell, a.height, (bz * cy - cz * by) * inverse,
          (cz * bx - bz * cx) * inverse};
}

}  // namespace tinsmith
