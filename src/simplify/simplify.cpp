#include "simplify/simplify.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/check.hpp"
#include "geometry/triangle_rows.hpp"
#include "geometry/vertical_quadric.hpp"
#include "simplify/bucket_queue.hpp"
#include "simplify/placement.hpp"
#include "simplify/refine.hpp"
#include "simplify/star.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// More triangles than this around one vertex are slow to walk. A guard: on the sample terrain at 5 and 50 m 24, 32
// and 256 give the same mesh.
constexpr std::size_t kMaxStar = 64;

constexpr double kLatticeAreaPerCell =
    2.0 * kLatticePerCell * kLatticePerCell;  // twice the area, as orient() has it

// A new star may have as much squared error as so many typical triangles have that are off by the tolerance
// everywhere. Where buildings and trees stand beside lawns most triangles are small, and a large one that is off by
// half the tolerance is worth many of them. The lidar surface of Autzen, its voids filled, as triangles (RMSE in
// metres):
//
//   evenness     8.6 m             19 m           sample terrain, 50 m
//          -   35 484 (2.99)    3 229 (6.13)    32 725 (15.9)
//         40   38 695 (1.87)    4 909 (3.76)    32 781 (15.6)
//         32   39 435 (1.83)    5 355 (3.63)    32 825 (15.6)
//         25   40 277 (1.78)    5 781 (3.52)    32 880 (15.5)
//
// CGAL's Lindstrom-Turk, which promises no largest error, has 1.95 and 3.90 m with as many as the first row.
constexpr double kEvenness = 32;

// One run over one mesh: the loop, and all that it remembers of vertices, edges and triangles.
class Simplifier {
 public:
  Simplifier(WindowMesh& mesh, const HeightGrid& samples, const SimplifyOptions& options, const ColourGrid* colours)
      : mesh_(mesh),
        samples_(samples),
        options_(options),
        rules_{options.placement, std::max(0.01 * options.tolerance, 1e-9)},
        squared_error_(mesh.origin.size() / 3, kUnknown),
        quadrics_(kQuadrics),
        vertex_(mesh.position.size()),
        best_(mesh.position.size(), kNone),
        cost_(mesh.origin.size(), kUnknown),
        queue_(mesh.position.size()),
        colours_(colours) {
    if (colours_ == nullptr) return;
    colour_quadrics_.resize(kQuadrics);
    const auto n_channels = static_cast<double>(colours_->channels.size());
    height_per_level_ =
        std::sqrt(options.colour.weight / n_channels) * options.tolerance / options.colour.tolerance;
  }

  SimplifyCounts run() {
    for (std::int32_t v = 0; v < mesh_.n_vertices(); ++v) {
      if (!mesh_.is_alive(v) || (options_.only_unsettled && mesh_.is_settled[at(v)])) continue;
      vertex_[at(v)].is_touched = true;
      vertex_[at(v)].is_refined = false;
      queue_best(v);
    }
    collapse_all();
    for (int i = 0; i < options_.labour.refinements; ++i) {
      refine();
      collapse_all();
    }
    if (options_.labour.refinements > 0) refine();
    if (colours_ != nullptr) fit_colours();
    return counts_;
  }

 private:
  static constexpr std::size_t kNoClass = std::numeric_limits<std::size_t>::max();
  static constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

  struct VertexState {
    bool is_touched : 1 = false;     // something has changed around it since the round before
    bool has_changed : 1 = false;    // and since its edges were refused
    bool is_best_known : 1 = false;  // the cheapest edge not refused
    bool is_queued : 1 = false;
    bool is_refined : 1 = true;
    bool is_marked : 1 = false;
  };

  struct VertexQuadric {
    std::int32_t vertex = kNone;
    VerticalQuadric quadric;
  };
  static constexpr std::size_t kQuadrics = 2048;

  void collapse_all() {
    std::int32_t v = kNone;
    std::size_t cost_class = 0;
    while (queue_.pop(v, cost_class)) {
      vertex_[at(v)].is_queued = false;
      if (mesh_.is_alive(v)) try_best(v, cost_class);
    }
  }

