#include "triangulate/select.hpp"

#include <bit>
#include <cmath>
#include <cstdlib>

#include "geometry/triangle_rows.hpp"

namespace tinsmith {

namespace {

// Positions in samples. The hypotenuse runs from b to c, the right angle is at a.
struct RightTriangle {
  LatticePoint a, b, c;
};

LatticePoint scaled(LatticePoint p) { return {p.x * kLatticePerCell, p.y * kLatticePerCell}; }

class Hierarchy {
 public:
  Hierarchy(const HeightGrid& samples, double tolerance, Selection& selection)
      : samples_(samples), tolerance_(tolerance), selection_(selection) {}

  void refine(const RightTriangle& t) {
    if (!touches_window(t)) return;
    const bool is_half_cell = std::abs(t.b.x - t.c.x) == 1;
    if (is_half_cell) return end(t);
    const Fit fit = fit_of(t);
    if (fit == Fit::kFlat) return end(t);
    const LatticePoint m{(t.b.x + t.c.x) / 2, (t.b.y + t.c.y) / 2};
    if (fit == Fit::kRough) mark(m);
    refine({m, t.a, t.b});
    refine({m, t.c, t.a});
  }

  const Leaves& leaves() const { return leaves_; }

 private:
  void end(const RightTriangle& t) {
    if (!is_inside(t.a) || !is_inside(t.b) || !is_inside(t.c) || !samples_.is_valid(t.a.x, t.a.y)) return;
    ++leaves_.n;
    leaves_.sum_of_log2_areas += std::bit_width(static_cast<std::uint64_t>(std::abs(orient(t.a, t.b, t.c)))) - 2;
  }

  bool touches_window(const RightTriangle& t) const {
    const GridRect& w = selection_.window;
    return std::min({t.a.x, t.b.x, t.c.x}) < w.x0 + w.width && std::max({t.a.x, t.b.x, t.c.x}) >= w.x0 &&
           std::min({t.a.y, t.b.y, t.c.y}) < w.y0 + w.height && std::max({t.a.y, t.b.y, t.c.y}) >= w.y0;
  }

  bool is_inside(LatticePoint p) const {
    const GridRect& w = selection_.window;
    return p.x >= w.x0 && p.y >= w.y0 && p.x < w.x0 + w.width && p.y < w.y0 + w.height;
  }

  void mark(LatticePoint p) {
    if (is_inside(p) && samples_.is_valid(p.x, p.y)) selection_.at(p.x, p.y) = 1;
  }

  enum class Fit {
    kFlat,  // all samples under it are void, or all are valid and near its plane
    kRough,
    kUnknown,  // a corner sticks out of the window, which is not always a power of two
  };

  Fit fit_of(const RightTriangle& t) const {
    if (!is_inside(t.a) || !is_inside(t.b) || !is_inside(t.c)) return Fit::kUnknown;
    const double za = samples_.at(t.a.x, t.a.y);
    const bool is_void = std::isnan(za);
    const bool mirrored = orient(t.a, t.b, t.c) < 0;
    const LatticePoint b = mirrored ? t.c : t.b;
    const LatticePoint c = mirrored ? t.b : t.c;
    const Plane plane =
        plane_through({scaled(t.a), za}, {scaled(b), samples_.at(b.x, b.y)}, {scaled(c), samples_.at(c.x, c.y)});
    const TriangleRows rows(scaled(t.a), scaled(b), scaled(c));
    for (std::int32_t y = rows.first_row; y <= rows.last_row; ++y) {
      const auto [first, last] = rows.columns(y);
      if (!(is_void ? is_row_void(y, first, last) : is_row_near(plane, y, first, last))) return Fit::kRough;
    }
    return Fit::kFlat;
  }

  const double* row(std::int32_t y, std::int32_t first) const {
    const GridRect& r = samples_.rect;
    return samples_.z.data() + (static_cast<std::int64_t>(y - r.y0) * r.width + (first - r.x0));
  }

  bool is_row_void(std::int32_t y, std::int32_t first, std::int32_t last) const {
    const double* z = row(y, first);
    for (std::int32_t i = 0; i <= last - first; ++i) {
      if (!std::isnan(z[i])) return false;
    }
    return true;
  }

  bool is_row_near(const Plane& plane, std::int32_t y, std::int32_t first, std::int32_t last) const {
    const double* z = row(y, first);
    const double start = plane.at(first, y);
    for (std::int32_t i = 0; i <= last - first; ++i) {
      if (!(std::abs(z[i] - (start + i * plane.dx)) <= tolerance_)) return false;  // NaN is not near
    }
    return true;
  }

  const HeightGrid& samples_;
  double tolerance_;
  Selection& selection_;
  Leaves leaves_;
};

}  // namespace

Leaves select_samples(const HeightGrid& samples, double tolerance, Selection& selection) {
  const GridRect& w = selection.window;
  Hierarchy hierarchy(samples, tolerance, selection);
  // Squares of the window's shorter side in a row, so that a strip does not start from one huge square.
  std::int32_t square = 1;
  while (square * 2 <= std::min(w.width, w.height) - 1) square *= 2;
  for (std::int32_t y = w.y0; y < w.y0 + w.height - 1; y += square) {
    for (std::int32_t x = w.x0; x < w.x0 + w.width - 1; x += square) {
      const LatticePoint p00{x, y};
      const LatticePoint p10{x + square, y};
      const LatticePoint p01{x, y + square};
      const LatticePoint p11{x + square, y + square};
      hierarchy.refine({p10, p00, p11});
      hierarchy.refine({p01, p11, p00});
    }
  }
  return hierarchy.leaves();
}

void select_on_line(const HeightGrid& samples, double tolerance, LatticePoint a, LatticePoint b,
                    Selection& selection) {
  selection.at(a.x, a.y) = 1;
  selection.at(b.x, b.y) = 1;
  const std::int32_t n = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y));
  const std::int32_t step_x = (b.x > a.x) - (b.x < a.x);
  const std::int32_t step_y = (b.y > a.y) - (b.y < a.y);
  const double za = samples.at(a.x, a.y);
  const double zb = samples.at(b.x, b.y);
  double worst = tolerance;
  std::int32_t worst_i = 0;
  for (std::int32_t i = 1; i < n; ++i) {
    const double chord = za + (zb - za) * i / n;
    const double error = std::abs(samples.at(a.x + i * step_x, a.y + i * step_y) - chord);
    if (error > worst) {
      worst = error;
      worst_i = i;
    }
  }
  if (worst_i == 0) return;
  const LatticePoint m{a.x + worst_i * step_x, a.y + worst_i * step_y};
  select_on_line(samples, tolerance, a, m, selection);
  select_on_line(samples, tolerance, m, b, selection);
}

}  // namespace tinsmith
