#pragma once
// What a run finds out before it starts.

#include <string>

#include "io/raster_field.hpp"
#include "samples/colour_grid.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// Throws ResourceError when the output's format is certain not to hold the result. Tries a few windows when it may
/// not, and does nothing when it holds the full grid. Only for options.max_error. `colours` of the vertices; null:
/// none.
void require_format_may_hold(const RasterField& field, const std::string& output, const CompressOptions& options,
                             const ColourField* colours);

}  // namespace tinsmith
