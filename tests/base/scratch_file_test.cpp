#include "base/scratch_file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <vector>

#include "base/machine_memory.hpp"
#include "io/mesh_cases.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

/// Files of this process can't grow beyond it, as if the disk were full.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;
  ~FileLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};

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
  const FileLimit limit(8000);
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

TEST(MachineMemory, IsAtLeastWhatThisTestNeeds) {
  EXPECT_GT(machine_memory(), std::uint64_t{1} << 26);
  EXPECT_LT(machine_memory(), std::uint64_t{1} << 50);
}

}  // namespace
}  // namespace tinsmith
