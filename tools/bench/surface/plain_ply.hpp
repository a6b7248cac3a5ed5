#pragma once
// The one kind of file that all surface peers read and write: binary little-endian PLY of x y z as doubles and
// triangles as uchar 3 and three int32. plain_ply.py writes and reads the same.

#include <string>

#include "../peers/grid.hpp"

namespace bench {

/// Both throw std::runtime_error.
Mesh read_plain_ply(const std::string& path);
void write_plain_ply(const std::string& path, const Mesh& mesh);

}  // namespace bench
