#pragma once
// What has to be known of the inputs before the work starts.

#include <cstdint>
#include <string>
#include <vector>

#include "tinsmith/options.hpp"

namespace tinsmith::cli {

struct OpenedInputs {
  std::uint64_t n_samples = 0;       // valid or not, but for blocks that surely hold none
  std::vector<std::string> remarks;  // what the user should be told once
};

/// Opens the rasters as one grid, and the raster of colours on it if its path is not empty, and compares them where
/// they overlap, so that what is wrong with them is said at once. Throws InputError.
OpenedInputs open_inputs(const std::vector<std::string>& paths, const InputOptions& options,
                         const std::string& color);

/// All files that these inputs stand for: those that lists name, and the lists themselves.
std::vector<std::string> files_read(const std::vector<std::string>& paths);

/// Remarks on standard error, one line each.
void print_remarks(const std::vector<std::string>& remarks, bool quiet);

/// Throws UsageError, which names the verb's order of arguments, for a mesh where a raster is expected.
void require_rasters(const std::vector<std::string>& paths, const char* order);

}  // namespace tinsmith::cli
