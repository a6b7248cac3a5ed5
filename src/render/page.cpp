#include "render/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/output_file.hpp"
#include "render/colour.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr int kLargestSide = 32767;  // cairo's limit for an image, pixels

// Lengths on the page in units of the type's size, which follows the panels' width.
struct Type {
  double size;
  double margin;
  double caption_height;
  double legend_height;
};

Type type_for(int panel_width) {
  const double size = std::clamp(panel_width / 50.0, 9.0, 40.0);
  return {size, 1.2 * size, 3.6 * size, 3.0 * size};
}

void set_ink(const Pen& pen, const Colour& c, double opacity = 1) {
  cairo_set_source_rgba(pen.get(), c.r, c.g, c.b, opacity);
}

void set_type(const Pen& pen, double size, cairo_font_weight_t weight) {
  cairo_select_font_face(pen.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL, weight);
  cairo_set_font_size(pen.get(), size);
}

double text_width(const Pen& pen, const std::string& text) {
  cairo_text_extents_t extents;
  cairo_text_extents(pen.get(), text.c_str(), &extents);
  return extents.x_advance;
}

enum class Align { kLeft, kCentre };

// Text too wide for its panel is set smaller, so that nothing is cut off.
void write_text(const Pen& pen, const std::string& text, const std::array<double, 2>& at, double room,
                Align align = Align::kLeft) {
  cairo_save(pen.get());
  const double width = text_width(pen, text);
  const double shrink = std::min(1.0, room / std::max(width, 1.0));
  cairo_translate(pen.get(), at[0] - (align == Align::kCentre ? width * shrink / 2 : 0), at[1]);
  cairo_scale(pen.get(), shrink, shrink);
  cairo_move_to(pen.get(), 0, 0);
  cairo_show_text(pen.get(), text.c_str());
  cairo_restore(pen.get());
}

// 1, 2 or 5 times a power of ten.
double round_length_below(double length) {
  const double power = std::pow(10, std::floor(std::log10(length)));
  for (const double factor : {5.0, 2.0})
    if (factor * power <= length) return factor * power;
  return power;
}

