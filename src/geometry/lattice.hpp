#pragma once
// The plan coordinates of all vertices: integers, so that every test of orientation is exact.
//
// The grid frame: sample (column i, row j) lies at x = i, y = j, in cells. A lattice point is a position in
// sixteenths of a cell. Triangles are counter-clockwise when orient() > 0 in (x, y); since rows usually
// grow southwards the writers turn the winding over where the georeference mirrors the grid.

#include <compare>
#include <cstdint>

namespace tinsmith {

inline constexpr int kLatticePerCell = 16;

struct LatticePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;

  friend bool operator==(LatticePoint, LatticePoint) = default;
  /// Row by row: y first.
  friend std::strong_ordering operator<=>(LatticePoint a, LatticePoint b) {
    return a.y != b.y ? a.y <=> b.y : a.x <=> b.x;
  }
};

/// Twice the signed area of (a, b, c) in lattice units: > 0 when counter-clockwise. Exact.
inline std::int64_t orient(LatticePoint a, LatticePoint b, LatticePoint c) {
  const std::int64_t abx = static_cast<std::int64_t>(b.x) - a.x;
  const std::int64_t aby = static_cast<std::int64_t>(b.y) - a.y;
  const std::int64_t acx = static_cast<std::int64_t>(c.x) - a.x;
  const std::int64_t acy = static_cast<std::int64_t>(c.y) - a.y;
  return abx * acy - aby * acx;
}

inline bool is_sample_position(LatticePoint p) { return p.x % kLatticePerCell == 0 && p.y % kLatticePerCell == 0; }

}  // namespace tinsmith
