#include "base/machine_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace tinsmith {
namespace {

constexpr int kKept = 32 << 20;  // the most that M_MMAP_THRESHOLD takes
constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();

/// What a file of the control group says; no limit when it says "max", nothing, or is not there.
std::uint64_t limit_in(const std::string& path) {
  std::ifstream file(path);
  std::uint64_t limit = kNoLimit;
  return file >> limit ? limit : kNoLimit;
}

/// Of the folder and all above it, up to the root of the control groups.
std::uint64_t limit_along(const std::string& root, std::string group, const std::string& name) {
  std::uint64_t limit = limit_in(root + "/" + name);
  for (; group.size() > 1; group.resize(group.rfind('/'))) {
    std::string path = root;
    limit = std::min(limit, limit_in(path.append(group).append("/").append(name)));
  }
  return limit;
}

/// Lines are "0::/group" for version 2, "9:memory:/group" for version 1.
std::uint64_t group_limit() {
  std::ifstream groups("/proc/self/cgroup");
  std::uint64_t limit = kNoLimit;
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(":/", first + 1);
    if (first == std::string::npos || second == std::string::npos) continue;
    const std::string group = line.substr(second + 1);
    if (second == first + 1) limit = std::min(limit, limit_along("/sys/fs/cgroup", group, "memory.max"));
    if (line.find("memory", first) < second)
      limit = std::min(limit, limit_along("/sys/fs/cgroup/memory", group, "memory.limit_in_bytes"));
  }
  return limit;
}

}  // namespace

std::uint64_t machine_memory() {
  const auto physical =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  return std::min(physical, group_limit());
}

std::uint64_t resident_memory() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t all = 0;
  std::uint64_t resident = 0;  // pages
  file >> all >> resident;
  return resident * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
}

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_MMAP_THRESHOLD, kKept);
  mallopt(M_TRIM_THRESHOLD, kKept);
#endif
}

// What is freed at the heap's end below the threshold of keep_freed_memory() stays the heap's, marked as it is.
void begin_heap_with_huge_pages() {
#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)
  constexpr std::size_t kHugePage = 2 << 20;
  std::size_t room = kKept - kHugePage;
  void* const heap = std::malloc(room);
  void* first = heap;
  if (std::align(kHugePage, kHugePage, first, room) != nullptr)
    madvise(first, room / kHugePage * kHugePage, MADV_HUGEPAGE);
  std::free(heap);
#endif
}

void return_free_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

}  // namespace tinsmith
