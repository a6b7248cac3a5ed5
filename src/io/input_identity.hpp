#pragma once
// By what a run knows its inputs again.

#include <string>
#include <vector>

#include "samples/colour_grid.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

/// Lines "name: value": paths, sizes and times of the files, the options, the size of the field and a checksum of
/// some of its samples. Throws InputError when they can't be read.
std::vector<std::string> input_identity(const std::vector<std::string>& paths, const InputOptions& options,
                                        const HeightField& field);

/// The same of the colours that lie on the field: file, channels, and a checksum of some of them.
std::vector<std::string> colour_identity(const std::string& path, const ColourField& colours,
                                         const HeightField& field);

}  // namespace tinsmith
