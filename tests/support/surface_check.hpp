#pragma once
// Judges a mesh against its samples by brute force. Shares plain data types with src, and no code: every
// test of position is an integer edge test of its own, over all samples of a triangle's bounding box.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <vector>

#include "mesh/terrain_mesh.hpp"
#include "mesh/window_mesh.hpp"
#include "samples/height_grid.hpp"
#include "tile/chunk.hpp"

namespace tinsmith::test {

/// Any mesh as plain triangles.
struct Soup {
  std::vector<LatticePoint> position;
  std::vector<double> height;
  std::vector<std::array<std::size_t, 3>> triangles;
};

template <class Triangles>
Soup make_soup(std::vector<LatticePoint> position, std::vector<double> height, const Triangles& triangles) {
  Soup soup{std::move(position), std::move(height), {}};
  for (const auto& [a, b, c] : triangles)
    soup.triangles.push_back(
        {static_cast<std::size_t>(a), static_cast<std::size_t>(b), static_cast<std::size_t>(c)});
  return soup;
}

inline Soup soup_of(const TerrainMesh& mesh) { return make_soup(mesh.position, mesh.height, mesh.triangles); }
inline Soup soup_of(const Chunk& chunk) { return make_soup(chunk.position, chunk.height, chunk.triangles); }

/// Removed triangles left out.
inline Soup soup_of(const WindowMesh& mesh) {
  std::vector<std::array<std::int32_t, 3>> live;
  for (std::size_t h = 0; h < mesh.origin.size(); h += 3) {
    if (mesh.origin[h] >= 0) live.push_back({mesh.origin[h], mesh.origin[h + 1], mesh.origin[h + 2]});
  }
  return make_soup(mesh.position, mesh.height, live);
}

/// What the brute force found. "Cell" is a valid 2 x 2 block of samples within the judged rectangle.
struct SurfaceCheck {
  std::uint64_t samples = 0;     // corners of cells
  std::uint64_t cells = 0;       // valid ones
  std::uint64_t uncovered = 0;   // samples and centres of cells that lie in no triangle
  std::uint64_t overlapped = 0;  // samples and centres strictly inside more than one triangle
  std::uint64_t over_void = 0;   // centres of invalid cells in a triangle
  double max_error = 0;          // largest |z_TIN - z_sample|
  std::int32_t worst_x = 0;      // where
  std::int32_t worst_y = 0;
  std::int64_t area2 = 0;                   // twice the area in lattice units, exact
  std::int64_t cells_area2 = 0;             // the same of the cells
  std::uint64_t folded = 0;                 // triangles whose area is not positive
  std::uint64_t non_manifold_edges = 0;     // run twice in one direction, by place
  std::uint64_t non_manifold_vertices = 0;  // whose link is neither one path nor one circle, by index
  std::uint64_t stray_border_edges = 0;     // with one triangle, but not on the rim of the cells: cracks
  std::uint64_t components = 0;             // of triangles, across edges
  std::uint64_t cell_components = 0;        // of cells, across sides
};

/// Empty when the mesh is a surface over exactly the cells, within the tolerance; else all that is wrong.
inline std::string complaints(const SurfaceCheck& c, double tolerance) {
  std::string text;
  const auto none = [&](std::uint64_t n, const char* what) {
    if (n != 0) text += fmt::format("{} {}; ", n, what);
  };
  none(c.uncovered, "places uncovered");
  none(c.overlapped, "places covered twice");
  none(c.over_void, "void cells covered");
  none(c.folded, "triangles folded");
  none(c.non_manifold_edges, "edges not manifold");
  none(c.non_manifold_vertices, "vertices not manifold");
  none(c.stray_border_edges, "border edges off the outline");
  if (c.area2 != c.cells_area2) text += fmt::format("area {} instead of {}; ", c.area2, c.cells_area2);
  if (c.components != c.cell_components)
    text += fmt::format("{} components instead of {}; ", c.components, c.cell_components);
  if (!(c.max_error <= tolerance))
    text += fmt::format("error {} at ({}, {}), tolerance {}; ", c.max_error, c.worst_x, c.worst_y, tolerance);
  return text;
}

namespace detail {

inline std::int64_t edge_test(LatticePoint a, LatticePoint b, LatticePoint p) {
  return (std::int64_t{b.x} - a.x) * (std::int64_t{p.y} - a.y) -
         (std::int64_t{b.y} - a.y) * (std::int64_t{p.x} - a.x);
}

class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), std::size_t{0}); }
  std::size_t find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::size_t i, std::size_t j) { parent_[find(i)] = find(j); }

 private:
  std::vector<std::size_t> parent_;
};

