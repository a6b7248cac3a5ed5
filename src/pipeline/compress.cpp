#include "tinsmith/compress.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "pipeline/rounds.hpp"
#include "pipeline/search.hpp"
#include "samples/array_field.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

void require_sensible(const CompressOptions& options) {
  const int stops = options.max_error.has_value() + options.triangles.has_value() + options.ratio.has_value();
  if (stops != 1) throw UsageError("give exactly one of max_error, triangles and ratio, for example max_error = 5");
  if (options.max_error && !(*options.max_error >= 0 && std::isfinite(*options.max_error)))
    throw UsageError(fmt::format("max_error is {}: it must be a number of metres, 0 or more", *options.max_error));
  if (options.triangles && !(*options.triangles >= 2 && std::isfinite(*options.triangles)))
    throw UsageError(fmt::format("triangles is {}: it must be 2 or more", *options.triangles));
  if (options.ratio && !(*options.ratio > 0 && *options.ratio <= 1))
    throw UsageError(fmt::format("ratio is {}: it must be more than 0 and at most 1", *options.ratio));
  if (options.window < 4)
    throw UsageError(fmt::format("window is {}: it must be 4 samples or more", options.window));
  if (options.threads < 0) throw UsageError(fmt::format("threads is {}: it must be 0 or more", options.threads));
}

std::size_t thread_count(const CompressOptions& options) {
  return static_cast<std::size_t>(options.threads > 0 ? options.threads : tbb::info::default_concurrency());
}

// The lowest and highest valid sample, read in rows of windows.
std::array<double, 2> height_range(const HeightField& field) {
  constexpr std::int32_t kSide = 1024;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::int32_t y = 0; y < field.height(); y += kSide) {
    for (std::int32_t x = 0; x < field.width(); x += kSide) {
      const HeightGrid grid =
          field.read({x, y, std::min(kSide, field.width() - x), std::min(kSide, field.height() - y)});
      for (const double z : grid.z) {
        if (z < low) low = z;
        if (z > high) high = z;
      }
    }
  }
  return {low, high};
}

// How much the format may change a height of the result, in vertical units. Vertices keep to the heights of the
// samples, give or take the tolerance; the format may put its origin on a whole number.
double rounding_of_format(const HeightField& field, const std::string& output, double tolerance) {
  if (output.empty() || height_rounding(output, 0, 1) == 0) return 0;
  const auto [low, high] = height_range(field);
  if (!(low <= high)) return 0;
  const double rounding = height_rounding(output, low - tolerance - 1, high + tolerance + 1);
  if (tolerance < 4 * rounding)
    throw ResourceError(
        fmt::format("{}: float32 heights are off by up to {:.3g}, too much for this tolerance; "
                    "write .ply, which keeps doubles, or raise the tolerance",
                    output, rounding));
  return rounding;
}

void require_triangles(const TerrainMesh& surface) {
  if (surface.triangles.empty())
    throw InputError(
        "the input has no 2 x 2 block of valid samples, so there is no surface; check --nodata, --band and --bbox");
}

// Tolerances here are in the vertical unit of the field.
TerrainMesh compress_field(const HeightField& field, const GridFrame& frame, const std::string& output,
                           const CompressOptions& options, CompressReport& report) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, thread_count(options));
  const double unit = frame.metres_per_vertical_unit;
  const auto run = [&](double tolerance, CompressReport& of_run) {
    const double rounding = rounding_of_format(field, output, tolerance);
    TerrainMesh surface =
        run_rounds(field, frame, {tolerance - rounding, options.window, options.placement, options.effort},
                   options.progress, of_run);
    require_triangles(surface);
    of_run.tolerance = tolerance * unit;
    return surface;
  };
  if (options.max_error) return run(*options.max_error / unit, report);
  return search_tolerance(run, options.triangles, options.ratio, report);
}

}  // namespace

CompressReport compress(const std::vector<std::string>& inputs, const std::string& output,
                        const InputOptions& input_options, const CompressOptions& options) {
  require_sensible(options);
  require_mesh_extension(output);
  const RasterField field(inputs, input_options);
  CompressReport report;
  const TerrainMesh surface = compress_field(field, field.frame(), output, options, report);
  report.remarks = field.remarks();
  write_mesh(output, surface, field.frame());
  if (options.progress) options.progress(1, "write");
  return report;
}

Tin compress(const HeightArray& heights, const CompressOptions& options, CompressReport* report) {
  require_sensible(options);
  const ArrayField field(heights.z, heights.width, heights.height);
  GridFrame frame;
  frame.geotransform = {-heights.step_x / 2, heights.step_x, 0, -heights.step_y / 2, 0, heights.step_y};
  CompressReport own;
  const TerrainMesh surface = compress_field(field, frame, {}, options, report ? *report : own);
  Tin tin;
  for (std::size_t v = 0; v < surface.position.size(); ++v) {
    const LatticePoint p = surface.position[v];
    const auto [x, y] =
        frame.to_crs(static_cast<double>(p.x) / kLatticePerCell, static_cast<double>(p.y) / kLatticePerCell);
    tin.vertices.push_back({x, y, surface.height[v]});
  }
  tin.triangles = surface.triangles;
  return tin;
}

}  // namespace tinsmith
