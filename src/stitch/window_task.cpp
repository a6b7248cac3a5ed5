#include "stitch/window_task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/triangle_rows.hpp"
#include "simplify/simplify.hpp"
#include "stitch/kinds.hpp"
#include "triangulate/triangulate.hpp"

namespace tinsmith {

namespace {

// The tolerance less what the rounding of doubles may add when somebody else measures. A tolerance of nearly
// zero is taken as that rounding: exact planes are planes.
double safe_tolerance(const HeightGrid& samples, double tolerance) {
  double largest = 0;
  for (const double z : samples.z) largest = std::max(largest, std::abs(z));  // NaN never is the larger
  const double rounding = 8 * std::numeric_limits<double>::epsilon() * largest;
  return std::max(tolerance - rounding, rounding);
}

GridRect grown(const GridRect& r) { return {r.x0 - 1, r.y0 - 1, r.width + 2, r.height + 2}; }

SimplifyOptions simplify_options(const HeightGrid& samples, const WindowOptions& options, bool only_unsettled) {
  return {safe_tolerance(samples, options.tolerance), options.placement, only_unsettled};
}

void count_valid(const HeightGrid& samples, const GridRect& window, const HeightField& field, FirstChunk& result) {
  const std::int32_t right = window.x0 + window.width - 1;
  const std::int32_t bottom = window.y0 + window.height - 1;
  for (std::int32_t y = window.y0; y <= bottom; ++y) {
    for (std::int32_t x = window.x0; x <= right; ++x) {
      if (samples.is_valid_cell(x, y) && x < right && y < bottom) ++result.valid_cells;
      const bool is_own = (x < right || right == field.width() - 1) && (y < bottom || bottom == field.height() - 1);
      if (is_own && samples.is_valid(x, y)) ++result.samples;
    }
  }
}

WindowMesh mesh_of(Chunk&& chunk) {
  WindowMesh mesh;
  mesh.position = std::move(chunk.position);
  mesh.height = std::move(chunk.height);
  mesh.is_settled = std::move(chunk.is_settled);
  connect(mesh, chunk.triangles);
  return mesh;
}

GridRect rect_of(const std::vector<LatticePoint>& positions) {
  LatticePoint low = positions.front();
  LatticePoint high = low;
  for (const LatticePoint p : positions) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const std::int32_t x0 = floor_cell(low.x);
  const std::int32_t y0 = floor_cell(low.y);
  return {x0, y0, ceil_cell(high.x) - x0 + 1, ceil_cell(high.y) - y0 + 1};
}

bool has_unsettled(const WindowMesh& mesh) {
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    if (!mesh.is_settled[v] && mesh.kind[v] != VertexKind::kLocked) return true;
  }
  return false;
}

}  // namespace

FirstChunk first_chunk(const HeightField& field, const GridRect& window, const WindowOptions& options) {
  FirstChunk result;
  const HeightGrid samples = field.read(grown(window));
  count_valid(samples, window, field, result);
  if (result.valid_cells == 0) return result;
  const SimplifyOptions simplification = simplify_options(samples, options, false);
  WindowMesh mesh = triangulate(samples, window, {simplification.tolerance, options.aspect});
  result.start_triangles = mesh.origin.size() / 3;
  set_kinds(mesh, samples);
  simplify(mesh, samples, simplification);
  result.chunk = chunk_of(mesh);
  return result;
}

Chunk seam_chunk(const HeightField& field, const std::vector<const Chunk*>& parts, const WindowOptions& options) {
  Chunk welded = weld(parts);
  if (welded.is_empty()) return welded;
  WindowMesh mesh = mesh_of(std::move(welded));
  const HeightGrid samples = field.read(grown(rect_of(mesh.position)));
  set_kinds(mesh, samples);
  if (has_unsettled(mesh)) simplify(mesh, samples, simplify_options(samples, options, true));
  return chunk_of(mesh);
}

}  // namespace tinsmith
