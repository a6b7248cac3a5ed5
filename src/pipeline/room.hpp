#pragma once
// Whether there is room on the disks for what a run is expected to write.

#include <cstdint>
#include <string>
#include <vector>

#include "tinsmith/plan.hpp"

namespace tinsmith {

/// Fills in the folders and what is free there. Throws OutputError when a folder can't be used.
void look_for_room(const std::string& output, const std::string& tmp, CompressPlan& plan);

/// A sentence for each place where less is free than is expected to be needed. Throws ResourceError where not even
/// a quarter of it is free: then it is certain. `work_there`: bytes of unfinished work to go on from.
std::vector<std::string> require_room(const CompressPlan& plan, std::uint64_t work_there);

}  // namespace tinsmith
