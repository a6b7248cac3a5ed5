#pragma once
// What a raster file declares about itself, in words.

#include <string>
#include <utility>
#include <vector>

#include "tinsmith/options.hpp"

namespace tinsmith {

/// Format, size, bands, and type, nodata, mask, scale and unit of the band in the options. Throws InputError
/// when it is no raster or has no such band.
std::vector<std::pair<std::string, std::string>> describe_raster_file(const std::string& path,
                                                                      const InputOptions& options);

}  // namespace tinsmith
