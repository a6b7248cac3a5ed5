#include "triangulate/triangulate.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>

#include "samples/triangle_error.hpp"
#include "triangulate/outline.hpp"
#include "triangulate/select.hpp"

namespace tinsmith {

namespace {

// The hierarchy selects for a coarser surface than asked for, since inserting what the triangulation then leaves
// outside the tolerance finds the samples with fewer of them: at 10 m on the sample terrain it starts from
// 1 105 000 triangles at 0.75 of the tolerance, 767 000 at 2.5 times, and ends with 217 621 and 218 519.
constexpr double kSelectFactor = 4;
// A seam is thinned for good until it dissolves, and what it lost its neighbourhood has to make up for: at 20 m on
// the sample terrain, windows of 64, 128, 256 and 512, there are 1.043, 1.042, 1.045 and 1.063 times as many
// vertices near former seams as with one window at 0.5 of the tolerance, 1.038, 1.031, 1.019 and 1.042 at 0.4, no
// fewer at 0.3.
constexpr double kSeamFactor = 0.4;

struct FaceMark {
  std::array<std::int32_t, 3> listed{kNone, kNone, kNone};  // the vertices that it had when it was listed
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
using FaceBase = CGAL::Triangulation_face_base_with_info_2<FaceMark, Kernel,
                                                           CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Cdt = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::No_constraint_intersection_tag>;

class WindowTriangulation {
 public:
  WindowTriangulation(const HeightGrid& samples, const GridRect& window, const TriangulateOptions& options)
      : samples_(samples), window_(window), options_(options), aspect_(exact_aspect(options.aspect)) {}

  // Neighbours after each other: each is sought from the one before.
  void insert_all(const std::vector<LatticePoint>& selected) {
    Cdt::Face_handle hint;
    for (const LatticePoint p : selected) {
      const Cdt::Vertex_handle v = cdt_.insert(plan(p), hint);
      name(v, p);
      hint = v->face();
    }
  }

  void constrain(const std::vector<LatticePoint>& line) {
    for (std::size_t i = 1; i < line.size(); ++i)
      cdt_.insert_constraint(vertex_at(line[i - 1]), vertex_at(line[i]));
  }

  void prepare_lookup() {
    handle_.assign(static_cast<std::size_t>(window_.area()), nullptr);
    for (auto v = cdt_.finite_vertices_begin(); v != cdt_.finite_vertices_end(); ++v) {
      handle_[index(position_[static_cast<std::size_t>(v->info())])] = v;
    }
  }

  // Inserts the worst sample of triangles that are outside the tolerance, until none is.
  void insert_violations() {
    std::vector<Cdt::Face_handle> faces;
    for (auto f = cdt_.finite_faces_begin(); f != cdt_.finite_faces_end(); ++f) faces.push_back(f);
    while (!faces.empty()) {
      std::vector<Violation> found;
      for (const Cdt::Face_handle f : faces) find_violation(f, found);
      faces = insert_worst(found);
    }
  }

  WindowMesh mesh() {
    std::vector<std::array<std::int32_t, 3>> triangles;
    for (auto f = cdt_.finite_faces_begin(); f != cdt_.finite_faces_end(); ++f) {
      if (is_inside(f)) triangles.push_back(names(f));
    }
    return with_used_vertices(triangles);
  }

 private:
  struct Violation {
    using Corners = std::array<Cdt::Vertex_handle, 3>;
    LatticePoint sample;
    Corners corners;
  };

  // Few bits, so that row * aspect is exact: points in line on the grid are in line for CGAL too, else it would
  // make triangles of them that have no area.
  static double exact_aspect(double aspect) {
    constexpr double kSteps = 256;
    return std::clamp(std::round(aspect * kSteps), 1.0, kSteps * kSteps) / kSteps;
  }

  Kernel::Point_2 plan(LatticePoint p) const {
    return {static_cast<double>(p.x - window_.x0), (p.y - window_.y0) * aspect_};
  }
  std::size_t index(LatticePoint p) const {
    return static_cast<std::size_t>(static_cast<std::int64_t>(p.y - window_.y0) * window_.width +
                                    (p.x - window_.x0));
  }
  Cdt::Vertex_handle vertex_at(LatticePoint p) const { return handle_[index(p)]; }

