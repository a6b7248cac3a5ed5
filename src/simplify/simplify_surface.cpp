// Edge collapse on surfaces in space: the paper's steps 1 to 7.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <queue>
#include <span>

#include "simplify/collapse_entry.hpp"
#include "simplify/plane_quadrics.hpp"
#include "simplify/simplified_mesh.hpp"
#include "simplify/surface_attributes.hpp"
#include "simplify/surface_farthest.hpp"
#include "simplify/surface_fit.hpp"
#include "simplify/surface_limits.hpp"
#include "simplify/surface_link.hpp"
#include "simplify/surface_mesh.hpp"
#include "simplify/surface_star.hpp"
#include "simplify/surface_values.hpp"
#include "simplify/surface_wedges.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/simplify.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Eigenvalues of a quadric below that share of the largest say nothing about the place: nearly flat ground has
// about the square of the angle between neighbours. With 1e-3 the RMS distance is 4 to 7 % larger.
constexpr double kFlat = 1e-6;

// Collapses that cost the same go by length: long ones cost as if planes were that inexact, in units of the edge.
// Of a cube, where all cost nothing, it takes a twentieth of the time; elsewhere the largest distance at 5 and 1 %
// is up to a fifth less. With 1e-5, and so a hundredth of an edge, smooth shapes have a tenth more RMS distance at
// 50 %.
constexpr double kSquaredNoise = 1e-6;

// A collapse costs no less than so many times what its planes would if they were as far off as the ends of the edge
// are from the new triangles: quadrics know planes without an end, and see the tip of a spike go for little. Of
// brains and heads at 5 and 1 % the largest distance is 0.6 to 0.8 times, the RMS distance 0.94 to 1 times that
// without; surfaces without thin parts stay nearly as they are.
constexpr double kOfTrueDistance = 0.6;

constexpr float kNotQueued = -1;

struct Collapse {
  double cost = kInfinity;  // E_g + alpha E_c
  Vec<3> position{};
  int end = -1;  // 0 or 1: the new vertex is that end, with its attributes
};

std::unique_ptr<AttributeQuadrics> attribute_quadrics(const SurfaceMesh& mesh, const WedgeValues& all,
                                                      const SimplifySurfaceOptions& options) {
  switch (options.quadric) {
    case QuadricForm::kSeparate:
      return separate_quadrics(mesh, all, options);
    case QuadricForm::kCombined:
      return combined_quadrics(mesh, all, options);
    case QuadricForm::kGradient:
      return gradient_quadrics(mesh, all, options);
  }
  return nullptr;
}

class SurfaceSimplifier {
 public:
  SurfaceSimplifier(SurfaceMesh& mesh, WedgeValues& values, const SimplifySurfaceOptions& options,
                    SimplifySurfaceReport& report, std::vector<SurfaceCollapse>* history)
      : mesh_(mesh),
        values_(values),
        options_(options),
        report_(report),
        history_(history),
        attributes_(values.n_components > 0 ? attribute_quadrics(mesh, values, options) : nullptr),
        queued_cost_(mesh.origin.size(), kNotQueued),
        is_refused_(mesh.origin.size(), 0),
        has_refused_(mesh.position.size(), 0),
        link_condition_(mesh.position.size()),
        n_triangles_(mesh.origin.size() / 3) {}

  void run(double target) {
    if (options_.fit && options_.placement == Placement::kOptimal) samples_ = fit_samples(mesh_, values_, options_);
    geometry_ = plane_quadrics(mesh_, !has_combined(), options_.area_weights);
    n_start_ = static_cast<double>(n_triangles_);
    target_ = target;
    is_balanced_ = is_to_be_balanced();
    if (is_balanced_) weigh_attributes();
    push_all();
    if (is_balanced_) balance_attributes();
    collapse_down_to(target);
    if (static_cast<double>(n_triangles_) > target) {
      push_refused();
      collapse_down_to(target);
    }
    if (may_add_vertices()) collapse_down_to(target - 2 * n_kept_back(n_start_, target, is_balanced_));
    tell(1);
    if (static_cast<double>(n_triangles_) <= target) report_.stopped_by = SimplifyStop::kTriangles;
    geometry_ = {};  // fit needs as much
    queue_ = {};
    // Flips would mend what the half-space test, left out, lets happen.
    if (report_.collapses > 0 && !samples_.vertex.empty())
      fit(mesh_, values_, samples_, options_.half_space, n_missing(target));
  }

 private:
  using Queue = std::priority_queue<CollapseEntry, std::vector<CollapseEntry>, std::greater<>>;

