#include "simplify/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "geometry/triangle_rows.hpp"
#include "geometry/vertical_quadric.hpp"
#include "simplify/bucket_queue.hpp"
#include "simplify/error_bound.hpp"
#include "simplify/placement.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// More triangles than this around one vertex are slow to walk and make slivers.
constexpr std::size_t kMaxStar = 64;
// Twice the area over the square of the longest side: below that, a sliver.
constexpr double kMinShape = 0.0;

struct OuterEdge {
  std::int32_t a;
  std::int32_t b;
};

// A vertex waits in the queue under the cost of its best edge.
struct Waiting {
  std::int32_t vertex;
  std::uint32_t version;
};

class Simplifier {
 public:
  Simplifier(WindowMesh& mesh, const HeightGrid& samples, const SimplifyOptions& options)
      : mesh_(mesh),
        samples_(samples),
        options_(options),
        slope_noise_(std::max(0.01 * options.tolerance, 1e-9)),
        quadric_(mesh.position.size()),
        version_(mesh.position.size(), 0),
        best_(mesh.position.size(), kNone),
        refused_at_(mesh.origin.size(), kNeverRefused),
        mark_(mesh.position.size(), 0) {}

  SimplifyCounts run() {
    for (std::int32_t v = 0; v < mesh_.n_vertices(); ++v) {
      if (mesh_.is_alive(v)) sum_quadric(v);
    }
    for (std::int32_t v = 0; v < mesh_.n_vertices(); ++v) {
      if (mesh_.is_alive(v) && !(options_.only_fresh && mesh_.was_free[at(v)])) queue_best(v);
    }
    Waiting waiting{};
    std::size_t bucket = 0;
    while (queue_.pop(waiting, bucket)) {
      if (version_[at(waiting.vertex)] == waiting.version && mesh_.is_alive(waiting.vertex))
        try_best(waiting.vertex, bucket);
    }
    return counts_;
  }

 private:
  static constexpr std::uint64_t kNeverRefused = std::numeric_limits<std::uint64_t>::max();

  // ---- the queue

  // An edge is refused until one of its ends changes: then the sum of their versions has grown.
  std::uint64_t edge_version(std::int32_t h) const {
    return std::uint64_t{version_[at(mesh_.origin[at(h)])]} + version_[at(mesh_.destination(h))];
  }
  std::int32_t edge_of(std::int32_t h) const { return std::max(h, mesh_.twin[at(h)]); }

  EdgeEnd end(std::int32_t v) const {
    return {mesh_.position[at(v)], mesh_.height[at(v)], mesh_.kind[at(v)], &quadric_[at(v)]};
  }

  Candidates candidates(std::int32_t h) const {
    return place(end(mesh_.origin[at(h)]), end(mesh_.destination(h)), mesh_.is_border_edge(h), options_.placement,
                 slope_noise_);
  }

  template <class F>
  void for_each_edge(std::int32_t v, F&& f) const {
    std::int32_t last = kNone;
    for_each_out(mesh_, v, [&](std::int32_t h) {
      f(h);
      last = h;
    });
    // The last edge of an open fan has only the halfedge that arrives.
    if (mesh_.turn(last) == kNone) f(WindowMesh::previous(last));
  }

  void queue_best(std::int32_t v) {
    float best_cost = std::numeric_limits<float>::infinity();
    std::int32_t best = kNone;
    for_each_edge(v, [&](std::int32_t h) {
      if (refused_at_[at(edge_of(h))] == edge_version(h)) return;
      const Candidates c = candidates(h);
      if (c.n == 0) return;
      const auto cost = static_cast<float>(c.cost);
      if (cost < best_cost) {
        best_cost = cost;
        best = h;
      }
    });
    best_[at(v)] = best;
    if (best != kNone) queue_.push(queue_.bucket_of(best_cost), {v, version_[at(v)]});
  }

  void try_best(std::int32_t v, std::size_t bucket) {
    const std::int32_t h = best_[at(v)];
    const bool is_stale = refused_at_[at(edge_of(h))] == edge_version(h);
    const Candidates c = is_stale ? Candidates{} : candidates(h);
    if (is_stale || c.n == 0 || queue_.bucket_of(static_cast<float>(c.cost)) > bucket) {
      queue_best(v);
      return;
    }
    if (collapse(h, c)) return;
    refused_at_[at(edge_of(h))] = edge_version(h);
    queue_best(v);
  }

  // ---- one collapse

  bool collapse(std::int32_t h, const Candidates& c) {
    if (!gather_star(h) || !is_linked(h)) {
      ++counts_.refused_topology;
      return false;
    }
    bool in_kernel = false;
    for (int i = 0; i < c.n; ++i) {
      const Candidate& candidate = c.list[static_cast<std::size_t>(i)];
      if (!is_in_kernel(candidate.position)) continue;
      in_kernel = true;
      double height = 0;
      if (!find_height(candidate, height)) continue;
      apply(h, {candidate.position, height});
      return true;
    }
    ++(in_kernel ? counts_.refused_bound : counts_.refused_half_space);
    return false;
  }

  // The sides opposite to the ends of the edge, of all triangles that stay.
  bool gather_star(std::int32_t h) {
    star_.clear();
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    for (const std::int32_t v : {v0, v1}) {
      for_each_out(mesh_, v, [&](std::int32_t g) {
        const std::int32_t n = WindowMesh::next(g);
        const OuterEdge edge{mesh_.origin[at(n)], mesh_.destination(n)};
        if (edge.a != v0 && edge.a != v1 && edge.b != v0 && edge.b != v1) star_.push_back(edge);
      });
    }
    return !star_.empty() && star_.size() <= kMaxStar;
  }