// Counts for each place of a rectangle how many triangles it lies in.
struct Cover {
  GridRect rect;  // of samples, or of cells
  std::int32_t offset = 0;
  std::vector<std::uint16_t> in_or_on, inside;

  Cover(const GridRect& r, std::int32_t o) : rect(r), offset(o), in_or_on(size(), 0), inside(size(), 0) {}
  std::size_t size() const { return rect.width > 0 && rect.height > 0 ? static_cast<std::size_t>(rect.area()) : 0; }
  std::size_t index(std::int32_t x, std::int32_t y) const {
    return static_cast<std::size_t>(std::int64_t{y - rect.y0} * rect.width + (x - rect.x0));
  }

  // Calls f(x, y, weights) for each place in the triangle, the weights being twice the areas opposite to a, b, c.
  template <class F>
  void add(LatticePoint a, LatticePoint b, LatticePoint c, F&& f) {
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    const std::int32_t x1 = std::min(high_x / kLatticePerCell, rect.x0 + rect.width - 1);
    const std::int32_t y1 = std::min(high_y / kLatticePerCell, rect.y0 + rect.height - 1);
    for (std::int32_t y = std::max(low_y / kLatticePerCell, rect.y0); y <= y1; ++y) {
      for (std::int32_t x = std::max(low_x / kLatticePerCell, rect.x0); x <= x1; ++x) {
        const LatticePoint p{x * kLatticePerCell + offset, y * kLatticePerCell + offset};
        const std::array<std::int64_t, 3> w{edge_test(b, c, p), edge_test(c, a, p), edge_test(a, b, p)};
        if (w[0] < 0 || w[1] < 0 || w[2] < 0) continue;
        ++in_or_on[index(x, y)];
        if (w[0] > 0 && w[1] > 0 && w[2] > 0) ++inside[index(x, y)];
        f(x, y, w);
      }
    }
  }
};

class Judge {
 public:
  Judge(const Soup& soup, const HeightGrid& samples, const GridRect& rect)
      : soup_(soup), samples_(samples), rect_(rect) {}

  SurfaceCheck run() {
    measure_cover();
    weld_places();
    measure_edges();
    measure_fans();
    count_cell_components();
    return result_;
  }

 private:
  bool is_cell(std::int32_t x, std::int32_t y) const {
    if (x < rect_.x0 || y < rect_.y0 || x >= rect_.x0 + rect_.width - 1 || y >= rect_.y0 + rect_.height - 1)
      return false;
    return !std::isnan(samples_.at(x, y)) && !std::isnan(samples_.at(x + 1, y)) &&
           !std::isnan(samples_.at(x, y + 1)) && !std::isnan(samples_.at(x + 1, y + 1));
  }

  void measure_cover() {
    Cover at_samples(rect_, 0);
    Cover at_centres({rect_.x0, rect_.y0, rect_.width - 1, rect_.height - 1}, kLatticePerCell / 2);
    for (const auto& [a, b, c] : soup_.triangles) {
      const std::array<LatticePoint, 3> p{soup_.position[a], soup_.position[b], soup_.position[c]};
      const std::int64_t area2 = edge_test(p[0], p[1], p[2]);
      result_.area2 += area2;
      if (area2 <= 0) ++result_.folded;
      if (area2 <= 0) continue;
      const std::array<double, 3> z{soup_.height[a], soup_.height[b], soup_.height[c]};
      at_samples.add(p[0], p[1], p[2], [&](std::int32_t x, std::int32_t y, const std::array<std::int64_t, 3>& w) {
        note_error(x, y, w, z, area2);
      });
      at_centres.add(p[0], p[1], p[2], [](auto&&...) {});
    }
    judge_cover(at_samples, at_centres);
  }