  // In the fit, where not all is exact.
  bool may_add_vertices() const {
    constexpr double kExact = 1e-12;  // of the largest extent
    const double squared = kExact * kExact * mesh_.extent * mesh_.extent;
    return options_.half_space && !samples_.vertex.empty() && report_.last_cost > squared;
  }

  std::size_t n_missing(double target) const {
    return static_cast<std::size_t>(std::max(0.0, target - static_cast<double>(n_triangles_)));
  }

  double times_fewer() const { return static_cast<double>(n_triangles_) / target_; }

  void weigh_attributes() {
    usual_weight_ = seen_weight(attribute_weight(mesh_, options_), {mesh_, values_, samples_}, times_fewer());
    attributes_->set_weight(usual_weight_);
  }

  // A few times on the way to the last triangles: how far places and values will be off is known only then.
  void balance_attributes() {
    for (const double times : {8, 4, 2}) {
      if (!(times_fewer() > times)) continue;
      collapse_down_to(times * target_);
      if (queue_.empty()) return;
      follow_collapses(mesh_, samples_);
      attributes_->set_weight(balanced_weight(usual_weight_, errors_of({mesh_, values_, samples_}), times_fewer()));
      push_all();
    }
  }

  bool is_to_be_balanced() const {
    return options_.quadric == QuadricForm::kGradient && !options_.attribute_weight && !samples_.values.empty() &&
           target_ > 0 && !values_.are_all_equal();
  }

  void collapse_down_to(double target) {
    while (!queue_.empty() && static_cast<double>(n_triangles_) > target) {
      const std::int32_t h = queue_.top().halfedge();
      const float cost = queue_.top().cost();
      queue_.pop();
      if (mesh_.origin[at(h)] == kNone || queued_cost_[at(h)] != cost) continue;
      queued_cost_[at(h)] = kNotQueued;
      try_collapse(h, cost);
      if (++n_steps_ % 4096 == 0) tell((n_start_ - static_cast<double>(n_triangles_)) / (n_start_ - target_));
    }
  }

  void push_all() {
    std::vector<CollapseEntry> entries;
    entries.reserve(mesh_.origin.size());  // nearly half of it for those that come later
    for (std::int32_t h = 0; h < mesh_.n_halfedges(); ++h) {
      if (mesh_.origin[at(h)] == kNone || h < mesh_.twin[at(h)]) continue;
      if (note_cost(h)) entries.emplace_back(queued_cost_[at(h)], h);
    }
    queue_ = Queue({}, std::move(entries));  // in linear time
  }

  // Once nothing else is left, places are tried that are not the best: a torus of 3600 triangles ends at 36 instead
  // of 40. Tried at once they make the RMS distance of a brain at 1 % 1.03 times as large.
  void push_refused() {
    tries_places_ = true;
    for (std::int32_t h = 0; h < mesh_.n_halfedges(); ++h) {
      if (mesh_.origin[at(h)] != kNone && is_refused_[at(h)] && edge_of(h) == h) push(h);
    }
  }

  void tell(double fraction) {
    if (options_.progress && !options_.progress(std::clamp(fraction, 0.0, 1.0), "simplify"))
      throw Interrupted("interrupted; nothing was written");
  }

  // The six-dimensional quadrics hold the triangles' planes too.
  bool has_combined() const { return attributes_ != nullptr && options_.quadric == QuadricForm::kCombined; }

  const Vec<3>& point(std::int32_t h) const { return mesh_.position[at(mesh_.origin[at(h)])]; }

  // ---- step 4: cost and new vertex of an edge

  SurfaceVertexKind kind(std::int32_t v) const { return mesh_.kind[at(v)]; }

  bool may_collapse(std::int32_t h) const {
    const SurfaceVertexKind k0 = kind(mesh_.origin[at(h)]);
    const SurfaceVertexKind k1 = kind(mesh_.destination(h));
    if (std::min(k0, k1) == SurfaceVertexKind::kInterior) return true;
    return std::min(k0, k1) == SurfaceVertexKind::kFeature && mesh_.is_feature[at(h)];
  }

  double attribute_cost(std::int32_t h, const Collapse& collapse) {
    if (!attributes_ || (!attributes_count(options_) && !has_combined())) return 0;
    double cost = 0;
    for (const WedgePair& pair : wedge_pairs(mesh_, h))
      cost += attributes_->cost(pair, collapse.position, new_values(h, pair, collapse));
    return cost;
  }

