#pragma once
// Panels side by side on one page, each with its caption, and the page as a PNG.

#include <optional>
#include <string>
#include <vector>

#include "render/panels.hpp"

namespace tinsmith {

/// A picture and what is said below it.
struct CaptionedPanel {
  Surface picture;
  std::string title;
  std::string detail;
  std::optional<double> error_scale;       // metres: draw the legend of the diverging scale
  std::optional<double> metres_per_pixel;  // draw a scale bar on the picture
};

Surface lay_out_page(const std::vector<CaptionedPanel>& panels);

/// Written aside and renamed. Throws OutputError.
void write_png(const Surface& page, const std::string& path);

}  // namespace tinsmith
