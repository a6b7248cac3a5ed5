#include "base/name_lock.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/mesh_cases.hpp"

namespace tinsmith {
namespace {

TEST(NameLock, OneHoldsANameAtATimeAndNothingIsLeft) {
  const ScratchFolder folder;
  {
    const NameLock first(folder.file(""), "out.ply");
    EXPECT_TRUE(first.is_held());
    EXPECT_FALSE(NameLock(folder.file(""), "out.ply").is_held());
    EXPECT_FALSE(NameLock(folder.file(""), "out.ply").is_held()) << "who asks takes nothing away";
    EXPECT_TRUE(NameLock(folder.file(""), "other.ply").is_held());
  }
  EXPECT_TRUE(NameLock(folder.file(""), "out.ply").is_held());
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(NameLock, WithoutAFolderToReadEveryoneHoldsIt) {
  EXPECT_TRUE(NameLock("/no/such/folder", "out.ply").is_held());
}

}  // namespace
}  // namespace tinsmith
