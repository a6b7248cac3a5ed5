#pragma once
// How much memory there is to work with.

#include <cstdint>

namespace tinsmith {

/// Bytes of the machine's memory, or of the control group's limit where that is less.
std::uint64_t machine_memory();

/// Bytes of it that this process holds now; 0 when the system does not say.
std::uint64_t resident_memory();

/// From now on keeps up to 32 MiB of what is freed for later, and takes from it what is smaller. For programs whose
/// tasks take and free the same few megabytes again and again: at 2 m on the sample terrain the pages that the
/// system hands out anew fall from 33 300 to 9 600 and the time to 0.92, at 10 m to 0.97; the peak stays.
void keep_freed_memory();

/// Asks the system for pages of 2 MiB for the first 30 MiB of the heap, more than small rasters take; to be called
/// after keep_freed_memory(), before much is allocated. On a virtual machine that is slow to hand out pages, 1
/// million samples at 5.4 m take 2 600 of them instead of 6 600 and 0.92 of the time, 0.89 on two threads.
void begin_heap_with_huge_pages();

/// Gives the system back what was freed and is kept for later; where the C library can't, nothing happens.
void return_free_memory();

}  // namespace tinsmith
