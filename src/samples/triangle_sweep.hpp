#pragma once
// The samples in a triangle, four at a time: where selection and simplification spend most of their time.
//
// A sample s in the triangle (p, a, b) has the weights area(a, b, s), area(b, p, s) and area(p, a, s) over
// area(p, a, b). In lattice units relative to p these areas are integers below 2^53, so that as doubles they are
// exact, and whether s lies inside needs no slack. Four samples of a row are computed at once, and what lies
// outside is left out at the end. That is 2.5 times as fast as row bounds and one sample at a time, since most
// triangles have two or three samples in a row.
//
// Everything here is compiled into its caller, with the caller's instruction set.

#include <algorithm>
#include <array>
#include <cstdint>

#include "geometry/triangle_rows.hpp"
#include "samples/height_grid.hpp"
#include "samples/lanes.hpp"

namespace tinsmith {

// Heights of samples, row by row, with care at the very end of the array.
struct SampleRows {
  const double* z;
  std::int64_t n;
  GridRect rect;

  explicit SampleRows(const HeightGrid& samples)
      : z(samples.z.data()), n(static_cast<std::int64_t>(samples.z.size())), rect(samples.rect) {}

  std::int64_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::int64_t>(y - rect.y0) * rect.width + (x - rect.x0);
  }
  LatticePoint place(double index) const {
    const auto i = static_cast<std::int64_t>(index);
    return {rect.x0 + static_cast<std::int32_t>(i % rect.width),
            rect.y0 + static_cast<std::int32_t>(i / rect.width)};
  }
  template <class L>
  TINSMITH_INLINE L load(std::int64_t first) const {
    if (first + kLaneStep <= n) return L::load(z + first);
    std::array<double, kLanes> some{};
    std::copy(z + first, z + n, some.begin());
    return L::load(some.data());
  }
};

// A triangle (p, a, b) relative to p, in lattice units; heights relative to the reference.
struct SweptTriangle {
  double ax, ay, bx, by;
  double area;
  double inverse_area;
  double height_a, height_b;
  double rise_a, rise_b;  // height of the corner per unit of its area

  TINSMITH_INLINE SweptTriangle(LatticePoint p, const Corner& a, const Corner& b, double reference)
      : ax(a.position.x - p.x),
        ay(a.position.y - p.y),
        bx(b.position.x - p.x),
        by(b.position.y - p.y),
        area(ax * by - ay * bx),
        inverse_area(1 / area),
        height_a(a.height - reference),
        height_b(b.height - reference),
        rise_a(height_a * inverse_area),
        rise_b(height_b * inverse_area) {}
};

// Four samples in a row, in or near the triangle: the areas that they span with its sides, and where they are.
template <class L>
struct Four {
  L area_a;
  L area_b;
  std::int64_t index;  // of the first in the samples

  TINSMITH_INLINE Four(const SweptTriangle& t, LatticePoint p, std::int32_t x, std::int32_t y, std::int64_t first)
      : index(first) {
    const double dx = static_cast<double>(x) * kLatticePerCell - p.x;
    const double dy = static_cast<double>(y) * kLatticePerCell - p.y;
    area_a = L::all(t.by * dx - t.bx * dy) + L::all(t.by * kLatticePerCell) * columns();
    area_b = L::all(t.ax * dy - t.ay * dx) - L::all(t.ay * kLatticePerCell) * columns();
  }
  TINSMITH_INLINE static L columns() {
    static constexpr std::array<double, kLanes> kColumns{0, 1, 2, 3};
    return L::load(kColumns.data());
  }
  TINSMITH_INLINE L area_p(const SweptTriangle& t) const { return L::all(t.area) - area_a - area_b; }
  TINSMITH_INLINE L indices() const { return L::all(static_cast<double>(index)) + columns(); }
  // What a and b bear, the height at p being the reference.
  TINSMITH_INLINE L base(const SweptTriangle& t) const {
    return area_a * L::all(t.rise_a) + area_b * L::all(t.rise_b);
  }
};

// Calls add(triangle, four) for fours that together hold every sample in or on the triangle (p, a, b) once, and
// others. Heights are taken relative to that of the corner p.
template <class L, class F>
TINSMITH_INLINE void sweep_triangle(const SampleRows& samples, const Corner& corner_p, const Corner& corner_a,
                                    const Corner& corner_b, F& add) {
  const LatticePoint p = corner_p.position;
  const LatticePoint a = corner_a.position;
  const LatticePoint b = corner_b.position;
  const SweptTriangle t(p, corner_a, corner_b, corner_p.height);
  const std::int32_t first_row = ceil_cell(std::min({p.y, a.y, b.y}));
  const std::int32_t last_row = floor_cell(std::max({p.y, a.y, b.y}));
  const std::int32_t first = ceil_cell(std::min({p.x, a.x, b.x}));
  const std::int32_t last = floor_cell(std::max({p.x, a.x, b.x}));
  // Row bounds cost as much as a few samples more.
  if (last - first < 2 * kLaneStep) {
    for (std::int32_t x = first; x <= last; x += kLaneStep) {
      Four<L> four(t, p, x, first_row, samples.index(x, first_row));
      for (std::int32_t y = first_row; y <= last_row; ++y) {
        add(t, four);
        four.area_a = four.area_a - L::all(t.bx * kLatticePerCell);
        four.area_b = four.area_b + L::all(t.ax * kLatticePerCell);
        four.index += samples.rect.width;
      }
    }
    return;
  }
  const TriangleRows bounds(p, a, b);
  for (std::int32_t y = first_row; y <= last_row; ++y) {
    const auto [left, right] = bounds.columns(y);
    if (left > right) continue;
    Four<L> four(t, p, left, y, samples.index(left, y));
    for (std::int32_t x = left; x <= right; x += kLaneStep) {
      add(t, four);
      four.area_a = four.area_a + L::all(t.by * (kLatticePerCell * kLaneStep));
      four.area_b = four.area_b - L::all(t.ay * (kLatticePerCell * kLaneStep));
      four.index += kLaneStep;
    }
  }
}

}  // namespace tinsmith