  void note_error(std::int32_t x, std::int32_t y, const std::array<std::int64_t, 3>& w,
                  const std::array<double, 3>& z, std::int64_t area2) {
    const double sample = samples_.at(x, y);
    if (std::isnan(sample)) return;
    long double error = 0;
    for (std::size_t k = 0; k < 3; ++k)
      error += static_cast<long double>(w[k]) * (static_cast<long double>(z[k]) - static_cast<long double>(sample));
    const auto off = static_cast<double>(std::abs(error / static_cast<long double>(area2)));
    if (!(off > result_.max_error)) return;
    result_.max_error = off;
    result_.worst_x = x;
    result_.worst_y = y;
  }

  void judge_cover(const Cover& at_samples, const Cover& at_centres) {
    for (std::int32_t y = rect_.y0; y < rect_.y0 + rect_.height; ++y) {
      for (std::int32_t x = rect_.x0; x < rect_.x0 + rect_.width; ++x) {
        const std::size_t i = at_samples.index(x, y);
        const bool is_corner = is_cell(x, y) || is_cell(x - 1, y) || is_cell(x, y - 1) || is_cell(x - 1, y - 1);
        if (is_corner) ++result_.samples;
        if (is_corner && at_samples.in_or_on[i] == 0) ++result_.uncovered;
        if (at_samples.inside[i] > 1) ++result_.overlapped;
        if (x == rect_.x0 + rect_.width - 1 || y == rect_.y0 + rect_.height - 1) continue;
        const std::size_t j = at_centres.index(x, y);
        if (at_centres.inside[j] > 1) ++result_.overlapped;
        if (is_cell(x, y)) {
          ++result_.cells;
          if (at_centres.in_or_on[j] == 0) ++result_.uncovered;
        } else if (at_centres.in_or_on[j] != 0) {
          ++result_.over_void;
        }
      }
    }
    result_.cells_area2 = static_cast<std::int64_t>(result_.cells) * 2 * kLatticePerCell * kLatticePerCell;
  }

