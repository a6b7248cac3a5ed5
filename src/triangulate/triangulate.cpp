#include "triangulate/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "samples/triangle_error.hpp"
#include "triangulate/outline.hpp"
#include "triangulate/select.hpp"

namespace tinsmith {

namespace {

// The hierarchy selects for a far coarser surface than asked for: it knows its own places only, and inserting what
// the triangulation leaves outside the tolerance finds the samples with fewer of them. At 10 m on the sample
// terrain it starts from 663 000 triangles at 4 times the tolerance, 624 000 at 32 times. The result stays as it
// is.
constexpr double kSelectFactor = 32;
// What is so many times as far off as the tolerance allows is inserted first, and mends much of the rest: 606 000.
constexpr std::array kInsertFactors{2.0, 1.0};
// A seam is thinned for good until it dissolves, and what it lost its neighbourhood has to make up for: on the
// sample terrain, eight tolerances from 8 to 40 m, windows of 512 and 256, there are 1.048 and 1.034 times as many
// vertices near former seams as with one window at 0.4 of the tolerance, 1.018 and 1.036 at 0.3, 1.020 and 1.029 at
// 0.25. That takes up to 3 % more time than 0.4.
constexpr double kSeamFactor = 0.3;
// Larger windows are triangulated in parts of at most so many cells a side: the triangulation takes 94 bytes a
// triangle as long as it stands.
constexpr std::int32_t kPartCells = 96;

struct FaceMark {
  std::int32_t pass = 0;  // the one that listed it last
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<LatticePoint, Kernel>;  // its sample
template <class Base>
using Structure =
    CGAL::Triangulation_data_structure_2<VertexBase,
                                         CGAL::Triangulation_face_base_with_info_2<FaceMark, Kernel, Base>>;

// A full window's outline is its convex hull. Without constraints a run on the sample terrain is 3 % shorter.
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, Structure<CGAL::Triangulation_face_base_2<Kernel>>>;
using ConstrainedDelaunay = CGAL::Constrained_Delaunay_triangulation_2<
    Kernel, Structure<CGAL::Constrained_triangulation_face_base_2<Kernel>>, CGAL::No_constraint_intersection_tag>;

std::size_t index(const GridRect& window, LatticePoint sample) {
  return static_cast<std::size_t>(static_cast<std::int64_t>(sample.y - window.y0) * window.width +
                                  (sample.x - window.x0));
}

// Along a Z-shaped curve (Morton 1966): quarter by quarter of a square.
template <class F>
void for_each_along_curve(const GridRect& window, LatticePoint corner, std::int32_t side, F& f) {
  if (corner.x >= window.x0 + window.width || corner.y >= window.y0 + window.height) return;
  if (side == 1) {
    f(corner);
    return;
  }
  const std::int32_t half = side / 2;
  for (const std::int32_t y : {corner.y, corner.y + half}) {
    for (const std::int32_t x : {corner.x, corner.x + half}) for_each_along_curve(window, {x, y}, half, f);
  }
}

template <class F>
void for_each_along_curve(const GridRect& window, F&& f) {
  std::int32_t side = 1;
  while (side < std::max(window.width, window.height)) side *= 2;
  for_each_along_curve(window, {window.x0, window.y0}, side, f);
}

std::vector<LatticePoint> selected_on(const OutlinePiece& piece, Selection& selection) {
  std::vector<LatticePoint> line;
  for (std::int32_t y = piece.a.y; y <= piece.b.y; ++y) {
    for (std::int32_t x = piece.a.x; x <= piece.b.x; ++x) {
      if (selection.at(x, y)) line.push_back({x, y});
    }
  }
  return line;
}

template <class Triangulation>
class PartTriangulation {
  static constexpr bool kIsFull = std::is_same_v<Triangulation, Delaunay>;
  using Face = typename Triangulation::Face_handle;
  using Vertex = typename Triangulation::Vertex_handle;

 public:
  PartTriangulation(const HeightGrid& samples, const GridRect& part, const TriangulateOptions& options)
      : samples_(samples), part_(part), options_(options), aspect_(exact_aspect(options.aspect)) {}

  // Neighbours after each other: each is sought from the one before.
  void insert_all(const std::vector<LatticePoint>& selected) {
    Face hint;
    for (const LatticePoint p : selected) hint = insert(p, hint)->face();
  }

  void constrain(const std::vector<OutlinePiece>& outline, Selection& selection) {
    std::vector<Vertex> at_sample(static_cast<std::size_t>(part_.area()), nullptr);
    for (auto v = triangulation_.finite_vertices_begin(); v != triangulation_.finite_vertices_end(); ++v)
      at_sample[index(part_, v->info())] = v;
    for (const OutlinePiece& piece : outline) {
      const std::vector<LatticePoint> line = selected_on(piece, selection);
      for (std::size_t i = 1; i < line.size(); ++i)
        triangulation_.insert_constraint(at_sample[index(part_, line[i - 1])], at_sample[index(part_, line[i])]);
    }
  }

