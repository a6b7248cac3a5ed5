#pragma once
// The pictures themselves, drawn on cairo surfaces of the view's size.

#include <cairo.h>

#include <memory>
#include <optional>

#include "geodesy/grid_frame.hpp"
#include "render/pixel_grid.hpp"
#include "render/view.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Pen = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

/// An opaque RGB image, or one with transparency. Throws ResourceError when there is no room for it.
Surface make_surface(int width, int height, cairo_format_t format = CAIRO_FORMAT_RGB24);
Pen make_pen(const Surface& surface);

/// Shaded relief (Horn's slopes, sun in the north-west at 45 degrees) over a tint by height, or over colours when
/// there are some; voids grey.
Surface draw_hillshade(const View& view, const GridFrame& frame, const PixelGrid& heights,
                       const std::optional<PixelColours>& colours);

/// Errors (metres) on the diverging scale whose ends are at -scale and scale; voids grey.
Surface draw_errors(const PixelGrid& errors, double scale);

/// The edges of the mesh over a picture; those with a triangle on one side only in a colour of their own.
void draw_wireframe(const Surface& surface, const View& view, const Tin& tin);

}  // namespace tinsmith
