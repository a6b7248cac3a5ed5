#pragma once
// Lists of inputs in files, for more of them than a command line holds.

#include <string>
#include <vector>

namespace tinsmith {

/// The paths, with every @FILE replaced by the paths that FILE holds, one a line; empty lines don't count. A file
/// whose own name starts with @ is named ./@. Throws InputError when a list can't be read or holds no path.
std::vector<std::string> expand_lists(const std::vector<std::string>& paths);

}  // namespace tinsmith