  // Inserts the worst sample of triangles that are outside the tolerance, until none is.
  void insert_violations() {
    std::vector<Violation> waiting;
    for (auto f = triangulation_.finite_faces_begin(); f != triangulation_.finite_faces_end(); ++f)
      find_violation(f, waiting);
    for (const double factor : kInsertFactors) {
      const double limit = factor * options_.tolerance;
      for (auto worst = take_above(limit, waiting); !worst.empty(); worst = take_above(limit, waiting)) {
        for (const Face f : insert_worst(worst)) find_violation(f, waiting);
      }
    }
  }

  // Calls f with the three samples of each triangle.
  template <class F>
  void for_each_triangle(F&& f) const {
    for (auto t = triangulation_.finite_faces_begin(); t != triangulation_.finite_faces_end(); ++t) {
      if (is_inside(t)) f(t->vertex(0)->info(), t->vertex(1)->info(), t->vertex(2)->info());
    }
  }

 private:
  struct Violation {
    LatticePoint sample;
    std::array<Vertex, 3> corners;
    double error;
  };

  static std::vector<Violation> take_above(double limit, std::vector<Violation>& waiting) {
    const auto above = std::stable_partition(waiting.begin(), waiting.end(),
                                             [&](const Violation& v) { return !(v.error > limit); });
    std::vector<Violation> taken(above, waiting.end());
    waiting.erase(above, waiting.end());
    return taken;
  }

  // Few bits, so that row * aspect is exact: points in line on the grid are in line for CGAL too, else it would
  // make triangles of them that have no area.
  static double exact_aspect(double aspect) {
    constexpr double kSteps = 256;
    return std::clamp(std::round(aspect * kSteps), 1.0, kSteps * kSteps) / kSteps;
  }

  Kernel::Point_2 plan(LatticePoint p) const {
    return {static_cast<double>(p.x - part_.x0), (p.y - part_.y0) * aspect_};
  }
  Vertex insert(LatticePoint sample, Face hint) {
    const Vertex v = triangulation_.insert(plan(sample), hint);
    v->info() = sample;
    return v;
  }

  // The outline is constrained, so a triangle lies in valid cells wholly or not at all, and the cell of its
  // centroid tells.
  bool is_inside(Face f) const {
    if constexpr (kIsFull) return true;
    const LatticePoint a = f->vertex(0)->info();
    const LatticePoint b = f->vertex(1)->info();
    const LatticePoint c = f->vertex(2)->info();
    const auto third = [](std::int32_t sum) { return static_cast<std::int32_t>(std::floor(sum / 3.0)); };
    return samples_.is_valid_cell(third(a.x + b.x + c.x), third(a.y + b.y + c.y));
  }

  // What lies in a triangle that has changed meanwhile is left out: that triangle was measured anew, or will be.
  // Inserting all of them made a fifth more triangles. Returns the triangles that are new.
  std::vector<Face> insert_worst(const std::vector<Violation>& violations) {
    ++pass_;
    inserted_.clear();
    for (const Violation& violation : violations) {
      const auto& [a, b, c] = violation.corners;
      Face f;
      if (triangulation_.is_face(a, b, c, f)) inserted_.push_back(insert(violation.sample, f));
    }
    std::vector<Face> changed;
    for (const Vertex v : inserted_) {
      auto f = triangulation_.incident_faces(v);
      const auto first = f;
      do {
        if (triangulation_.is_infinite(f) || f->info().pass == pass_) continue;
        f->info().pass = pass_;
        changed.push_back(f);
      } while (++f != first);
    }
    return changed;
  }

  void find_violation(Face f, std::vector<Violation>& found) const {
    const std::array<Vertex, 3> corners{f->vertex(0), f->vertex(1), f->vertex(2)};
    // Half a cell holds no sample but its corners.
    if (orient(corners[0]->info(), corners[1]->info(), corners[2]->info()) == 1 || !is_inside(f)) return;
    const auto corner = [&](Vertex v) {
      const LatticePoint p = v->info();
      return Corner{{p.x * kLatticePerCell, p.y * kLatticePerCell}, samples_.at(p.x, p.y)};
    };
    const TriangleError error =
        triangle_error(samples_, corner(corners[0]), corner(corners[1]), corner(corners[2]));
    if (!(error.largest > options_.tolerance)) return;
    // The plane meets its own corners but for the rounding, which inserting them again would not mend.
    const bool is_corner =
        std::any_of(corners.begin(), corners.end(), [&](Vertex v) { return v->info() == error.worst; });
    if (!is_corner) found.push_back({error.worst, corners, error.largest});
  }

