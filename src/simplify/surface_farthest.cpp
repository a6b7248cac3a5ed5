#include "simplify/surface_farthest.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "simplify/surface_splits.hpp"
#include "simplify/surface_star.hpp"
#include "simplify/surface_walk.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr double kInfinity = std::numeric_limits<double>::infinity();

enum class PlaceKind : std::uint8_t { kSample, kTriangle, kEdge, kVertex };

// What may be the farthest: a sample from the surface; the middle of a triangle (its first halfedge) or of an edge
// (its larger halfedge), or a vertex from the input.
struct Place {
  float squared;
  PlaceKind kind;
  std::int32_t index;

  friend bool operator<(const Place& a, const Place& b) {
    return std::tie(a.squared, a.kind, a.index) < std::tie(b.squared, b.kind, b.index);
  }
};

// Of the way to where a new vertex should be: where the surface bends much, all of it would turn a triangle over.
constexpr std::array kParts{1.0, 0.5};

// A new vertex in the triangle of a halfedge, or on its edge.
struct Split {
  std::int32_t halfedge = kNone;
  bool is_on_edge = false;
};

Vec<3> mean(std::span<const Vec<3>> points) {
  Vec<3> sum{};
  for (const Vec<3>& p : points) {
    for (std::size_t i = 0; i < 3; ++i) sum[i] += p[i] / static_cast<double>(points.size());
  }
  return sum;
}