  // Of the new vertex: an end's own, or the best for its place.
  std::span<const double> new_values(std::int32_t h, const WedgePair& pair, const Collapse& collapse) {
    const std::span<const double> v0 = values_.of(pair.w0);
    const std::span<const double> v1 = values_.of(pair.w1);
    scratch_.resize(v0.size());
    const double t = collapse.end >= 0 ? collapse.end : share_of_second(h, collapse.position);
    for (std::size_t i = 0; i < v0.size(); ++i) scratch_[i] = v0[i] + t * (v1[i] - v0[i]);
    if (collapse.end >= 0) return scratch_;
    attributes_->find_best(pair, collapse.position, scratch_);
    put_in_range(values_, scratch_);
    return scratch_;
  }

  // Where between the ends, 0 to 1.
  double share_of_second(std::int32_t h, const Vec<3>& p) const {
    const Vec<3> edge = point(Halfedges::next(h)) - point(h);
    const double squared = dot(edge, edge);
    return squared > 0 ? std::clamp(dot(p - point(h), edge) / squared, 0.0, 1.0) : 0.5;
  }

  // 0 or 1: the end at which the new vertex has to stay; -1: none.
  int fixed_end(std::int32_t h) const {
    const SurfaceVertexKind k0 = kind(mesh_.origin[at(h)]);
    const SurfaceVertexKind k1 = kind(mesh_.destination(h));
    if (k0 == k1) return -1;
    return k0 > k1 ? 0 : 1;
  }

  Collapse at_end(std::int32_t h, int end, const Quadric<3>& quadric) {
    const std::int32_t v = end == 0 ? mesh_.origin[at(h)] : mesh_.destination(h);
    return at_place(h, mesh_.position[at(v)], quadric, end);
  }

  Collapse at_place(std::int32_t h, const Vec<3>& p, const Quadric<3>& quadric, int end = -1) {
    Collapse collapse{0, p, end};
    collapse.cost = std::max(0.0, quadric.at(p)) + attribute_cost(h, collapse);
    return collapse;
  }

  // Geometry and what the attributes have to say about the place.
  Quadric<3> quadric_of_place(std::int32_t h, const Quadric<3>& geometry) const {
    Quadric<3> quadric = geometry;
    if (attributes_) {
      for (const WedgePair& pair : wedge_pairs(mesh_, h)) attributes_->add_cost_of_place(pair, quadric);
    }
    return quadric;
  }

  Collapse best(std::int32_t h) {
    if (!may_collapse(h)) return {};
    const Quadric<3> quadric = geometry(h);
    const int fixed = fixed_end(h);
    if (fixed >= 0) return at_end(h, fixed, quadric);
    const Vec<3>& v0 = point(h);
    const Vec<3>& v1 = point(Halfedges::next(h));
    if (options_.placement != Placement::kSubset) {
      const Quadric<3> of_place = quadric_of_place(h, quadric);
      Vec<3> p;
      if (options_.placement == Placement::kSegment) return at_place(h, minimum_between(of_place, v0, v1), quadric);
      if (minimum(of_place, p, kFlat) && is_near(p, v0, v1)) return at_place(h, p, quadric);
    }
    const Collapse first = at_end(h, 0, quadric);
    const Collapse second = at_end(h, 1, quadric);
    Collapse least = second.cost < first.cost ? second : first;
    if (options_.placement == Placement::kOptimal) {
      const Collapse middle = at_place(h, along(v0, v1, 0.5), quadric);
      if (middle.cost <= least.cost) least = middle;
    }
    return least;
  }

  // Far off the quadric knows nothing about the surface.
  static bool is_near(const Vec<3>& p, const Vec<3>& v0, const Vec<3>& v1) {
    const Vec<3> edge = v1 - v0;
    const Vec<3> off = p - along(v0, v1, 0.5);
    constexpr double kReach = 2;
    return dot(off, off) <= kReach * kReach * dot(edge, edge);
  }

  // ---- steps 5 and 6: candidates by cost, and one collapse

  void push(std::int32_t h) {
    if (note_cost(h)) queue_.emplace(queued_cost_[at(h)], h);
  }

  // Makes all earlier entries of the edge void. False when it must not collapse.
  bool note_cost(std::int32_t h) {
    const Collapse collapse = best(h);
    const Vec<3> edge = point(Halfedges::next(h)) - point(h);
    const double noise = kSquaredNoise * planes(h).trace() * dot(edge, edge);
    const auto cost = static_cast<float>(collapse.cost + noise);
    const bool may = cost < kInfinity;
    queued_cost_[at(h)] = may ? cost : kNotQueued;
    // Which of the two is the larger may have changed.
    if (mesh_.twin[at(h)] != kNone) queued_cost_[at(mesh_.twin[at(h)])] = kNotQueued;
    is_refused_[at(h)] = 0;
    return may;
  }