  // Link condition: the ends have no common neighbour but the apexes of the edge's own triangles.
  bool is_linked(std::int32_t h) {
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    ++mark_now_;
    for_each_edge(v0, [&](std::int32_t e) { mark_[at(other_end(e, v0))] = mark_now_; });
    int common = 0;
    for_each_edge(v1, [&](std::int32_t e) { common += mark_[at(other_end(e, v1))] == mark_now_ ? 1 : 0; });
    return common == (mesh_.is_border_edge(h) ? 1 : 2) && keeps_apexes(h);
  }

  std::int32_t other_end(std::int32_t e, std::int32_t v) const {
    return mesh_.origin[at(e)] == v ? mesh_.destination(e) : mesh_.origin[at(e)];
  }

  // A triangle whose two other sides are both on the border would leave its apex without a triangle.
  bool keeps_apexes(std::int32_t h) const {
    const auto has_neighbour = [&](std::int32_t e) {
      return !mesh_.is_border_edge(WindowMesh::next(e)) || !mesh_.is_border_edge(WindowMesh::previous(e));
    };
    return has_neighbour(h) && (mesh_.is_border_edge(h) || has_neighbour(mesh_.twin[at(h)]));
  }

  // Half-space test, eq. 24, in the horizontal plane: p strictly inside every side of the link.
  bool is_in_kernel(LatticePoint p) const {
    return std::all_of(star_.begin(), star_.end(), [&](const OuterEdge& edge) {
      const LatticePoint a = mesh_.position[at(edge.a)];
      const LatticePoint b = mesh_.position[at(edge.b)];
      const std::int64_t area = orient(p, a, b);
      return area > 0 && (kMinShape == 0.0 || has_shape(area, p, a, b));
    });
  }

  static bool has_shape(std::int64_t area, LatticePoint a, LatticePoint b, LatticePoint c) {
    const auto length2 = [](LatticePoint u, LatticePoint v) {
      const auto dx = static_cast<double>(u.x - v.x);
      const auto dy = static_cast<double>(u.y - v.y);
      return dx * dx + dy * dy;
    };
    return static_cast<double>(area) >= kMinShape * std::max({length2(a, b), length2(b, c), length2(c, a)});
  }

  // The least-squares height over the star's samples, held within the feasible interval.
  bool find_height(const Candidate& candidate, double& height) const {
    HeightInterval interval;
    const Bound bound{samples_, options_.tolerance, candidate.height};
    for (const OuterEdge& edge : star_) {
      const Corner a{mesh_.position[at(edge.a)], mesh_.height[at(edge.a)]};
      const Corner b{mesh_.position[at(edge.b)], mesh_.height[at(edge.b)]};
      if (!narrow(interval, bound, candidate.position, a, b)) return false;
    }
    if (candidate.has_fixed_height) {
      height = candidate.height;
      return interval.lowest <= 0 && 0 <= interval.highest;
    }
    const double best = interval.sum_ww > 0 ? interval.sum_wr / interval.sum_ww : 0;
    height = candidate.height + std::clamp(best, interval.lowest, interval.highest);
    return true;
  }

  void apply(std::int32_t h, const Place& place) {
    ++counts_.collapses;
    // The survivor is the end of the higher kind: a locked vertex is known elsewhere by its place.
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    const std::int32_t kept = mesh_.kind[at(v0)] > mesh_.kind[at(v1)] ? v0 : v1;
    collapse_edge(mesh_, h, kept, place);
    ++version_[at(kept == v0 ? v1 : v0)];
    refresh_around(kept);
  }

  void refresh_around(std::int32_t v) {
    ring_.clear();
    ring_.push_back(v);
    for_each_edge(v, [&](std::int32_t e) { ring_.push_back(other_end(e, v)); });
    for (const std::int32_t u : ring_) {
      ++version_[at(u)];
      sum_quadric(u);
    }
    for (const std::int32_t u : ring_) queue_best(u);
  }

  void sum_quadric(std::int32_t v) {
    VerticalQuadric q;
    const LatticePoint p = mesh_.position[at(v)];
    const double z = mesh_.height[at(v)];
    for_each_out(mesh_, v, [&](std::int32_t h) {
      const std::int32_t a = mesh_.destination(h);
      const std::int32_t b = mesh_.origin[at(WindowMesh::previous(h))];
      const LatticePoint pa = mesh_.position[at(a)];
      const LatticePoint pb = mesh_.position[at(b)];
      const Plane plane = plane_through(p, z, pa, mesh_.height[at(a)], pb, mesh_.height[at(b)]);
      q.add(plane.dx, plane.dy, static_cast<double>(orient(p, pa, pb)));
    });
    quadric_[at(v)] = q;
  }

  WindowMesh& mesh_;
  const HeightGrid& samples_;
  const SimplifyOptions& options_;
  double slope_noise_;
  std::vector<VerticalQuadric> quadric_;   // by vertex
  std::vector<std::uint32_t> version_;     // by vertex: grows when its star changes
  std::vector<std::int32_t> best_;         // by vertex: the halfedge that it waits for
  std::vector<std::uint64_t> refused_at_;  // by edge: the version in which it was refused
  std::vector<std::uint32_t> mark_;        // by vertex, valid when equal to mark_now_
  std::uint32_t mark_now_ = 0;
  BucketQueue<Waiting> queue_;
  std::vector<OuterEdge> star_;
  std::vector<std::int32_t> ring_;
  SimplifyCounts counts_;
};

}  // namespace

SimplifyCounts simplify(WindowMesh& mesh, const HeightGrid& samples, const SimplifyOptions& options) {
  return Simplifier(mesh, samples, options).run();
}

}  // namespace tinsmith