  void name(Cdt::Vertex_handle v, LatticePoint sample) {
    v->info() = static_cast<std::int32_t>(position_.size());
    position_.push_back(sample);
  }

  static std::array<std::int32_t, 3> names(Cdt::Face_handle f) {
    return {f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()};
  }
  LatticePoint sample(std::int32_t i) const { return position_[static_cast<std::size_t>(i)]; }

  // The outline is constrained, so a triangle lies in valid cells wholly or not at all, and the cell of its
  // centroid tells.
  bool is_inside(Cdt::Face_handle f) const {
    const auto [i, j, k] = names(f);
    const auto third = [](std::int32_t sum) { return static_cast<std::int32_t>(std::floor(sum / 3.0)); };
    const std::int32_t x = third(sample(i).x + sample(j).x + sample(k).x);
    const std::int32_t y = third(sample(i).y + sample(j).y + sample(k).y);
    return samples_.is_valid_cell(x, y);
  }

  // What lies in a triangle that has changed meanwhile waits until that has been measured.
  // Inserting all of them made a fifth more triangles.
  std::vector<Cdt::Face_handle> insert_worst(const std::vector<Violation>& violations) {
    std::vector<Cdt::Vertex_handle> inserted;
    for (const auto& [sample, corners] : violations) {
      Cdt::Face_handle f;
      if (!cdt_.is_face(corners[0], corners[1], corners[2], f)) continue;
      inserted.push_back(cdt_.insert(plan(sample), f));
      name(inserted.back(), sample);
    }
    std::vector<Cdt::Face_handle> changed;
    for (const Cdt::Vertex_handle v : inserted) {
      auto f = cdt_.incident_faces(v);
      const auto first = f;
      do {
        if (cdt_.is_infinite(f)) continue;
        const std::array<std::int32_t, 3> now = names(f);
        if (f->info().listed == now) continue;
        f->info().listed = now;
        changed.push_back(f);
      } while (++f != first);
    }
    return changed;
  }

  void find_violation(Cdt::Face_handle f, std::vector<Violation>& found) const {
    if (!is_inside(f)) return;
    const auto corner = [&](Cdt::Vertex_handle v) {
      const LatticePoint p = sample(v->info());
      return Corner{{p.x * kLatticePerCell, p.y * kLatticePerCell}, samples_.at(p.x, p.y)};
    };
    const Violation::Corners corners{f->vertex(0), f->vertex(1), f->vertex(2)};
    const TriangleError error =
        triangle_error(samples_, corner(corners[0]), corner(corners[1]), corner(corners[2]));
    if (!(error.largest > options_.tolerance)) return;
    // The plane meets its own corners but for the rounding, which inserting them again would not mend.
    const bool is_corner = std::any_of(corners.begin(), corners.end(),
                                       [&](Cdt::Vertex_handle v) { return sample(v->info()) == error.worst; });
    if (!is_corner) found.push_back({error.worst, corners});
  }

  // Names the vertices anew along a space-filling curve, and orders the triangles by them: what lies together in
  // plan lies together in memory, which makes simplification a third faster.
  WindowMesh with_used_vertices(std::vector<std::array<std::int32_t, 3>>& triangles) const {
    std::vector<std::int32_t> new_name(position_.size(), kNone);
    for (const auto& t : triangles) {
      for (const std::int32_t v : t) new_name[static_cast<std::size_t>(v)] = 0;
    }
    std::vector<std::pair<std::uint64_t, std::int32_t>> order;
    for (std::size_t v = 0; v < position_.size(); ++v) {
      if (new_name[v] != kNone) order.emplace_back(z_order(position_[v]), static_cast<std::int32_t>(v));
    }
    std::sort(order.begin(), order.end());
    WindowMesh mesh;
    for (const auto& [code, v] : order) {
      new_name[static_cast<std::size_t>(v)] = mesh.n_vertices();
      const LatticePoint p = sample(v);
      mesh.position.push_back({p.x * kLatticePerCell, p.y * kLatticePerCell});
      mesh.height.push_back(samples_.at(p.x, p.y));
    }
    mesh.is_settled.assign(mesh.position.size(), 0);
    for (auto& t : triangles) {
      for (std::int32_t& v : t) v = new_name[static_cast<std::size_t>(v)];
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    }
    connect(mesh, sorted_by_first_vertex(triangles, mesh.position.size()));
    return mesh;
  }

