#include "render/plan_tin.hpp"

#include <algorithm>
#include <cmath>

namespace tinsmith {
namespace {

// Bins hold about so many triangles each: few enough to find, enough to be worth a list.
constexpr double kTrianglesPerBin = 64;
constexpr double kMostBinsAlongSide = 4096;

// Positions that a triangle's side misses by less than this, in cells, are taken to be on it.
constexpr double kSlack = 1e-6;

struct Box {
  double x0, y0, x1, y1;
};

struct BinRange {
  int x0, y0, x1, y1;  // inclusive
};

Box box_of(const PlanTin& tin, const std::array<std::uint32_t, 3>& triangle) {
  const auto& a = tin.vertices[triangle[0]];
  const auto& b = tin.vertices[triangle[1]];
  const auto& c = tin.vertices[triangle[2]];
  return {std::min({a[0], b[0], c[0]}), std::min({a[1], b[1], c[1]}), std::max({a[0], b[0], c[0]}),
          std::max({a[1], b[1], c[1]})};
}

BinRange bins_of(const PlanTin& tin, const Box& box) {
  const auto bin = [&](double at, double origin, int count) {
    return static_cast<int>(std::clamp(std::floor((at - origin) / tin.bin_side), 0.0, count - 1.0));
  };
  return {bin(box.x0, tin.origin[0], tin.n_columns), bin(box.y0, tin.origin[1], tin.n_rows),
          bin(box.x1, tin.origin[0], tin.n_columns), bin(box.y1, tin.origin[1], tin.n_rows)};
}

template <class Visit>
void for_each_bin(const PlanTin& tin, const BinRange& range, const Visit& visit) {
  for (int y = range.y0; y <= range.y1; ++y)
    for (int x = range.x0; x <= range.x1; ++x) visit(static_cast<std::size_t>(y) * tin.n_columns + x);
}

void lay_out_bins(PlanTin& tin) {
  Box all{0, 0, 0, 0};
  if (!tin.vertices.empty()) all = {tin.vertices[0][0], tin.vertices[0][1], tin.vertices[0][0], tin.vertices[0][1]};
  for (const auto& v : tin.vertices)
    all = {std::min(all.x0, v[0]), std::min(all.y0, v[1]), std::max(all.x1, v[0]), std::max(all.y1, v[1])};
  const double width = std::max(all.x1 - all.x0, 1.0);
  const double height = std::max(all.y1 - all.y0, 1.0);
  const double n_triangles = std::max<double>(1, static_cast<double>(tin.triangles.size()));
  tin.origin = {all.x0, all.y0};
  tin.bin_side = std::max(std::sqrt(width * height * kTrianglesPerBin / n_triangles),
                          std::max(width, height) / kMostBinsAlongSide);
  tin.n_columns = static_cast<int>(width / tin.bin_side) + 1;
  tin.n_rows = static_cast<int>(height / tin.bin_side) + 1;
}

// Counts, then fills: the triangles of a bin keep their order.
void fill_bins(PlanTin& tin) {
  tin.first.assign(static_cast<std::size_t>(tin.n_columns) * tin.n_rows + 1, 0);
  for (const auto& triangle : tin.triangles)
    for_each_bin(tin, bins_of(tin, box_of(tin, triangle)), [&](std::size_t bin) { ++tin.first[bin + 1]; });
  for (std::size_t bin = 1; bin < tin.first.size(); ++bin) tin.first[bin] += tin.first[bin - 1];
  tin.binned.resize(tin.first.back());
  std::vector<std::size_t> next(tin.first.begin(), tin.first.end() - 1);
  for (std::uint32_t t = 0; t < tin.triangles.size(); ++t)
    for_each_bin(tin, bins_of(tin, box_of(tin, tin.triangles[t])),
                 [&](std::size_t bin) { tin.binned[next[bin]++] = t; });
}

// The part of a triangle on one row: from (x0, z0) to (x1, z1).
struct Span {
  double x0 = std::numeric_limits<double>::infinity();
  double z0 = 0;
  double x1 = -std::numeric_limits<double>::infinity();
  double z1 = 0;

  void add(double x, double z) {
    if (x < x0) x0 = x, z0 = z;
    if (x > x1) x1 = x, z1 = z;
  }
};

Span span_on_row(const PlanTin& tin, const std::array<std::uint32_t, 3>& triangle, double y) {
  Span span;
  for (int k = 0; k < 3; ++k) {
    const auto& a = tin.vertices[triangle[k]];
    const auto& b = tin.vertices[triangle[(k + 1) % 3]];
    if (std::min(a[1], b[1]) > y || std::max(a[1], b[1]) < y) continue;
    if (a[1] == b[1]) {
      span.add(a[0], a[2]);
      span.add(b[0], b[2]);
    } else {
      const double t = (y - a[1]) / (b[1] - a[1]);
      span.add(a[0] + t * (b[0] - a[0]), a[2] + t * (b[2] - a[2]));
    }
  }
  return span;
}

// The integers from `first` to `last`, a little beyond them included, that lie in [begin, begin + count).
std::array<std::int32_t, 2> positions_between(double first, double last, std::int32_t begin, std::int32_t count) {
  const double end = static_cast<double>(begin) + count;
  return {static_cast<std::int32_t>(std::clamp<double>(std::ceil(first - kSlack), begin, end)),
          static_cast<std::int32_t>(std::clamp<double>(std::floor(last + kSlack), begin - 1.0, end - 1))};
}

void fill_triangle(const PlanTin& tin, const std::array<std::uint32_t, 3>& triangle, HeightGrid& heights) {
  const GridRect& rect = heights.rect;
  const Box box = box_of(tin, triangle);
  const auto [first_row, last_row] = positions_between(box.y0, box.y1, rect.y0, rect.height);
  for (std::int32_t y = first_row; y <= last_row; ++y) {
    const Span span = span_on_row(tin, triangle, std::clamp<double>(y, box.y0, box.y1));
    const auto [first, last] = positions_between(span.x0, span.x1, rect.x0, rect.width);
    const double slope = span.x1 > span.x0 ? (span.z1 - span.z0) / (span.x1 - span.x0) : 0;
    double* const row = heights.z.data() + static_cast<std::size_t>(y - rect.y0) * rect.width;
    for (std::int32_t x = first; x <= last; ++x)
      row[x - rect.x0] = span.z0 + slope * (std::clamp<double>(x, span.x0, span.x1) - span.x0);
  }
}

}  // namespace

PlanTin make_plan_tin(const Tin& tin, const std::function<std::array<double, 2>(double x, double y)>& to_plan) {
  PlanTin plan;
  plan.triangles = tin.triangles;
  plan.vertices.reserve(tin.vertices.size());
  for (const auto& v : tin.vertices) {
    const auto [column, row] = to_plan(v[0], v[1]);
    plan.vertices.push_back({column, row, v[2]});
  }
  lay_out_bins(plan);
  fill_bins(plan);
  return plan;
}

HeightGrid heights_at(const PlanTin& tin, const GridRect& rect) {
  HeightGrid heights{rect, std::vector<double>(static_cast<std::size_t>(rect.area()), std::nan(""))};
  const Box box{rect.x0 - 1.0, rect.y0 - 1.0, static_cast<double>(rect.x0) + rect.width,
                static_cast<double>(rect.y0) + rect.height};
  for_each_bin(tin, bins_of(tin, box), [&](std::size_t bin) {
    for (std::size_t i = tin.first[bin]; i < tin.first[bin + 1]; ++i)
      fill_triangle(tin, tin.triangles[tin.binned[i]], heights);
  });
  return heights;
}

}  // namespace tinsmith
