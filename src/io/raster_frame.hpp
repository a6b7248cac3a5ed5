#pragma once
// From what a raster declares to where it lies and how long its units are.

#include <string>
#include <vector>

#include "geodesy/crs.hpp"
#include "geodesy/grid_frame.hpp"
#include "io/raster_source.hpp"

namespace tinsmith {

/// Where a raster of a CRS with these units lies. The unit of height is, in this order: options.vertical_unit, the
/// band's unit type, the vertical axis of the CRS, the linear unit of a projected CRS (with a remark unless it is
/// the metre), the metre. Remarks that are there already are not repeated. Throws InputError for units that are not
/// known, for a georeference that is no grid, and for latitudes beyond the poles; UsageError for a vertical_unit
/// that is no length.
GridFrame frame_of(const RasterSource& source, const CrsUnits& crs, const InputOptions& options,
                   std::vector<std::string>& remarks);

}  // namespace tinsmith
