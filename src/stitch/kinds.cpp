#include "stitch/kinds.hpp"

#include "geometry/triangle_rows.hpp"

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The direction of an outline edge: unit step, or (0, 0) when the edge is a seam.
struct Direction {
  int x = 0;
  int y = 0;
  bool is_seam() const { return x == 0 && y == 0; }
  friend bool operator==(Direction, Direction) = default;
};

int sign(std::int32_t v) { return (v > 0) - (v < 0); }

// Triangles are counter-clockwise, so that the inner side of the border halfedge a -> b is on the left: towards
// larger y when it runs towards larger x, and so on round.
Direction outline_direction(const HeightGrid& samples, LatticePoint a, LatticePoint b) {
  const Direction d{sign(b.x - a.x), sign(b.y - a.y)};
  if (d.y == 0 && a.y % kLatticePerCell == 0) {
    const std::int32_t column = floor_cell(d.x > 0 ? a.x : a.x - 1);
    const std::int32_t row = floor_cell(a.y) - (d.x > 0 ? 1 : 0);
    if (!samples.is_valid_cell(column, row)) return d;
  } else if (d.x == 0 && a.x % kLatticePerCell == 0) {
    const std::int32_t row = floor_cell(d.y > 0 ? a.y : a.y - 1);
    const std::int32_t column = floor_cell(a.x) - (d.y > 0 ? 0 : 1);
    if (!samples.is_valid_cell(column, row)) return d;
  }
  return {};
}

// Two valid cells that touch at this sample only.
bool is_pinch(const HeightGrid& samples, LatticePoint p) {
  if (!is_sample_position(p)) return false;
  const std::int32_t x = floor_cell(p.x);
  const std::int32_t y = floor_cell(p.y);
  const bool nw = samples.is_valid_cell(x - 1, y - 1);
  const bool ne = samples.is_valid_cell(x, y - 1);
  const bool sw = samples.is_valid_cell(x - 1, y);
  const bool se = samples.is_valid_cell(x, y);
  return nw == se && ne == sw && nw != ne;
}

VertexKind kind_of(const WindowMesh& mesh, const HeightGrid& samples, std::int32_t v) {
  if (mesh.kind[at(v)] == VertexKind::kLocked) return VertexKind::kLocked;
  const std::int32_t leaving = mesh.out[at(v)];
  if (!mesh.is_border_edge(leaving)) return VertexKind::kInterior;
  std::int32_t last = kNone;
  for_each_out(mesh, v, [&](std::int32_t h) { last = h; });
  const std::int32_t before = mesh.origin[at(WindowMesh::previous(last))];
  const LatticePoint p = mesh.position[at(v)];
  const Direction in = outline_direction(samples, mesh.position[at(before)], p);
  const Direction out = outline_direction(samples, p, mesh.position[at(mesh.destination(leaving))]);
  if (in.is_seam() || out.is_seam()) return VertexKind::kLocked;
  if (in == out) return VertexKind::kBorder;
  return is_pinch(samples, p) ? VertexKind::kLocked : VertexKind::kCorner;
}

}  // namespace

void set_kinds(WindowMesh& mesh, const HeightGrid& samples) {
  for (std::int32_t v = 0; v < mesh.n_vertices(); ++v) mesh.kind[at(v)] = kind_of(mesh, samples, v);
}

}  // namespace tinsmith
