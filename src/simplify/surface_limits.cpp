#include "simplify/surface_limits.hpp"

#include <algorithm>

#include "tinsmith/error.hpp"

namespace tinsmith {

void require_sane(const SimplifySurfaceOptions& options) {
  if (options.triangles && !(*options.triangles >= 0))
    throw UsageError("the number of triangles must be 0 or more");
  if (options.ratio && !(*options.ratio > 0 && *options.ratio <= 1))
    throw UsageError("the ratio must be above 0 and at most 1");
  if (options.max_cost && !(*options.max_cost >= 0)) throw UsageError("the largest cost must be 0 or more");
  if (options.attribute_weight && !(*options.attribute_weight >= 0))
    throw UsageError("the attributes' weight must be 0 or more");
  if (options.crease && !(*options.crease >= 0 && *options.crease <= 180))
    throw UsageError("the crease angle must be from 0 to 180 degrees");
}

double target_of(const SimplifySurfaceOptions& options, std::size_t n_triangles) {
  double target = 0;
  if (options.triangles) target = std::max(target, *options.triangles);
  if (options.ratio) target = std::max(target, *options.ratio * static_cast<double>(n_triangles));
  return target;
}

}  // namespace tinsmith
