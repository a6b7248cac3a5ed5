// What can only be seen in plan: vertices that lie in an edge they don't belong to, and edges that lie on
// each other without being one.

#include <algorithm>
#include <cmath>
#include <tuple>

#include "judge/topology.hpp"

namespace tinsmith {
namespace {

struct Segment {
  PlanPoint from;
  PlanPoint to;
  const Facet* facet;  // that it is an edge of
};

struct BorderVertex {
  std::uint32_t number;
  PlanPoint position;
};

Segment segment_of(const Block& block, std::uint32_t corner) {
  const Facet& facet = block.facets[corner / 3];
  return {facet.position[corner % 3], facet.position[(corner + 1) % 3], &facet};
}

/// Those that the block owns.
std::vector<BorderVertex> border_vertices(const Block& block, const BorderEdges& border) {
  std::vector<BorderVertex> vertices;
  for (const std::uint32_t corner : border) {
    const Facet& facet = block.facets[corner / 3];
    for (const std::size_t k : {corner % 3, (corner + 1) % 3})
      if (block.owns(facet.position[k])) vertices.push_back({facet.vertices[k], facet.position[k]});
  }
  const auto is_less = [](const BorderVertex& v, const BorderVertex& w) { return v.number < w.number; };
  const auto is_same = [](const BorderVertex& v, const BorderVertex& w) { return v.number == w.number; };
  std::sort(vertices.begin(), vertices.end(), is_less);
  vertices.erase(std::unique(vertices.begin(), vertices.end(), is_same), vertices.end());
  return vertices;
}

/// Buckets of a regular grid over the vertices, about one for each vertex.
class Buckets {
 public:
  explicit Buckets(std::vector<BorderVertex> vertices);

  /// Visits all vertices near the segment, some of them that are not.
  template <class Visit>
  void for_each_near(const Segment& segment, Visit visit) const;

 private:
  std::size_t column_of(double x) const { return bucket(x - low_.x, n_columns_); }
  std::size_t row_of(double y) const { return bucket(y - low_.y, n_rows_); }
  std::size_t bucket(double offset, std::size_t n) const {
    return static_cast<std::size_t>(std::clamp(std::floor(offset / size_), 0.0, static_cast<double>(n - 1)));
  }

  PlanPoint low_;
  double size_ = 1;  // of a bucket, cells
  std::size_t n_columns_ = 1;
  std::size_t n_rows_ = 1;
  std::vector<std::size_t> start_;  // of each bucket, and the end
  std::vector<BorderVertex> vertices_;
};

Buckets::Buckets(std::vector<BorderVertex> vertices) : vertices_(std::move(vertices)) {
  if (vertices_.empty()) return;
  PlanPoint high = low_ = vertices_[0].position;
  for (const auto& [number, p] : vertices_) {
    low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const auto n = static_cast<double>(vertices_.size());
  const double width = high.x - low_.x;
  const double length = high.y - low_.y;
  // The second bound keeps the number of buckets down when all lie on a line.
  size_ = std::max({std::sqrt(width * length / n), std::max(width, length) / n, kPlanEpsilon});
  n_columns_ = static_cast<std::size_t>(width / size_) + 1;
  n_rows_ = static_cast<std::size_t>(length / size_) + 1;
  const auto bucket_of = [&](const BorderVertex& v) {
    return row_of(v.position.y) * n_columns_ + column_of(v.position.x);
  };
  std::sort(vertices_.begin(), vertices_.end(), [&](const BorderVertex& v, const BorderVertex& w) {
    return std::tuple(bucket_of(v), v.number) < std::tuple(bucket_of(w), w.number);
  });
  start_.assign(n_columns_ * n_rows_ + 1, 0);
  for (const BorderVertex& v : vertices_) ++start_[bucket_of(v) + 1];
  for (std::size_t i = 1; i < start_.size(); ++i) start_[i] += start_[i - 1];
}

template <class Visit>
void Buckets::for_each_near(const Segment& segment, Visit visit) const {
  auto [left, right] = std::tuple(segment.from, segment.to);
  if (left.x > right.x) std::swap(left, right);
  const double slope = right.x > left.x ? (right.y - left.y) / (right.x - left.x) : 0;
  // A vertex within the epsilon of the segment may lie in the bucket beside: hence the margins. They are wider
  // than the rounding of `slope` over the length of any segment.
  const double margin = kPlanEpsilon + size_ * 1e-3;
  const std::size_t last_column = column_of(right.x + margin);
  for (std::size_t column = column_of(left.x - margin); column <= last_column; ++column) {
    const double x0 = std::clamp(low_.x + static_cast<double>(column) * size_ - margin, left.x, right.x);
    const double x1 = std::clamp(low_.x + static_cast<double>(column + 1) * size_ + margin, left.x, right.x);
    double y0 = left.y + (x0 - left.x) * slope;
    double y1 = left.y + (x1 - left.x) * slope;
    if (right.x == left.x) std::tie(y0, y1) = std::tuple(left.y, right.y);
    if (y0 > y1) std::swap(y0, y1);
    const std::size_t last_row = row_of(y1 + margin);
    for (std::size_t row = row_of(y0 - margin); row <= last_row; ++row) {
      const std::size_t b = row * n_columns_ + column;
      for (std::size_t i = start_[b]; i < start_[b + 1]; ++i) visit(i, vertices_[i]);
    }
  }
}

bool is_inside(const PlanPoint& p, const Segment& s) {
  const double dx = s.to.x - s.from.x;
  const double dy = s.to.y - s.from.y;
  const double length = std::hypot(dx, dy);
  const double along = ((p.x - s.from.x) * dx + (p.y - s.from.y) * dy) / length;
  const double across = doubled_area(s.from, s.to, p) / length;
  return along > kPlanEpsilon && along < length - kPlanEpsilon && std::abs(across) <= kPlanEpsilon;
}

std::uint64_t count_t_junctions(const Block& block, const BorderEdges& border) {
  std::vector<BorderVertex> vertices = border_vertices(block, border);
  if (vertices.empty()) return 0;
  std::vector<bool> is_junction(vertices.size(), false);
  const Buckets buckets(std::move(vertices));
  for (const std::uint32_t corner : border) {
    const Segment segment = segment_of(block, corner);
    const auto& own = segment.facet->vertices;
    buckets.for_each_near(segment, [&](std::size_t i, const BorderVertex& v) {
      const bool is_own = std::find(own.begin(), own.end(), v.number) != own.end();
      if (!is_own && is_inside(v.position, segment)) is_junction[i] = true;
    });
  }
  return static_cast<std::uint64_t>(std::count(is_junction.begin(), is_junction.end(), true));
}

/// An edge belongs to the block of its end that comes first in plan, which its twins share.
std::uint64_t count_unwelded_edges(const Block& block, const BorderEdges& border) {
  using Place = std::array<double, 4>;
  std::vector<Place> places;
  for (const std::uint32_t corner : border) {
    auto [p, q, facet] = segment_of(block, corner);
    if (std::tie(q.x, q.y) < std::tie(p.x, p.y)) std::swap(p, q);
    if (block.owns(p)) places.push_back({p.x, p.y, q.x, q.y});
  }
  std::sort(places.begin(), places.end());
  return static_cast<std::uint64_t>(places.end() - std::unique(places.begin(), places.end()));
}

}  // namespace

void measure_border(const Block& block, const BorderEdges& border, Findings& findings) {
  findings.counts.t_junctions += count_t_junctions(block, border);
  findings.counts.unwelded_edges += count_unwelded_edges(block, border);
}

}  // namespace tinsmith