  // ---- refinement: what changes goes to the front of the queue, to be looked at anew

  void refine() {
    const RefineBound bound{samples_, options_.tolerance, options_.placement == Placement::kOptimal, colours_,
                            height_per_level_ * height_per_level_};
    for (std::int32_t v = 0; v < mesh_.n_vertices(); ++v) {
      if (!mesh_.is_alive(v) || vertex_[at(v)].is_refined) continue;
      vertex_[at(v)].is_refined = true;
      if (!improve_vertex(mesh_, bound, v, star_)) continue;
      ++counts_.moves;
      refresh_star(v, 0);
    }
    for (std::int32_t h = 0; h < mesh_.n_halfedges(); ++h) {
      if (mesh_.origin[at(h)] == kNone || h < mesh_.twin[at(h)] || !is_touched(h)) continue;
      if (!improve_edge(mesh_, bound, h, squared_error_)) continue;
      ++counts_.flips;
      note_flip(h);
    }
  }

  void note_flip(std::int32_t h) {
    for (const std::int32_t e : {h, mesh_.twin[at(h)]}) {
      forget_error(e);
      for (const std::int32_t side : {e, WindowMesh::next(e), WindowMesh::previous(e)}) {
        forget_cost(side);
        change(mesh_.origin[at(side)], 0);
      }
    }
  }

  // v has moved.
  void refresh_star(std::int32_t v, std::size_t cost_class) {
    for_each_out(mesh_, v, [&](std::int32_t h) { forget_error(h); });
    change(v, cost_class);
    for_each_edge(v, [&](std::int32_t e) {
      forget_cost(e);
      change(other_end(e, v), cost_class);
    });
  }

  // ---- the queue: each vertex waits under the cost of its best edge. A vertex whose star has changed keeps
  // its place and is looked at anew when its turn comes: costs mostly grow, and many change several times.

  bool is_touched(std::int32_t h) const {
    return vertex_[at(mesh_.origin[at(h)])].is_touched || vertex_[at(mesh_.destination(h))].is_touched;
  }

  EdgeEnd end(std::int32_t v) {
    return {mesh_.position[at(v)], mesh_.height[at(v)], mesh_.kind[at(v)], quadrics_[summed(v)].quadric};
  }

  Edge placed_edge(std::int32_t h) {
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    return {end(v0), end(v1), mesh_.is_border_edge(h), colours_ == nullptr ? nullptr : edge_colour(v0, v1)};
  }

  // ---- by edge: the cost of when one of its ends moved last (what has changed beside them matters less), kept by
  // the larger halfedge. A sign says that the edge was refused, which holds until the star of an end changes.

  float& kept_cost(std::int32_t h) { return cost_[at(std::max(h, mesh_.twin[at(h)]))]; }
  void forget_cost(std::int32_t h) { kept_cost(h) = kUnknown; }

  bool is_refused(std::int32_t h) {
    return std::signbit(kept_cost(h)) && !vertex_[at(mesh_.origin[at(h)])].has_changed &&
           !vertex_[at(mesh_.destination(h))].has_changed;
  }

  void refuse(std::int32_t h) {
    forget_refusals(mesh_.origin[at(h)]);
    forget_refusals(mesh_.destination(h));
    kept_cost(h) = -std::abs(kept_cost(h));
  }

  // Those from before the star of v changed.
  void forget_refusals(std::int32_t v) {
    if (!vertex_[at(v)].has_changed) return;
    vertex_[at(v)].has_changed = false;
    for_each_edge(v, [&](std::int32_t h) { kept_cost(h) = std::abs(kept_cost(h)); });
  }

  float cost(std::int32_t h) {
    float& kept = kept_cost(h);
    if (std::isnan(kept)) {
      const Edge e = placed_edge(h);
      const double cost = edge_cost(e, rules_);
      kept = cost > hopeless_cost(e) ? std::numeric_limits<float>::infinity() : static_cast<float>(cost);
    }
    return std::abs(kept);
  }