  const HeightGrid& samples_;
  GridRect part_;
  TriangulateOptions options_;
  double aspect_;
  Triangulation triangulation_;
  std::int32_t pass_ = 0;
  std::vector<Vertex> inserted_;  // in this pass
};

// The line's inside is decided by its own samples alone, whatever the hierarchy wanted there.
void select_outline(const HeightGrid& samples, double tolerance, const std::vector<OutlinePiece>& outline,
                    Selection& selection) {
  for (const auto& [a, b] : outline) {
    for (std::int32_t y = a.y; y <= b.y; ++y) {
      for (std::int32_t x = a.x; x <= b.x; ++x) selection.at(x, y) = 0;
    }
  }
  for (const auto& [a, b] : outline) select_on_line(samples, tolerance, a, b, selection);
}

std::vector<LatticePoint> selected_points(Selection& selection) {
  std::vector<LatticePoint> points;
  for_each_along_curve(selection.window, [&](LatticePoint p) {
    if (selection.at(p.x, p.y)) points.push_back(p);
  });
  return points;
}

using Triangles = std::vector<std::array<std::int32_t, 3>>;

template <class Triangulation>
void add_part(const HeightGrid& samples, const GridRect& part, const TriangulateOptions& options,
              const GridRect& window, Triangles& triangles) {
  const std::vector<OutlinePiece> outline = outline_of(samples, part);
  if (outline.empty()) return;
  Selection selection{part, std::vector<std::uint8_t>(static_cast<std::size_t>(part.area()), 0)};
  select_samples(samples, kSelectFactor * options.tolerance, selection);
  select_outline(samples, kSeamFactor * options.tolerance, outline, selection);
  PartTriangulation<Triangulation> triangulation(samples, part, options);
  triangulation.insert_all(selected_points(selection));
  if constexpr (std::is_same_v<Triangulation, ConstrainedDelaunay>) triangulation.constrain(outline, selection);
  triangulation.insert_violations();
  const auto name = [&](LatticePoint sample) { return static_cast<std::int32_t>(index(window, sample)); };
  triangulation.for_each_triangle([&](LatticePoint a, LatticePoint b, LatticePoint c) {
    triangles.push_back({name(a), name(b), name(c)});
  });
}

// Calls f with rects of about equal size that share borders.
template <class F>
void for_each_part(const GridRect& window, F&& f) {
  const auto n_parts = [](std::int32_t n_samples) { return std::max(1, (n_samples - 2) / kPartCells + 1); };
  const std::int32_t nx = n_parts(window.width);
  const std::int32_t ny = n_parts(window.height);
  const auto cut = [](std::int32_t n_samples, std::int32_t i, std::int32_t n) {
    return static_cast<std::int32_t>(static_cast<std::int64_t>(n_samples - 1) * i / n);
  };
  for (std::int32_t j = 0; j < ny; ++j) {
    for (std::int32_t i = 0; i < nx; ++i) {
      const std::int32_t x = cut(window.width, i, nx);
      const std::int32_t y = cut(window.height, j, ny);
      f({window.x0 + x, window.y0 + y, cut(window.width, i + 1, nx) - x + 1,
         cut(window.height, j + 1, ny) - y + 1});
    }
  }
}

// Vertices are renamed to come along a space-filling curve, and triangles are sorted by them: what lies together in
// plan lies together in memory, which makes simplification a third faster. Returns the samples.
std::vector<LatticePoint> sort_along_curve(const GridRect& window, Triangles& triangles) {
  std::vector<std::int32_t> name(static_cast<std::size_t>(window.area()), kNone);
  constexpr std::int32_t kUsed = 0;
  for (const auto& t : triangles) {
    for (const std::int32_t v : t) name[static_cast<std::size_t>(v)] = kUsed;
  }
  std::vector<LatticePoint> vertices;
  for_each_along_curve(window, [&](LatticePoint p) {
    std::int32_t& there = name[index(window, p)];
    if (there == kNone) return;
    there = static_cast<std::int32_t>(vertices.size());
    vertices.push_back(p);
  });
  std::vector<std::size_t> next(vertices.size() + 1, 0);
  for (auto& t : triangles) {
    for (std::int32_t& v : t) v = name[static_cast<std::size_t>(v)];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    ++next[static_cast<std::size_t>(t[0]) + 1];
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) next[v + 1] += next[v];
  Triangles sorted(triangles.size());
  for (const auto& t : triangles) sorted[next[static_cast<std::size_t>(t[0])]++] = t;
  triangles = std::move(sorted);
  return vertices;
}

}  // namespace

WindowMesh triangulate(const HeightGrid& samples, const GridRect& window, const TriangulateOptions& options) {
  Triangles triangles;
  for_each_part(window, [&](const GridRect& part) {
    if (is_full(samples, part)) {
      add_part<Delaunay>(samples, part, options, window, triangles);
    } else {
      add_part<ConstrainedDelaunay>(samples, part, options, window, triangles);
    }
  });
  const std::vector<LatticePoint> vertices = sort_along_curve(window, triangles);
  WindowMesh mesh;
  mesh.position.reserve(vertices.size());
  mesh.height.reserve(vertices.size());
  for (const LatticePoint p : vertices) {
    mesh.position.push_back({p.x * kLatticePerCell, p.y * kLatticePerCell});
    mesh.height.push_back(samples.at(p.x, p.y));
  }
  mesh.is_settled.assign(mesh.position.size(), 0);
  connect(mesh, triangles);
  return mesh;
}

}  // namespace tinsmith
