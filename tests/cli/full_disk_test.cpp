// Disks that fill up at any moment, and then have room.

#include "cli/faults_fixture.hpp"

namespace tinsmith::test {
namespace {

constexpr unsigned kSeed = 4;
constexpr int kSizes = 10;
constexpr std::uint64_t kPage = 4096;

class Filled : public FaultsTest {
 protected:
  Words words_for(const std::string& target) const {
    return {"compress", path("dem.tif"), target, "--max-error", "0.1", "--window", "32"};
  }

  /// Between nothing and a little less than all that it takes.
  static std::uint64_t random_size(std::uint64_t most, std::mt19937& random) {
    return kPage * (2 + random() % (most / kPage - 2));
  }

  /// The most bytes that the unfinished work takes: all of the last round, and the output.
  std::uint64_t work_size(const Words& words) const {
    finish_all_but_the_output(words);
    std::uint64_t bytes = 0;
    for (const fs::path& file : work_files(work())) bytes += fs::file_size(file);
    return bytes;
  }
};

TEST_F(Filled, ByUnfinishedWorkItGoesOnWhenThereIsRoom) {
  hill("dem.tif", 200);
  const std::string bytes = undisturbed(words_for(output()));
  const std::uint64_t most = work_size(words_for(output()));
  fs::remove_all(work());
  std::mt19937 random(kSeed);
  for (int i = 0; i < kSizes; ++i) {
    const std::uint64_t size = random_size(most, random);
    const SmallDisk disk(path("disk"), size);
    if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
    write_text("out.ply", "old");
    Words words = words_for(output());
    words.insert(words.end(), {"--tmp", path("disk")});
    expect_no_output(run(words), {path("disk"), "No space left", "make room", "the same command", "goes on"});
    EXPECT_EQ(text_of(output()), "old") << size;
    disk.resize(64 << 20);
    EXPECT_EQ(expect_goes_on(words, bytes), "") << size;
    EXPECT_TRUE(fs::is_empty(path("disk")));
  }
}

TEST_F(Filled, ByTheOutputItGoesOnWhenThereIsRoom) {
  hill("dem.tif", 200);
  const std::string bytes = undisturbed(words_for(output()));
  fs::create_directories(path("elsewhere"));
  std::mt19937 random(kSeed);
  for (int i = 0; i < kSizes; ++i) {
    const std::uint64_t size = random_size(bytes.size(), random);
    const SmallDisk disk(path("disk"), size);
    if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
    const std::string target = write_text("disk/out.ply", "old");
    Words words = words_for(target);
    words.insert(words.end(), {"--tmp", path("elsewhere")});
    expect_no_output(run(words), {target, "No space left", "make room"});
    EXPECT_EQ(text_of(target), "old");
    disk.resize(64 << 20);
    ASSERT_EQ(run(words).exit_code, 0);
    EXPECT_TRUE(text_of(target) == bytes) << size;
    EXPECT_TRUE(fs::is_empty(path("elsewhere")));
  }
}

// Without a file system of one's own: no file may become larger than that.
TEST_F(Filled, ByAnyFileItGoesOnWhenThereIsRoom) {
  hill("dem.tif", 200);
  const Words words = words_for(output());
  const std::string bytes = undisturbed(words);
  std::mt19937 random(kSeed);
  for (int i = 0; i < kSizes; ++i) {
    write_text("out.ply", "old");
    const std::uint64_t size = random_size(bytes.size(), random);
    expect_no_output(run(words, {.file_size = size}), {path(""), "File too large", "make room"});
    EXPECT_EQ(text_of(output()), "old") << size;
    expect_goes_on(words, bytes);
  }
}

}  // namespace
}  // namespace tinsmith::test
