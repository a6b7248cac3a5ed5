#pragma once
// Edges that the user names in a text file.

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace tinsmith::cli {

/// One edge a line: two different vertex numbers, from 0 and below n_vertices. What follows # is a comment; empty
/// lines are skipped. Throws InputError, with the line, for anything else.
std::vector<std::array<std::uint32_t, 2>> read_edge_list(const std::string& path, std::size_t n_vertices);

}  // namespace tinsmith::cli