  void weld_places() {
    std::vector<LatticePoint> places = soup_.position;
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const LatticePoint p : soup_.position)
      place_.push_back(
          static_cast<std::size_t>(std::lower_bound(places.begin(), places.end(), p) - places.begin()));
  }

  struct Edge {
    std::size_t from, to, triangle, k;
    bool operator<(const Edge& e) const { return std::pair(from, to) < std::pair(e.from, e.to); }
    bool same(const Edge& e) const { return from == e.from && to == e.to; }
  };

  void measure_edges() {
    std::vector<Edge> edges;
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) {
      for (std::size_t k = 0; k < 3; ++k)
        edges.push_back({place_[soup_.triangles[t][k]], place_[soup_.triangles[t][(k + 1) % 3]], t, k});
    }
    std::sort(edges.begin(), edges.end());
    Sets sets(soup_.triangles.size());
    for (std::size_t i = 0; i < edges.size(); ++i) {
      if (i > 0 && edges[i].same(edges[i - 1])) ++result_.non_manifold_edges;
      const Edge back{edges[i].to, edges[i].from, 0, 0};
      const auto other = std::lower_bound(edges.begin(), edges.end(), back);
      if (other != edges.end() && other->same(back)) {
        sets.unite(edges[i].triangle, other->triangle);
      } else if (!is_on_rim(soup_.position[soup_.triangles[edges[i].triangle][edges[i].k]],
                            soup_.position[soup_.triangles[edges[i].triangle][(edges[i].k + 1) % 3]])) {
        ++result_.stray_border_edges;
      }
    }
    for (std::size_t t = 0; t < soup_.triangles.size(); ++t) result_.components += sets.find(t) == t ? 1 : 0;
  }

  // Cells on the left of a -> b, none on its right, all along. The triangle lies on the left: for an edge towards
  // larger x that is the side of larger y, for one towards larger y that of smaller x.
  bool is_on_rim(LatticePoint a, LatticePoint b) const {
    const bool is_row = a.y == b.y;
    const std::int32_t across = is_row ? a.y : a.x;
    if ((!is_row && a.x != b.x) || across % kLatticePerCell != 0) return false;
    const std::int32_t from = is_row ? a.x : a.y;
    const std::int32_t to = is_row ? b.x : b.y;
    const std::int32_t line = across / kLatticePerCell;
    const bool larger_is_left = is_row ? to > from : to < from;
    const std::int32_t first = std::min(from, to) / kLatticePerCell;
    const std::int32_t last = (std::max(from, to) - 1) / kLatticePerCell;
    for (std::int32_t i = first; i <= last; ++i) {
      const bool larger = is_row ? is_cell(i, line) : is_cell(line, i);
      const bool smaller = is_row ? is_cell(i, line - 1) : is_cell(line - 1, i);
      if ((larger_is_left ? larger : smaller) != true || (larger_is_left ? smaller : larger) != false) return false;
    }
    return true;
  }

  // The link of a vertex as steps from one neighbour to the next: a single path or circle.
  void measure_fans() {
    std::vector<std::vector<std::array<std::size_t, 2>>> link(soup_.position.size());
    for (const auto& t : soup_.triangles) {
      for (std::size_t k = 0; k < 3; ++k) link[t[k]].push_back({t[(k + 1) % 3], t[(k + 2) % 3]});
    }
    for (const auto& steps : link) {
      if (!is_single_chain(steps)) ++result_.non_manifold_vertices;
    }
  }

  static bool is_single_chain(const std::vector<std::array<std::size_t, 2>>& steps) {
    Sets sets(steps.size());
    std::size_t joined = 0;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      for (std::size_t j = 0; j < steps.size(); ++j) {
        if (i != j && steps[i][0] == steps[j][0]) return false;
        if (i == j || steps[i][1] != steps[j][0] || sets.find(i) == sets.find(j)) continue;
        sets.unite(i, j);
        ++joined;
      }
    }
    return steps.empty() || joined + 1 == steps.size();
  }

  void count_cell_components() {
    const GridRect cells{rect_.x0, rect_.y0, std::max(0, rect_.width - 1), std::max(0, rect_.height - 1)};
    Sets sets(static_cast<std::size_t>(cells.area()));
    const auto index = [&](std::int32_t x, std::int32_t y) {
      return static_cast<std::size_t>(std::int64_t{y - cells.y0} * cells.width + (x - cells.x0));
    };
    const auto each = [&](auto&& f) {
      for (std::int32_t y = cells.y0; y < cells.y0 + cells.height; ++y) {
        for (std::int32_t x = cells.x0; x < cells.x0 + cells.width; ++x) {
          if (is_cell(x, y)) f(x, y);
        }
      }
    };
    each([&](std::int32_t x, std::int32_t y) {
      if (is_cell(x - 1, y)) sets.unite(index(x, y), index(x - 1, y));
      if (is_cell(x, y - 1)) sets.unite(index(x, y), index(x, y - 1));
    });
    each([&](std::int32_t x, std::int32_t y) {
      result_.cell_components += sets.find(index(x, y)) == index(x, y) ? 1 : 0;
    });
  }

  const Soup& soup_;
  const HeightGrid& samples_;
  GridRect rect_;
  std::vector<std::size_t> place_;  // by vertex: equal for vertices at one place
  SurfaceCheck result_;
};

}  // namespace detail

/// Judges the mesh against the cells of a rectangle of samples. Coordinates must not be negative.
template <class Mesh>
SurfaceCheck check_surface(const Mesh& mesh, const HeightGrid& samples, const GridRect& rect) {
  const Soup soup = soup_of(mesh);
  return detail::Judge(soup, samples, rect).run();
}

/// The same over all samples.
template <class Mesh>
SurfaceCheck check_surface(const Mesh& mesh, const HeightGrid& samples) {
  return check_surface(mesh, samples, samples.rect);
}

}  // namespace tinsmith::test