  // Of the edges that cost this much about one in ten could collapse, counted over all edges of the sample
  // terrain at 2 and 10 m. Where the quadric error is far above what the tolerance is worth over the cells under
  // the edge the samples hardly ever leave a height, but the fewer they are the more often they do.
  double hopeless_cost(const Edge& e) const {
    const double cells = (e.v0.quadric.area + e.v1.quadric.area) / kLatticeAreaPerCell;
    const double cells_at_tolerance = 0.62 * cells - 12 + (1300 + 4500 / cells) / cells;  // 47 at the least
    return options_.labour.patience * options_.tolerance * options_.tolerance * cells_at_tolerance *
           kLatticeAreaPerCell;
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

  // The class of the cheapest edge of v that is not refused; kNoClass when there is none.
  std::size_t find_best(std::int32_t v) {
    float best_cost = std::numeric_limits<float>::infinity();
    std::int32_t best = kNone;
    forget_refusals(v);
    for_each_edge(v, [&](std::int32_t h) {
      if (is_refused(h)) return;
      const float now = cost(h);
      if (!(now < best_cost)) return;
      best_cost = now;
      best = h;
    });
    best_[at(v)] = best;
    vertex_[at(v)].is_best_known = true;
    return best == kNone ? kNoClass : BucketQueue::class_of(best_cost);
  }

  void queue(std::int32_t v, std::size_t cost_class) {
    if (cost_class == kNoClass || vertex_[at(v)].is_queued) return;
    vertex_[at(v)].is_queued = true;
    queue_.push(cost_class, v);
  }
  void queue_best(std::int32_t v) { queue(v, find_best(v)); }

  void try_best(std::int32_t v, std::size_t cost_class) {
    if (!vertex_[at(v)].is_best_known) {
      const std::size_t now = find_best(v);
      if (now > cost_class) {
        queue(v, now);
        return;
      }
    }
    const std::int32_t h = best_[at(v)];
    if (!is_refused(h) && BucketQueue::class_of(cost(h)) <= cost_class) {
      if (collapse(h, cost_class)) return;
      refuse(h);
    }
    queue_best(v);
  }

  // ---- one collapse

  bool collapse(std::int32_t h, std::size_t cost_class) {
    if (!gather_star(h) || !keeps_apexes(h)) {
      ++counts_.refused_topology;
      return false;
    }
    const Candidates c = place(placed_edge(h), rules_);
    HeightInterval refusal;
    bool in_kernel = false;
    for (int i = 0; i < c.n; ++i) {
      const Candidate& candidate = c.list[static_cast<std::size_t>(i)];
      if (!is_in_kernel(star_, candidate.position)) continue;
      const Bound bound{samples_, options_.tolerance, candidate.height};
      // What refused one candidate mostly refuses the next.
      if (in_kernel && is_still_empty(refusal, star_, bound, candidate.position)) continue;
      in_kernel = true;
      const HeightInterval interval = feasible_heights(star_, bound, candidate.position);
      if (interval.is_empty()) {
        refusal = interval;
        continue;
      }
      if (candidate.has_fixed_height && !(interval.lowest <= 0 && 0 <= interval.highest)) continue;
      const double offset = candidate.has_fixed_height ? 0 : interval.best();
      if (interval.squared_error(offset) > allowed_squared_error(candidate.position)) continue;
      if (colours_ != nullptr && !keeps_colours(h, candidate.position)) {
        ++counts_.refused_colour;
        return false;
      }
      apply(h, {candidate.position, candidate.height + offset}, cost_class);
      return true;
    }
    ++(in_kernel ? counts_.refused_bound : counts_.refused_half_space);
    return false;
  }

  double allowed_squared_error(LatticePoint p) const {
    double area = 0;
    for (const Side& side : star_) area += static_cast<double>(orient(p, side.a.position, side.b.position));
    const double roughness = options_.labour.roughness;
    const double cells =
        std::min(roughness * roughness * area / kLatticeAreaPerCell, kEvenness * options_.typical_area);
    return options_.tolerance * options_.tolerance * cells;
  }

  // Gathers the sides opposite to the ends of the edge, of all triangles that stay. False when the collapse would
  // break the link condition: the ends have no common neighbour but the apexes of the edge's own triangles.
  bool gather_star(std::int32_t h) {
    star_.clear();
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    const auto mark = [&](std::int32_t neighbour) {
      vertex_[at(neighbour)].is_marked = true;
      marked_.push_back(neighbour);
    };
    mark(add_sides(v0, v1, mark));
    int common = 0;
    const auto count = [&](std::int32_t neighbour) { common += vertex_[at(neighbour)].is_marked ? 1 : 0; };
    const std::int32_t last1 = add_sides(v1, v0, count);
    if (mesh_.is_border_vertex(v1)) count(last1);
    for (const std::int32_t v : marked_) vertex_[at(v)].is_marked = false;
    marked_.clear();
    return common == (mesh_.is_border_edge(h) ? 1 : 2) && !star_.empty() && star_.size() <= kMaxStar;
  }

  // Calls f for the neighbours of v counter-clockwise but for the last, which it returns; in a closed fan that is
  // the first again.
  template <class F>
  std::int32_t add_sides(std::int32_t v, std::int32_t other, F&& f) {
    std::int32_t last = kNone;
    for_each_out(mesh_, v, [&](std::int32_t g) {
      const std::int32_t a = mesh_.destination(g);
      last = mesh_.origin[at(WindowMesh::previous(g))];
      f(a);
      if (a != other && last != other) star_.push_back({corner(a), corner(last)});
    });
    return last;
  }

  Corner corner(std::int32_t v) const { return {mesh_.position[at(v)], mesh_.height[at(v)]}; }

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

  // The end of the higher kind: a locked vertex is known elsewhere by its place.
  std::int32_t survivor(std::int32_t h) const {
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    return mesh_.kind[at(v0)] > mesh_.kind[at(v1)] ? v0 : v1;
  }

  void apply(std::int32_t h, const Place& place, std::size_t cost_class) {
    ++counts_.collapses;
    const std::int32_t kept = survivor(h);
    collapse_edge(mesh_, h, kept, place);
    if (colours_ != nullptr) mesh_.colour[at(kept)] = new_colour_;
    refresh_star(kept, cost_class);
  }

  void change(std::int32_t v, std::size_t cost_class) {
    VertexState& state = vertex_[at(v)];
    state.is_touched = state.has_changed = true;
    state.is_best_known = state.is_refined = false;
    if (quadrics_[slot_of(v)].vertex == v) quadrics_[slot_of(v)].vertex = kNone;
    queue(v, cost_class);
  }

  // ---- quadrics: those of a few vertices are remembered. Vertices come along a curve, so they are asked for again
  // while they are there.

  static std::size_t slot_of(std::int32_t v) { return at(v) % kQuadrics; }

  std::size_t summed(std::int32_t v) {
    const std::size_t slot = slot_of(v);
    if (quadrics_[slot].vertex != v) sum_quadrics(v, slot);
    return slot;
  }

  void sum_quadrics(std::int32_t v, std::size_t slot) {
    VerticalSum sum;
    const Corner middle = corner(v);
    Corner a = corner(mesh_.destination(mesh_.out[at(v)]));
    for_each_out(mesh_, v, [&](std::int32_t h) {
      const Corner b = corner(mesh_.origin[at(WindowMesh::previous(h))]);
      add_plane(sum, middle, a, b);
      a = b;
    });
    quadrics_[slot] = {v, sum.quadric()};
    if (colours_ != nullptr) sum_colour_quadrics(v, slot);
  }

  static void add_plane(VerticalSum& sum, const Corner& a, const Corner& b, const Corner& c) {
    const Plane plane = plane_through(a, b, c);
    sum.add(plane.dx, plane.dy, static_cast<double>(orient(a.position, b.position, c.position)));
  }

  // The triangle of h has changed.
  void forget_error(std::int32_t h) { squared_error_[at(h / 3)] = kUnknown; }

  // ---- colour

  // Notes the new vertex's colour. False when the samples of the star would be too far from it.
  bool keeps_colours(std::int32_t h, LatticePoint p) {
    const std::int32_t v0 = mesh_.origin[at(h)];
    const std::int32_t v1 = mesh_.destination(h);
    const std::int32_t kept = survivor(h);
    colour_star_.clear();
    add_colour_sides(mesh_, v0, v1, colour_star_);
    add_colour_sides(mesh_, v1, v0, colour_star_);
    const ColourFit fit = fit_colour(colour_star_, *colours_, p);
    const Levels& old = mesh_.colour[at(kept)];
    new_colour_ = mesh_.kind[at(kept)] == VertexKind::kLocked ? old : fit.best(old);
    const double tolerance = options_.colour.tolerance;
    const double allowed = tolerance * tolerance * static_cast<double>(fit.n_channels) * area_of(colour_star_, p);
    return fit.squared_error(new_colour_) <= allowed;
  }

  const EdgeColour* edge_colour(std::int32_t v0, std::int32_t v1) {
    edge_colour_.n_channels = colours_->channels.size();
    edge_colour_.v0 = colour_quadrics_[summed(v0)];
    edge_colour_.v1 = colour_quadrics_[summed(v1)];
    for (std::size_t c = 0; c < edge_colour_.n_channels; ++c)
      edge_colour_.rise[c] =
          height_per_level_ * static_cast<double>(mesh_.colour[at(v1)][c] - mesh_.colour[at(v0)][c]);
    return &edge_colour_;
  }

  void sum_colour_quadrics(std::int32_t v, std::size_t slot) {
    for (std::size_t c = 0; c < colours_->channels.size(); ++c) {
      const auto level = [&](std::int32_t corner) {
        return Corner{mesh_.position[at(corner)],
                      height_per_level_ * static_cast<double>(mesh_.colour[at(corner)][c])};
      };
      VerticalSum sum;
      for_each_out(mesh_, v, [&](std::int32_t h) {
        add_plane(sum, level(v), level(mesh_.destination(h)), level(mesh_.origin[at(WindowMesh::previous(h))]));
      });
      colour_quadrics_[slot][c] = sum.quadric();
    }
  }

  // Gives every vertex that has had its turn the colour that fits best beside its neighbours', a few times round.
  void fit_colours() {
    constexpr int kSweeps = 4;
    for (int i = 0; i < kSweeps; ++i) {
      for (std::int32_t v = 0; v < mesh_.n_vertices(); ++v) {
        if (!mesh_.is_alive(v) || !vertex_[at(v)].is_touched || mesh_.kind[at(v)] == VertexKind::kLocked) continue;
        colour_star_.clear();
        add_colour_sides(mesh_, v, kNone, colour_star_);
        const ColourFit fit = fit_colour(colour_star_, *colours_, mesh_.position[at(v)]);
        mesh_.colour[at(v)] = fit.best(mesh_.colour[at(v)]);
      }
    }
  }

  WindowMesh& mesh_;
  const HeightGrid& samples_;
  const SimplifyOptions& options_;
  PlacementRules rules_;
  std::vector<float> squared_error_;  // by triangle; not a number: not known
  std::vector<VertexQuadric> quadrics_;
  std::vector<VertexState> vertex_;
  std::vector<std::int32_t> best_;    // by vertex: a halfedge of the cheapest edge not refused
  std::vector<float> cost_;           // by halfedge
  std::vector<std::int32_t> marked_;  // vertices, while a star is gathered
  BucketQueue queue_;
  Star star_;
  SimplifyCounts counts_;
  const ColourGrid* colours_;                     // none: what follows is empty
  double height_per_level_ = 0;                   // what makes levels and heights weigh alike
  std::vector<ChannelQuadrics> colour_quadrics_;  // beside quadrics_
  EdgeColour edge_colour_;
  ColourStar colour_star_;
  Levels new_colour_{};
};

}  // namespace

SimplifyCounts simplify(WindowMesh& mesh, const HeightGrid& samples, const SimplifyOptions& options,
                        const ColourGrid* colours) {
  return Simplifier(mesh, samples, options, colours).run();
}

}  // namespace tinsmith