class Farthest {
 public:
  Farthest(SurfaceMesh& mesh, WedgeValues& values, const FitSamples& samples, const NearestTriangles& nearest)
      : mesh_(mesh),
        values_(values),
        samples_(samples),
        input_{samples.triangles, samples.place},
        nearest_(nearest),
        first_(mesh.origin.size() / 3, kNone),
        next_(samples.place.size(), kNone),
        of_triangle_(mesh.origin.size() / 3, 0),
        of_edge_(mesh.origin.size(), 0),
        of_vertex_(mesh.position.size(), 0) {
    std::vector<Place> places;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(samples.place.size()); ++i) {
      if (nearest.triangle[at(i)] == kNone) continue;
      link(i);
      places.push_back({nearest.squared[at(i)], PlaceKind::kSample, i});
    }
    for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
      if (mesh.origin[at(h)] != kNone && h % 3 == 0) places.push_back(place_of_triangle(h));
      if (is_edge_of_place(h)) places.push_back(place_of_edge(h));
    }
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.position.size()); ++v) {
      if (mesh.is_alive(v) && mesh.kind[at(v)] <= SurfaceVertexKind::kFeature) places.push_back(place_of_vertex(v));
    }
    queue_ = std::priority_queue<Place>({}, std::move(places));  // in linear time
  }

  std::vector<AddedVertex> bring_in(const FarthestLimits& limits) {
    constexpr std::size_t kTries = 50;  // for each: on folds much can't be brought nearer
    std::size_t n_tries = kTries * limits.n_triangles;
    std::size_t n_steps = limits.n_steps;
    n_left_ = limits.n_triangles;
    while (n_left_ >= 2 && n_tries > 0 && !queue_.empty()) {
      const Place place = queue_.top();
      queue_.pop();
      if (place.squared != known(place)) continue;  // it has changed with another
      if (place.kind == PlaceKind::kVertex && n_steps == 0) continue;
      if (place.kind == PlaceKind::kVertex) --n_steps;
      --n_tries;
      bring_in(place);
    }
    return added_;
  }

 private:
  void bring_in(const Place& place) {
    switch (place.kind) {
      case PlaceKind::kSample:
        if (!seek(place.index)) add_at_sample(place.index);
        break;
      case PlaceKind::kTriangle:
      case PlaceKind::kEdge:
        add_at_middle(place.index, place.kind == PlaceKind::kEdge);
        break;
      case PlaceKind::kVertex:
        draw_in(place.index);
        break;
    }
  }

  // ---- places

  float known(const Place& place) const {
    switch (place.kind) {
      case PlaceKind::kSample:
        return nearest_.squared[at(place.index)];
      case PlaceKind::kTriangle:
        return of_triangle_[at(place.index / 3)];
      case PlaceKind::kEdge:
        return of_edge_[at(place.index)];
      case PlaceKind::kVertex:
        return of_vertex_[at(place.index)];
    }
    return 0;
  }

  Place place_of_triangle(std::int32_t h) {
    of_triangle_[at(h / 3)] = static_cast<float>(below(middle_of(h, false), h, 0).squared);
    return {of_triangle_[at(h / 3)], PlaceKind::kTriangle, h};
  }

  Place place_of_edge(std::int32_t h) {
    of_edge_[at(h)] = static_cast<float>(below(middle_of(h, true), h, 0).squared);
    return {of_edge_[at(h)], PlaceKind::kEdge, h};
  }

  Place place_of_vertex(std::int32_t v) {
    of_vertex_[at(v)] = static_cast<float>(below(mesh_.position[at(v)], mesh_.out[at(v)], 0).squared);
    return {of_vertex_[at(v)], PlaceKind::kVertex, v};
  }

  bool is_edge_of_place(std::int32_t h) const {
    return mesh_.origin[at(h)] != kNone && h > mesh_.twin[at(h)] && may_split(h, false);
  }

  Vec<3> middle_of(std::int32_t h, bool is_of_edge) const {
    const std::array corners = corners_of(mesh_, h);
    return mean(std::span(corners).first(is_of_edge ? 2 : 3));
  }

  // ---- samples and the input

  void link(std::int32_t sample) {
    std::int32_t& first = first_[at(nearest_.triangle[at(sample)] / 3)];
    next_[at(sample)] = first;
    first = sample;
  }

  template <class F>
  void for_each_sample(std::int32_t h, F&& f) const {
    for (std::int32_t i = first_[at(h / 3)]; i != kNone; i = next_[at(i)]) f(i);
  }

  void unlink(std::int32_t sample) {
    std::int32_t* link = &first_[at(nearest_.triangle[at(sample)] / 3)];
    while (*link != sample) link = &next_[at(*link)];
    *link = next_[at(sample)];
  }

  // On thin parts a sample may have been led to the wrong side: whether it is nearer where its neighbours are.
  bool seek(std::int32_t sample) {
    const WalkedSurface surface{mesh_, mesh_.position};
    const Vec<3>& place = samples_.place[at(sample)];
    const double squared = nearest_.squared[at(sample)];
    Nearest best = nearest(surface, place, kNone, samples_.vertex[at(sample)]);
    const auto look = [&](std::int32_t neighbour) {
      if (nearest_.triangle[at(neighbour)] == kNone) return;
      const Nearest there = nearest(surface, place, nearest_.triangle[at(neighbour)], kNone);
      if (there.squared < best.squared) best = there;
    };
    const auto n_vertices = static_cast<std::int32_t>(mesh_.position.size());
    if (sample < n_vertices)
      for_each_out(samples_.triangles, sample, [&](std::int32_t h) { look(samples_.triangles.destination(h)); });
    else
      for (std::int32_t k = 0; k < 3; ++k) look(samples_.triangles.origin[at(3 * (sample - n_vertices) + k)]);
    constexpr double kNearer = 0.9;
    if (!(best.squared < kNearer * squared)) return false;
    unlink(sample);
    nearest_.triangle[at(sample)] = best.halfedge;
    nearest_.squared[at(sample)] = static_cast<float>(best.squared);
    link(sample);
    queue_.push({nearest_.squared[at(sample)], PlaceKind::kSample, sample});
    return true;
  }

  // Of those of the triangles at the edge of h, or around its origin where they have none; kNone: none either.
  std::int32_t sample_near(const Vec<3>& place, std::int32_t h) const {
    double least = kInfinity;
    std::int32_t nearest = kNone;
    const auto look = [&](std::int32_t triangle) {
      if (triangle == kNone) return;
      for_each_sample(triangle, [&](std::int32_t i) {
        const Vec<3> off = place - samples_.place[at(i)];
        const double squared = dot(off, off);
        if (!(squared < least)) return;
        least = squared;
        nearest = i;
      });
    };
    look(h);
    look(mesh_.twin[at(h)]);
    if (nearest != kNone) return nearest;
    for_each_out(mesh_, mesh_.origin[at(h)], [&](std::int32_t e) {
      look(e);
      look(mesh_.twin[at(Halfedges::next(e))]);
    });
    return nearest;
  }

  // The input's nearest point to a place at the triangle of h. From a sample there it is found on thin parts too.
  Nearest below(const Vec<3>& place, std::int32_t h, double enough) const {
    const std::int32_t start = sample_near(place, h);
    if (start == kNone) return {};
    const auto n_vertices = static_cast<std::int32_t>(mesh_.position.size());
    if (start < n_vertices) return nearest(input_, place, kNone, start, enough);
    return nearest(input_, place, 3 * (start - n_vertices), kNone, enough);
  }

  bool is_far(const Vec<3>& place, std::int32_t h, double squared) const {
    return !(below(place, h, squared).squared <= squared);
  }

  // Whether the star with its vertex at p is as far as that from a sample of its triangles, or from the input in
  // the middles of its triangles and of its inner sides.
  bool is_as_far(const Vec<3>& p, std::span<const std::int32_t> triangles, double squared) const {
    bool is = false;
    for (const std::int32_t h : triangles) {
      for_each_sample(
          h, [&](std::int32_t i) { is = is || !(squared_distance(samples_.place[at(i)], star_, p, 0) < squared); });
    }
    return is || std::any_of(star_.sides.begin(), star_.sides.end(), [&](const LinkSide& side) {
             return is_far(mean(std::array{p, side.a}), triangles[0], squared) ||
                    is_far(mean(std::array{p, side.a, side.b}), triangles[0], squared);
           });
  }

  // The samples that were on `triangles` find theirs in the star of v; what may be far there is weighed anew.
  void settle(std::int32_t v, std::span<const std::int32_t> triangles) {
    around_.clear();
    for (const std::int32_t h : triangles) {
      for_each_sample(h, [&](std::int32_t i) { around_.push_back(i); });
      first_[at(h / 3)] = kNone;
    }
    for (const std::int32_t i : around_) {
      double least = kInfinity;
      for_each_out(mesh_, v, [&](std::int32_t h) {
        const double squared = squared_distance(samples_.place[at(i)], corners_of(mesh_, h));
        if (!(squared < least)) return;
        least = squared;
        nearest_.triangle[at(i)] = h - h % 3;
      });
      nearest_.squared[at(i)] = static_cast<float>(least);
      link(i);
      queue_.push({nearest_.squared[at(i)], PlaceKind::kSample, i});
    }
    for_each_out(mesh_, v, [&](std::int32_t h) {
      queue_.push(place_of_triangle(h - h % 3));
      weigh_edge(h);
      weigh_edge(Halfedges::next(h));
    });
    queue_.push(place_of_vertex(v));
  }

  // A border edge into the vertex, which is none out of it, is on a line: it has no place.
  void weigh_edge(std::int32_t h) {
    const std::int32_t edge = std::max(h, mesh_.twin[at(h)]);
    if (is_edge_of_place(edge)) queue_.push(place_of_edge(edge));
  }

  // ---- vertices that come nearer

  // A little: the best places for the samples of round ground lie off it.
  void draw_in(std::int32_t v) {
    const Vec<3> p = mesh_.position[at(v)];
    const Nearest there = below(p, mesh_.out[at(v)], 0);
    if (there.halfedge == kNone) return;
    clear(star_);
    triangles_.clear();
    for_each_out(mesh_, v, [&](std::int32_t h) {
      add_side(mesh_, h, star_);
      triangles_.push_back(h);
    });
    for (const double part : {0.15, 0.3, 0.5, 0.05}) {
      const Vec<3> place{p[0] - part * there.off[0], p[1] - part * there.off[1], p[2] - part * there.off[2]};
      if (!is_inside_half_spaces(star_.sides, place) || turns_more(star_, place)) continue;
      if (is_as_far(place, triangles_, there.squared)) continue;
      mesh_.position[at(v)] = place;
      return settle(v, triangles_);
    }
  }

  // ---- vertices that are added

  bool may_split(std::int32_t h, bool is_line) const {
    const bool is_border = mesh_.is_border_edge(h);
    return (mesh_.is_feature[at(h)] != 0) == is_line && (is_border ? is_line : !is_seam(mesh_, h));
  }

  // The triangles that the split replaces, and the star of its vertex.
  void lay_star(const Split& split) {
    clear(star_);
    triangles_.clear();
    const std::int32_t h = split.halfedge;
    const std::int32_t g = mesh_.twin[at(h)];
    triangles_.push_back(h);
    add_side(mesh_, h, star_);
    add_side(mesh_, Halfedges::next(h), star_);
    if (!split.is_on_edge) {
      add_side(mesh_, Halfedges::previous(h), star_);
    } else if (g != kNone) {
      triangles_.push_back(g);
      add_side(mesh_, g, star_);
      add_side(mesh_, Halfedges::next(g), star_);
    }
  }

  // As for a collapse: no edge gets normals more than 90 degrees apart where there was none.
  bool is_good(const Split& split, const Vec<3>& place, double squared) {
    lay_star(split);
    if (!is_inside_half_spaces(star_.sides, place)) return false;
    if (count_turned(star_, place) > 0 && count_turned(star_) == 0) return false;
    return !is_as_far(place, triangles_, squared);
  }

  void add_at_middle(std::int32_t h, bool is_of_edge) {
    const Vec<3> middle = middle_of(h, is_of_edge);
    const Nearest there = below(middle, h, 0);
    if (there.halfedge == kNone) return;
    const Split split{h, is_of_edge};
    for (const double part : kParts) {
      const Vec<3> place = along(middle, middle - there.off, part);
      if (is_good(split, place, there.squared)) return add(split, place, gone_vertex(kNone));
    }
  }

  // In the triangle it is nearest to or on an edge of that, whichever leaves the farthest nearer. One that was on a
  // line comes to a line.
  void add_at_sample(std::int32_t i) {
    const WalkedSurface surface{mesh_, mesh_.position};
    const Vec<3> off = nearest(surface, samples_.place[at(i)], nearest_.triangle[at(i)], kNone, kInfinity).off;
    for (const double part : kParts) {
      const Vec<3> place = along(samples_.place[at(i)] - off, samples_.place[at(i)], part);
      const Split split = best_split(i, place);
      if (split.halfedge != kNone) return add(split, place, gone_vertex(i));
    }
  }

  Split best_split(std::int32_t i, const Vec<3>& place) {
    const std::int32_t first = nearest_.triangle[at(i)];
    const bool is_line = was_on_line(i);
    Split best;
    double least = nearest_.squared[at(i)];
    for (std::int32_t k = -1; k < 3; ++k) {
      const Split split{first + std::max(k, 0), k >= 0};
      if (split.is_on_edge ? !may_split(split.halfedge, is_line) : is_line) continue;
      if (!is_good(split, place, least)) continue;
      best = split;
      least = farthest_sample(place);
    }
    return best;
  }

  // From the star as it was laid.
  double farthest_sample(const Vec<3>& p) const {
    double farthest = 0;
    for (const std::int32_t h : triangles_) {
      for_each_sample(h, [&](std::int32_t i) {
        farthest = std::max(farthest, squared_distance(samples_.place[at(i)], star_, p, 0));
      });
    }
    return farthest;
  }

  // That the split is good was asked before. Nothing where there is no vertex to add.
  void add(const Split& split, const Vec<3>& place, std::int32_t v) {
    if (v == kNone) return;
    lay_star(split);
    const std::int32_t wedge = samples_.wedge[at(v)];
    set_values(split.halfedge, place, wedge);
    added_.push_back({v, below(place, split.halfedge, 0).halfedge});
    mesh_.position[at(v)] = place;
    n_left_ -= split.is_on_edge && mesh_.is_border_edge(split.halfedge) ? 1 : 2;
    gone_triangle_ = find_gone_triangle(mesh_, gone_triangle_);
    if (split.is_on_edge)
      split_edge(mesh_, split.halfedge, {v, wedge}, gone_triangle_);
    else
      split_triangle(mesh_, split.halfedge, {v, wedge}, gone_triangle_);
    settle(v, triangles_);
  }

  // Those of the triangle there.
  void set_values(std::int32_t h, const Vec<3>& place, std::int32_t wedge) {
    const std::int32_t first = h - h % 3;
    const Vec<3> share = nearest(WalkedSurface{mesh_, mesh_.position}, place, first, kNone, kInfinity).share;
    const std::span<double> now = values_.of(wedge);
    for (std::size_t c = 0; c < now.size(); ++c) {
      now[c] = 0;
      for (std::int32_t k = 0; k < 3; ++k) now[c] += share[at(k)] * values_.of(mesh_.wedge[at(first + k)])[c];
    }
  }

  bool is_gone(std::int32_t v, SurfaceVertexKind kind) const {
    return !mesh_.is_alive(v) && mesh_.kind[at(v)] == kind && samples_.wedge[at(v)] != kNone;
  }

  bool was_on_line(std::int32_t sample) const {
    return at(sample) < mesh_.position.size() && is_gone(sample, SurfaceVertexKind::kFeature);
  }

  // The sample itself, or any that was on no line; kNone: none.
  std::int32_t gone_vertex(std::int32_t sample) {
    const auto n_vertices = static_cast<std::int32_t>(mesh_.position.size());
    if (sample != kNone && sample < n_vertices &&
        (was_on_line(sample) || is_gone(sample, SurfaceVertexKind::kInterior)))
      return sample;
    while (gone_vertex_ < n_vertices && !is_gone(gone_vertex_, SurfaceVertexKind::kInterior)) ++gone_vertex_;
    return gone_vertex_ < n_vertices ? gone_vertex_ : kNone;
  }

  SurfaceMesh& mesh_;
  WedgeValues& values_;
  const FitSamples& samples_;
  const WalkedSurface input_;
  const NearestTriangles nearest_;
  std::vector<std::int32_t> first_;  // by triangle: a sample of it
  std::vector<std::int32_t> next_;   // by sample: another of its triangle
  std::vector<float> of_triangle_;   // by triangle: how far off its middle is
  std::vector<float> of_edge_;       // by larger halfedge
  std::vector<float> of_vertex_;
  std::priority_queue<Place> queue_;
  SurfaceStar star_;
  std::vector<std::int32_t> triangles_;  // of the star: a halfedge of each
  std::vector<std::int32_t> around_;
  std::vector<AddedVertex> added_;
  std::size_t n_left_ = 0;  // triangles
  std::int32_t gone_vertex_ = 0;
  std::int32_t gone_triangle_ = 0;
};

}  // namespace

// None where half of the triangles are left: the RMS distance would be 1.01 times as large. With 1 % beside values
// too, five of 63 coloured results were 1.13 to 1.23 times as far off, in the largest distance, as without colours;
// none is more than 1.07 times now. The other percent costs 0.5 % of the RMS distance.
double n_kept_back(double n_triangles, double target, bool is_drawn_by_values) {
  const double most = is_drawn_by_values ? 0.02 : 0.01;
  constexpr double kFullUpTo = 0.25;  // of the triangles
  constexpr double kNoneFrom = 0.5;
  if (!(target > 0)) return 0;
  const double ratio = target / n_triangles;
  const double share = most * std::clamp((kNoneFrom - ratio) / (kNoneFrom - kFullUpTo), 0.0, 1.0);
  return std::round(share * target / 2);
}

std::vector<AddedVertex> bring_in_farthest(SurfaceMesh& mesh, WedgeValues& values, const FitSamples& samples,
                                           const NearestTriangles& nearest, const FarthestLimits& limits) {
  if (limits.n_triangles < 2) return {};
  return Farthest(mesh, values, samples, nearest).bring_in(limits);
}

}  // namespace tinsmith
