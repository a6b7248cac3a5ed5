#pragma once
// How much memory there is to work with.

#include <cstdint>

namespace tinsmith {

/// Bytes of the machine's memory, or of the control group's limit where that is less.
std::uint64_t machine_memory();

}  // namespace tinsmith
