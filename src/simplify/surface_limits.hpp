#pragma once
// What may be asked of the simplification of a surface, and where it ends.

#include <cstddef>

#include "tinsmith/simplify.hpp"

namespace tinsmith {

/// Throws UsageError for numbers out of their ranges.
void require_sane(const SimplifySurfaceOptions& options);

/// The number of triangles at which collapses end; 0: when none is left.
double target_of(const SimplifySurfaceOptions& options, std::size_t n_triangles);

}  // namespace tinsmith