// In the lower left corner, dark on a light halo so that it reads on any ground.
void draw_scale_bar(const Pen& pen, const Type& type, const std::array<double, 2>& corner, double width,
                    double metres_per_pixel) {
  const double metres = round_length_below(width / 4 * metres_per_pixel);
  const std::string label = metres >= 1000 ? fmt::format("{:g} km", metres / 1000) : fmt::format("{:g} m", metres);
  const double x = corner[0] + type.size;
  const double y = corner[1] - type.size;
  set_type(pen, type.size * 0.9, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_line_join(pen.get(), CAIRO_LINE_JOIN_ROUND);
  for (const bool halo : {true, false}) {
    set_ink(pen, halo ? Colour{1, 1, 1} : kInk, halo ? 0.7 : 1);
    cairo_set_line_width(pen.get(), type.size * (halo ? 0.40 : 0.14));
    cairo_move_to(pen.get(), x, y - type.size * 0.4);
    cairo_line_to(pen.get(), x, y);
    cairo_line_to(pen.get(), x + metres / metres_per_pixel, y);
    cairo_line_to(pen.get(), x + metres / metres_per_pixel, y - type.size * 0.4);
    cairo_stroke(pen.get());
    cairo_move_to(pen.get(), x + type.size * 0.4, y - type.size * 0.35);
    cairo_text_path(pen.get(), label.c_str());
    halo ? cairo_stroke(pen.get()) : cairo_fill(pen.get());
  }
}

void draw_legend(const Pen& pen, const Type& type, const std::array<double, 2>& corner, double width,
                 double scale) {
  const double bar_width = std::min(width - 5 * type.size, 26 * type.size);
  const double x0 = corner[0] + (width - bar_width) / 2;
  cairo_pattern_t* const ramp = cairo_pattern_create_linear(x0, 0, x0 + bar_width, 0);
  for (int i = -8; i <= 8; ++i) {
    const Colour c = diverging(i / 8.0);
    cairo_pattern_add_color_stop_rgb(ramp, (i + 8) / 16.0, c.r, c.g, c.b);
  }
  cairo_rectangle(pen.get(), x0, corner[1], bar_width, type.size);
  cairo_set_source(pen.get(), ramp);
  cairo_fill_preserve(pen.get());
  cairo_pattern_destroy(ramp);
  set_ink(pen, kInk, 0.5);
  cairo_set_line_width(pen.get(), 0.8);
  cairo_stroke(pen.get());
  set_ink(pen, kInk);
  set_type(pen, type.size * 0.85, CAIRO_FONT_WEIGHT_NORMAL);
  for (const double t : {-1.0, -0.5, 0.0, 0.5, 1.0}) {
    const std::string label = fmt::format("{}{:.3g}{}", t > 0 ? "+" : "", t * scale, t == 1 ? " m" : "");
    write_text(pen, label, {x0 + (t + 1) / 2 * bar_width, corner[1] + 2.1 * type.size}, width, Align::kCentre);
  }
}

void draw_panel(const Pen& pen, const Type& type, double x, const CaptionedPanel& panel) {
  const int width = cairo_image_surface_get_width(panel.picture.get());
  const int height = cairo_image_surface_get_height(panel.picture.get());
  cairo_set_source_surface(pen.get(), panel.picture.get(), x, type.margin);
  cairo_paint(pen.get());
  const double below = type.margin + height;
  if (panel.metres_per_pixel) draw_scale_bar(pen, type, {x, below}, width, *panel.metres_per_pixel);
  set_ink(pen, kInk);
  set_type(pen, type.size * 1.05, CAIRO_FONT_WEIGHT_BOLD);
  write_text(pen, panel.title, {x, below + 1.6 * type.size}, width);
  set_type(pen, type.size * 0.9, CAIRO_FONT_WEIGHT_NORMAL);
  write_text(pen, panel.detail, {x, below + 3.0 * type.size}, width);
  if (panel.error_scale) draw_legend(pen, type, {x, below + type.caption_height}, width, *panel.error_scale);
}

cairo_status_t append(void* file, const unsigned char* bytes, unsigned int size) noexcept {
  // cairo is C: nothing may be thrown through it.
  try {
    static_cast<std::string*>(file)->append(reinterpret_cast<const char*>(bytes), size);
    return CAIRO_STATUS_SUCCESS;
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

}  // namespace

Surface make_surface(int width, int height, cairo_format_t format) {
  if (width > kLargestSide || height > kLargestSide)
    throw ResourceError(
        fmt::format("render: a picture of {} x {} pixels is larger than {} pixels along a side; "
                    "use a smaller --width or fewer --panels",
                    width, height, kLargestSide));
  Surface surface(cairo_image_surface_create(format, width, height), &cairo_surface_destroy);
  if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) throw std::bad_alloc();
  return surface;
}

Pen make_pen(const Surface& surface) { return {cairo_create(surface.get()), &cairo_destroy}; }

Surface lay_out_page(const std::vector<CaptionedPanel>& panels) {
  const int panel_width = cairo_image_surface_get_width(panels.front().picture.get());
  const int panel_height = cairo_image_surface_get_height(panels.front().picture.get());
  const Type type = type_for(panel_width);
  const bool has_legend = std::any_of(panels.begin(), panels.end(), [](const auto& p) { return p.error_scale; });
  const double width = type.margin + static_cast<double>(panels.size()) * (panel_width + type.margin);
  const double height = type.margin + panel_height + type.caption_height + (has_legend ? type.legend_height : 0);
  Surface page = make_surface(static_cast<int>(std::ceil(width)), static_cast<int>(std::ceil(height)));
  const Pen pen = make_pen(page);
  set_ink(pen, {1, 1, 1});
  cairo_paint(pen.get());
  double x = std::round(type.margin);
  for (const CaptionedPanel& panel : panels) {
    draw_panel(pen, type, x, panel);
    x += std::round(panel_width + type.margin);
  }
  return page;
}

void write_png(const Surface& page, const std::string& path) {
  std::string bytes;
  if (cairo_surface_write_to_png_stream(page.get(), &append, &bytes) != CAIRO_STATUS_SUCCESS)
    throw std::bad_alloc();
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace tinsmith