  std::int32_t edge_of(std::int32_t h) const { return std::max(h, mesh_.twin[at(h)]); }

  // Unless it is refused, or turns out to cost more than was thought.
  void try_collapse(std::int32_t h, float cost) {
    Collapse collapse = best(h);
    std::uint64_t* refused = refusal(h, collapse);
    if (refused != nullptr && tries_places_ && collapse.end < 0 && find_legal(h, collapse)) refused = nullptr;
    const double distance = mean_squared_distance(h, collapse.position);
    if (options_.max_cost && distance > *options_.max_cost) {
      report_.stopped_by = SimplifyStop::kCost;
      return;
    }
    if (refused != nullptr) {
      ++*refused;
      is_refused_[at(h)] = has_refused_[at(mesh_.origin[at(h)])] = has_refused_[at(mesh_.destination(h))] = 1;
      return;
    }
    const auto least = static_cast<float>(std::max(collapse.cost, least_cost(h, collapse.position, cost)));
    if (least > cost) {
      queued_cost_[at(h)] = least;
      queue_.emplace(least, h);
      return;
    }
    report_.last_cost = std::max(report_.last_cost, distance);
    apply(h, collapse);
  }

  // Where the best place turns a triangle over a place on the edge may not: the cheapest of a few.
  bool find_legal(std::int32_t h, Collapse& collapse) {
    const Quadric<3> quadric = geometry(h);
    bool found = false;
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const bool is_end = t == 0 || t == 1;
      const Collapse other = is_end ? at_end(h, static_cast<int>(t), quadric)
                                    : at_place(h, along(point(h), point(Halfedges::next(h)), t), quadric);
      if ((found && !(other.cost < collapse.cost)) || refusal(h, other) != nullptr) continue;
      collapse = other;
      found = true;
    }
    return found;
  }

  // What counts the reason not to make it; null: there is none.
  std::uint64_t* refusal(std::int32_t h, const Collapse& collapse) {
    if (!link_condition_.holds(mesh_, h, star_) || !has_partners(mesh_, h, kept_end(collapse)))
      return &report_.refused_topology;
    if (options_.half_space && (!is_inside_half_spaces(star_.sides, collapse.position) || folds(collapse.position)))
      return &report_.refused_half_space;
    return nullptr;
  }

  // No edge gets normals more than 90 degrees apart where there was none. Where there was, as on the inner sides of
  // thin parts, there may be: brains at 1 % end twice as far off, heads far from theirs, if these may not get more.
  bool folds(const Vec<3>& p) const { return count_turned(star_, p) > 0 && count_turned(star_) == 0; }

  // Where a surface is folded its triangles can also close what was open, so that the way back counts too: of a
  // brain at 50 % the largest distance is 0.3 times that without.
  // What is no more than `known` need not be it.
  double least_cost(std::int32_t h, const Vec<3>& p, double known) const {
    const double weight = kOfTrueDistance * planes(h).trace();
    if (!(weight > 0)) return 0;
    const double enough = known / weight;
    double farthest = std::max(squared_distance(point(h), star_, p, enough),
                               squared_distance(point(Halfedges::next(h)), star_, p, enough));
    if (count_turned(star_) > 0) farthest = std::max(farthest, squared_distance_back(star_, p));
    return weight * farthest;
  }

  // A new vertex elsewhere takes the name of the origin.
  static int kept_end(const Collapse& collapse) { return collapse.end == 1 ? 1 : 0; }

  void apply(std::int32_t h, const Collapse& collapse) {
    ++report_.collapses;
    const int end = kept_end(collapse);
    const std::int32_t gone = gone_vertex(mesh_, h, end);
    const std::int32_t kept = gone_vertex(mesh_, h, 1 - end);
    if (history_) history_->push_back(noted_collapse(mesh_, h, end));
    move_wedges(h, collapse, gone);
    carry_feature(mesh_, h);
    if (mesh_.twin[at(h)] != kNone) carry_feature(mesh_, mesh_.twin[at(h)]);
    n_triangles_ -= mesh_.is_border_edge(h) ? 1 : 2;
    collapse_edge(mesh_, h, kept);
    mesh_.position[at(kept)] = collapse.position;
    geometry_[at(kept)] += geometry_[at(gone)];
    if (!samples_.vertex.empty()) samples_.vertex[at(gone)] = kept;
    update_around(kept);
  }

  // The wedges of the end that goes become those of the end that stays, with the attributes of the new vertex.
  void move_wedges(std::int32_t h, const Collapse& collapse, std::int32_t gone) {
    for (const WedgePair& pair : wedge_pairs(mesh_, h)) {
      const std::int32_t kept_wedge = kept_of(pair, kept_end(collapse));
      const std::int32_t gone_wedge = gone_of(pair, kept_end(collapse));
      if (attributes_) {
        const std::span<const double> now = new_values(h, pair, collapse);
        std::copy(now.begin(), now.end(), values_.of(kept_wedge).begin());
        if (gone_wedge != kept_wedge) attributes_->unite(kept_wedge, gone_wedge);
      }
      hand_over(mesh_, gone, gone_wedge, kept_wedge);
    }
  }

  // Edges of the new vertex cost anew; around it, what was refused may be legal now.
  void update_around(std::int32_t kept) {
    neighbours_.clear();
    for_each_edge(kept, [&](std::int32_t h) {
      push(edge_of(h));
      neighbours_.push_back(mesh_.origin[at(h)] == kept ? mesh_.destination(h) : mesh_.origin[at(h)]);
    });
    has_refused_[at(kept)] = 0;
    for (const std::int32_t v : neighbours_) {
      if (!has_refused_[at(v)]) continue;
      has_refused_[at(v)] = 0;
      for_each_edge(v, [&](std::int32_t h) {
        if (is_refused_[at(edge_of(h))]) push(edge_of(h));
      });
    }
  }

  template <class F>
  void for_each_edge(std::int32_t v, F&& f) const {
    std::int32_t last = kNone;
    for_each_out(mesh_, v, [&](std::int32_t h) {
      f(h);
      last = h;
    });
    if (mesh_.turn(last) == kNone) f(Halfedges::previous(last));
  }

  // The planes that the new vertex stands for; attributes count where they are in one quadric with the place.
  Quadric<3> planes(std::int32_t h) const {
    return has_combined() ? quadric_of_place(h, geometry(h)) : geometry(h);
  }

  Quadric<3> geometry(std::int32_t h) const {
    Quadric<3> quadric = geometry_[at(mesh_.origin[at(h)])];
    quadric += geometry_[at(mesh_.destination(h))];
    return quadric;
  }

  // From them, in square units of the input.
  double mean_squared_distance(std::int32_t h, const Vec<3>& place) const {
    const Quadric<3> quadric = planes(h);
    const double weight = quadric.trace();
    const double error = std::max(0.0, quadric.at(place));
    return weight > 0 ? error / weight * mesh_.extent * mesh_.extent : 0;
  }

  SurfaceMesh& mesh_;
  WedgeValues& values_;
  const SimplifySurfaceOptions& options_;
  SimplifySurfaceReport& report_;
  std::vector<SurfaceCollapse>* history_;
  std::unique_ptr<AttributeQuadrics> attributes_;  // null when there are none
  std::vector<Quadric<3>> geometry_;               // by vertex
  std::vector<float> queued_cost_;                 // by the larger halfedge of an edge: of its entry
  std::vector<std::uint8_t> is_refused_;           // by the larger halfedge of an edge
  std::vector<std::uint8_t> has_refused_;          // by vertex: an edge of it may be
  LinkCondition link_condition_;
  std::size_t n_triangles_;
  double n_start_ = 0;  // triangles
  double target_ = 0;   // triangles
  bool is_balanced_ = false;
  double usual_weight_ = 0;  // of the attributes
  std::uint64_t n_steps_ = 0;
  bool tries_places_ = false;
  FitSamples samples_;  // empty: no fit
  Queue queue_;
  SurfaceStar star_;
  std::vector<std::int32_t> neighbours_;
  std::vector<double> scratch_;
};

}  // namespace

SurfaceMesh simplified_mesh(const Surface& surface, const SimplifySurfaceOptions& options,
                            SimplifySurfaceReport& report, WedgeValues& values,
                            std::vector<SurfaceCollapse>* history) {
  require_sane(options);
  report = {};
  report.input_vertices = surface.position.size();
  report.input_triangles = surface.triangles.size();
  SurfaceMesh mesh = surface_mesh_of(surface, report.defects);
  if (mesh.origin.empty() && !surface.triangles.empty())
    throw InputError("no triangle is left: each has a corner twice; look at what wrote the mesh");
  report.components = count_components(mesh);
  mark_features(mesh, options, report);
  values = wedge_values(mesh, surface);
  SurfaceSimplifier(mesh, values, options, report, history).run(target_of(options, surface.triangles.size()));
  return mesh;
}

}  // namespace tinsmith
