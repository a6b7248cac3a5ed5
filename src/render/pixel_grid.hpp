#pragma once
// One number for each pixel of a view: heights of the samples, heights of a mesh, errors of a mesh.

#include <array>
#include <limits>
#include <string_view>
#include <vector>

#include "geometry/colour.hpp"
#include "io/raster_field.hpp"
#include "render/plan_tin.hpp"
#include "render/view.hpp"
#include "tinsmith/progress.hpp"

namespace tinsmith {

/// Row by row; metres. `coverage` is the share of the pixel that has a value (0 to 1); without any the value
/// is NaN.
struct PixelGrid {
  int width = 0;
  int height = 0;
  std::vector<double> value;
  std::vector<float> coverage;
  double lowest = std::numeric_limits<double>::infinity();  // of all that the pixels were made from
  double highest = -std::numeric_limits<double>::infinity();

  PixelGrid(int w, int h)
      : width(w),
        height(h),
        value(static_cast<std::size_t>(w) * h, std::numeric_limits<double>::quiet_NaN()),
        coverage(static_cast<std::size_t>(w) * h, 0) {}
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width + x; }
};

/// Where a long picture tells how far it is: each stage gets an equal part of the whole.
struct Stage {
  const Progress* progress;
  int number;  // from 0
  int n_stages;
  /// Throws Interrupted when the caller wants to stop.
  void report(double fraction, std::string_view name) const;
};

/// Samples weighted by a tent as wide as two pixels (two samples where the picture magnifies: bilinear).
PixelGrid sample_heights(const View& view, const RasterField& field, const Stage& stage);

/// The mesh's heights, averaged over several places in each pixel.
PixelGrid mesh_heights(const View& view, const Tin& tin, double metres_per_vertical_unit, const Stage& stage);

/// Levels of red, green and blue between those of the mesh's vertices, averaged like its heights.
struct PixelColours {
  std::array<PixelGrid, 3> channels;
};
PixelColours mesh_colours(const View& view, const Tin& tin, const std::vector<Levels>& colours, const Stage& stage);

/// z_TIN - z_sample at the sample under each pixel where it is largest in size. Every sample in the view has
/// its say in at least one pixel, so the largest value of the picture is the largest error.
PixelGrid largest_errors(const View& view, const RasterField& field, const Tin& tin, const Stage& stage);

}  // namespace tinsmith
