#include "base/scratch_file.hpp"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <vector>

#include "io/mesh_cases.hpp"
#include "support/file_size_limit.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

TEST(ScratchFile, GivesBackWhatWasAppended) {
  const ScratchFolder folder;
  ScratchFile scratch(folder.file(""));
  const std::vector<int> first(1000, 7);
  const std::vector<int> second(3, 8);
  const std::uint64_t place_1 = scratch.append(first.data(), first.size() * sizeof(int));
  const std::uint64_t place_2 = scratch.append(second.data(), second.size() * sizeof(int));
  std::vector<int> read(3);
  scratch.read(place_2, read.data(), 3 * sizeof(int));
  EXPECT_EQ(read, second);
  scratch.read(place_1 + 997 * sizeof(int), read.data(), 3 * sizeof(int));
  EXPECT_EQ(read, std::vector<int>(3, 7));
}

TEST(ScratchFile, HasNoName) {
  const ScratchFolder folder;
  ScratchFile scratch(folder.file(""));
  scratch.append("abc", 3);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(ScratchFile, NamesTheFolderThatTakesNone) {
  const ScratchFolder folder;
  try {
    const ScratchFile scratch(folder.file("missing"));
    FAIL() << "a scratch file in a folder that is not there";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("missing"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("No such file"), std::string::npos) << error.what();
  }
}

TEST(ScratchFile, SaysWhenThereIsNoRoom) {
  const ScratchFolder folder;
  ScratchFile scratch(folder.file(""));
  const std::vector<char> bytes(5000);
  const test::FileSizeLimit limit(8000);
  EXPECT_NO_THROW(scratch.append(bytes.data(), bytes.size()));
  EXPECT_THROW(scratch.append(bytes.data(), bytes.size()), ResourceError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.file("")));
}

TEST(ScratchFile, RefusesToReadWhatIsNotThere) {
  const ScratchFolder folder;
  ScratchFile scratch(folder.file(""));
  std::array<char, 8> bytes{};
  scratch.append(bytes.data(), 4);
  EXPECT_THROW(scratch.read(0, bytes.data(), 8), ResourceError);
}

}  // namespace
}  // namespace tinsmith
