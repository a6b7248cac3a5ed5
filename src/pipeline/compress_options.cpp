#include "pipeline/compress_options.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <cmath>

#include "tinsmith/error.hpp"

namespace tinsmith {

void require_sensible(const CompressOptions& options) {
  const int stops = options.max_error.has_value() + options.triangles.has_value() + options.ratio.has_value();
  if (stops != 1) throw UsageError("give exactly one of max_error, triangles and ratio, for example max_error = 5");
  if (options.max_error && !(*options.max_error >= 0 && std::isfinite(*options.max_error)))
    throw UsageError(fmt::format("max_error is {}: it must be a number of metres, 0 or more", *options.max_error));
  if (options.triangles && !(*options.triangles >= 2 && std::isfinite(*options.triangles) &&
                             *options.triangles == std::floor(*options.triangles)))
    throw UsageError(fmt::format("triangles is {}: it must be a whole number, 2 or more", *options.triangles));
  if (options.ratio && !(*options.ratio > 0 && *options.ratio <= 1))
    throw UsageError(fmt::format("ratio is {}: it must be more than 0 and at most 1", *options.ratio));
  if (options.window < 4)
    throw UsageError(fmt::format("window is {}: it must be 4 samples or more", options.window));
  if (!(options.color_tolerance > 0 && std::isfinite(options.color_tolerance)))
    throw UsageError(
        fmt::format("color_tolerance is {}: it must be a number of levels above 0", options.color_tolerance));
  if (options.threads < 0) throw UsageError(fmt::format("threads is {}: it must be 0 or more", options.threads));
}

int thread_count(const CompressOptions& options) {
  return options.threads > 0 ? options.threads : tbb::info::default_concurrency();
}

}  // namespace tinsmith
