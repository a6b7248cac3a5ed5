#pragma once
// What is in a file, without judging it.

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tinsmith/options.hpp"

namespace tinsmith {

/// Names and values in a fixed order, ready to print: of a raster (size, type, CRS, steps in CRS units and
/// metres, nodata, height range and valid share with their units) or of a mesh file (format, vertices,
/// triangles, extent, height range, components, CRS), or of any surface that simplify reads (format, vertices,
/// triangles, names of values, ranges of x, y, z). A path @FILE is the raster that those named in FILE make
/// together. Throws InputError when it is none of them.
std::vector<std::pair<std::string, std::string>> describe(const std::string& path,
                                                          const InputOptions& options = {});

}  // namespace tinsmith
