#include <algorithm>
#include <cmath>

#include "render/colour.hpp"
#include "render/panels.hpp"

namespace tinsmith {
namespace {

using Edge = std::array<std::uint32_t, 2>;

struct Edges {
  std::vector<Edge> inner;
  std::vector<Edge> outline;  // with a triangle on one side only
};

struct Stroke {
  Colour colour;
  double opacity;
  double width;  // pixels
};

constexpr Colour kEdgeColour{0.06, 0.11, 0.24};
constexpr Stroke kOutline{{0.80, 0.18, 0.10}, 0.9, 1.1};

// cairo's time for one path grows faster than its length; at this many edges it is lowest.
constexpr std::size_t kEdgesPerPath = 128;

Edges edges_of(const Tin& tin) {
  std::vector<Edge> all;
  all.reserve(3 * tin.triangles.size());
  for (const auto& t : tin.triangles)
    for (int k = 0; k < 3; ++k) all.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3])});
  std::sort(all.begin(), all.end());
  Edges edges;
  for (std::size_t i = 0, next = 0; i < all.size(); i = next) {
    while (next < all.size() && all[next] == all[i]) ++next;
    (next - i == 1 ? edges.outline : edges.inner).push_back(all[i]);
  }
  return edges;
}

bool meets_view(const View& view, const std::array<double, 2>& a, const std::array<double, 2>& b) {
  return std::max(a[0], b[0]) >= -1 && std::min(a[0], b[0]) <= view.width + 1 && std::max(a[1], b[1]) >= -1 &&
         std::min(a[1], b[1]) <= view.height + 1;
}

void stroke_edges(const Pen& pen, const View& view, const std::vector<Edge>& edges, const Tin& tin) {
  std::size_t n_in_path = 0;
  for (const auto& [u, v] : edges) {
    const auto a = view.to_pixel(tin.vertices[u][0], tin.vertices[u][1]);
    const auto b = view.to_pixel(tin.vertices[v][0], tin.vertices[v][1]);
    if (!meets_view(view, a, b)) continue;
    cairo_move_to(pen.get(), a[0], a[1]);
    cairo_line_to(pen.get(), b[0], b[1]);
    if (++n_in_path % kEdgesPerPath == 0) cairo_stroke(pen.get());
  }
  cairo_stroke(pen.get());
}

double mean_length(const View& view, const std::vector<Edge>& edges, const Tin& tin) {
  double sum = 0;
  for (const auto& [u, v] : edges)
    sum += std::hypot((tin.vertices[u][0] - tin.vertices[v][0]) / view.units_per_pixel_x,
                      (tin.vertices[u][1] - tin.vertices[v][1]) / view.units_per_pixel_y);
  return edges.empty() ? 0 : sum / static_cast<double>(edges.size());
}

// The shorter the edges, the thinner and fainter, so that a dense mesh is a veil and not a black sheet.
Stroke stroke_for(double length_pixels) {
  return {kEdgeColour, std::clamp(0.12 + 0.05 * length_pixels, 0.15, 0.7),
          std::clamp(0.3 + 0.03 * length_pixels, 0.3, 0.6)};
}

void take(const Pen& pen, const Stroke& stroke) {
  cairo_set_source_rgba(pen.get(), stroke.colour.r, stroke.colour.g, stroke.colour.b, stroke.opacity);
  cairo_set_line_width(pen.get(), stroke.width);
}

}  // namespace

void draw_wireframe(const Surface& surface, const View& view, const Tin& tin) {
  const Edges edges = edges_of(tin);
  const Pen pen = make_pen(surface);
  // A little light under the lines lifts them off the relief.
  cairo_set_source_rgba(pen.get(), 1, 1, 1, 0.35);
  cairo_paint(pen.get());
  cairo_set_line_cap(pen.get(), CAIRO_LINE_CAP_ROUND);
  take(pen, stroke_for(mean_length(view, edges.inner, tin)));
  stroke_edges(pen, view, edges.inner, tin);
  take(pen, kOutline);
  stroke_edges(pen, view, edges.outline, tin);
}

}  // namespace tinsmith
