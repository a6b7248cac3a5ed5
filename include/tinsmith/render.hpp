#pragma once
// Pictures of terrain and of meshes, to see at a glance what no number shows.

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "tinsmith/options.hpp"

namespace tinsmith {

/// What to draw, side by side from left to right.
enum class Panel {
  kHillshade,  // of the samples, or of the mesh's triangles when there are none, in the colours of its vertices
  kWireframe,  // the mesh's edges over the hillshade; outline edges in another colour
  kError,      // z_TIN - z_sample in a diverging scale, with a legend in metres; voids hatched or grey
};

struct RenderOptions {
  std::vector<Panel> panels;    // empty: all that the inputs allow
  int panel_width = 800;        // pixels; the height follows from the ground's proportions
  std::optional<double> scale;  // metres at the ends of the error scale; default: the largest error
  InputOptions input;           // band, nodata; its bbox also crops the picture
  Progress progress;
};

/// Draws to a PNG. `raster` may be empty (then a mesh is needed), `mesh` may be empty (then a raster is).
/// Written aside and renamed. Throws one of tinsmith/error.hpp.
void render(const std::vector<std::string>& raster, const std::string& mesh, const std::string& png,
            const RenderOptions& options = {});

}  // namespace tinsmith
