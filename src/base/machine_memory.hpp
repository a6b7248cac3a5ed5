#pragma once
// How much memory there is to work with.

#include <cstdint>

namespace tinsmith {

/// Bytes of the machine's memory, or of the control group's limit where that is less.
std::uint64_t machine_memory();

/// Bytes of it that this process holds now; 0 when the system does not say.
std::uint64_t resident_memory();

/// Gives the system back what was freed and is kept for later; where the C library can't, nothing happens.
void return_free_memory();

}  // namespace tinsmith
