#include "base/machine_memory.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tinsmith {
namespace {

TEST(MachineMemory, IsAtLeastWhatThisTestNeeds) {
  EXPECT_GT(machine_memory(), std::uint64_t{1} << 26);
  EXPECT_LT(machine_memory(), std::uint64_t{1} << 50);
}

// Sanitizers have a heap of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
struct Mapping {
  bool is_there = false;
  bool asks_for_huge_pages = false;
};

/// What the system says of the mapping that holds an address.
Mapping mapping_of(const void* address) {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  Mapping mapping;
  std::ifstream file("/proc/self/smaps");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::uintptr_t first = 0;
    std::uintptr_t last = 0;
    char dash = 0;
    if (words >> std::hex >> first >> dash >> last && dash == '-') {
      if (mapping.is_there) return mapping;
      mapping.is_there = first <= wanted && wanted < last;
    } else if (mapping.is_there && line.starts_with("VmFlags:")) {
      mapping.asks_for_huge_pages = line.find(" hg") != std::string::npos;
    }
  }
  return mapping;
}

TEST(MachineMemory, BeginsTheHeapWithHugePagesWithoutTakingThem) {
  if (!std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled")) return;  // the system has none
  const std::uint64_t before = resident_memory();
  keep_freed_memory();
  begin_heap_with_huge_pages();
  EXPECT_LT(resident_memory(), before + (4 << 20));
  const std::vector<char> block(8 << 20, 1);
  const Mapping mapping = mapping_of(&block[block.size() / 2]);
  ASSERT_TRUE(mapping.is_there);
  EXPECT_TRUE(mapping.asks_for_huge_pages);
}
#endif

}  // namespace
}  // namespace tinsmith