  static std::vector<std::array<std::int32_t, 3>> sorted_by_first_vertex(
      const std::vector<std::array<std::int32_t, 3>>& triangles, std::size_t n_vertices) {
    std::vector<std::size_t> next(n_vertices + 1, 0);
    for (const auto& t : triangles) ++next[static_cast<std::size_t>(t[0]) + 1];
    for (std::size_t v = 0; v < n_vertices; ++v) next[v + 1] += next[v];
    std::vector<std::array<std::int32_t, 3>> sorted(triangles.size());
    for (const auto& t : triangles) sorted[next[static_cast<std::size_t>(t[0])]++] = t;
    return sorted;
  }

  // The bits of the window's column and row in turn (Morton 1966).
  std::uint64_t z_order(LatticePoint p) const {
    const auto spread = [](std::int32_t i) {
      auto bits = static_cast<std::uint64_t>(i);
      for (const auto& [shift, mask] : {std::pair{16, 0x0000FFFF0000FFFFULL}, std::pair{8, 0x00FF00FF00FF00FFULL},
                                        std::pair{4, 0x0F0F0F0F0F0F0F0FULL}, std::pair{2, 0x3333333333333333ULL},
                                        std::pair{1, 0x5555555555555555ULL}}) {
        bits = (bits | (bits << shift)) & mask;
      }
      return bits;
    };
    return spread(p.x - window_.x0) | (spread(p.y - window_.y0) << 1);
  }

  const HeightGrid& samples_;
  GridRect window_;
  TriangulateOptions options_;
  double aspect_;
  Cdt cdt_;
  std::vector<LatticePoint> position_;      // by name: sample position
  std::vector<Cdt::Vertex_handle> handle_;  // by sample of the window, for the constraints
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

// Along a Z-shaped curve (Morton 1966): quarter by quarter of a square.
void add_selected(Selection& selection, LatticePoint corner, std::int32_t side, std::vector<LatticePoint>& points) {
  const GridRect& w = selection.window;
  if (corner.x >= w.x0 + w.width || corner.y >= w.y0 + w.height) return;
  if (side == 1) {
    if (selection.at(corner.x, corner.y)) points.push_back(corner);
    return;
  }
  const std::int32_t half = side / 2;
  for (const std::int32_t y : {corner.y, corner.y + half}) {
    for (const std::int32_t x : {corner.x, corner.x + half}) add_selected(selection, {x, y}, half, points);
  }
}

std::vector<LatticePoint> selected_points(Selection& selection) {
  const GridRect& w = selection.window;
  std::int32_t side = 1;
  while (side < std::max(w.width, w.height)) side *= 2;
  std::vector<LatticePoint> points;
  add_selected(selection, {w.x0, w.y0}, side, points);
  return points;
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

}  // namespace

WindowMesh triangulate(const HeightGrid& samples, const GridRect& window, const TriangulateOptions& options) {
  const std::vector<OutlinePiece> outline = outline_of(samples, window);
  if (outline.empty()) return {};
  Selection selection{window, std::vector<std::uint8_t>(static_cast<std::size_t>(window.area()), 0)};
  select_samples(samples, kSelectFactor * options.tolerance, selection);
  select_outline(samples, kSeamFactor * options.tolerance, outline, selection);
  WindowTriangulation triangulation(samples, window, options);
  triangulation.insert_all(selected_points(selection));
  if (!is_full(samples, window)) {
    triangulation.prepare_lookup();
    for (const OutlinePiece& piece : outline) triangulation.constrain(selected_on(piece, selection));
  }
  triangulation.insert_violations();
  return triangulation.mesh();
}

}  // namespace tinsmith
