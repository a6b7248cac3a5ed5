// Disks that fill up at any moment, and then have room.

#include "cli/faults_fixture.hpp"

namespace tinsmith::test {
namespace {

constexpr unsigned kSeed = 4;
constexpr int kSizes = 10;
constexpr std::uint64_t kPage = 4096;
constexpr std::uint64_t kAmple = 64 << 20;

class Filled : public FaultsTest {
 protected:
  Words words_for(const std::string& target) const {
    return {"compress", path("dem.tif"), target, "--max-error", "0.1", "--window", "32"};
  }

  /// To that size, or what is in it where that is more.
  static void shrink(const SmallDisk& disk, const std::string& folder, std::uint64_t size) {
    const fs::space_info space = fs::space(folder);
    disk.resize(std::max<std::uint64_t>(size, space.capacity - space.free + kPage));
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
    const SmallDisk disk(path("disk"), kAmple);
    if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
    write_text("out.ply", "old");
    Words words = words_for(output());
    words.insert(words.end(), {"--tmp", path("disk")});
    const std::uint64_t size = random_size(most, random);
    const Running running = start(words);
    if (while_it_stands(
            running, [&] { return !work_files(path("disk")).empty(); }, [&] { shrink(disk, path("disk"), size); }))
      expect_no_output(wait_for(running),
                       {path("disk"), "No space left", "make room", "the same command", "goes on"});
    EXPECT_EQ(text_of(output()), "old") << size;
    disk.resize(kAmple);
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
    const SmallDisk disk(path("disk"), kAmple);
    if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
    const std::string target = write_text("disk/out.ply", "old");
    Words words = words_for(target);
    words.insert(words.end(), {"--tmp", path("elsewhere")});
    const Running running = start(words);
    ASSERT_TRUE(while_it_stands(
        running, [&] { return !work_files(path("elsewhere")).empty(); }, [&] { disk.resize(size); }));
    expect_no_output(wait_for(running), {target, "No space left", "make room"});
    EXPECT_EQ(text_of(target), "old");
    disk.resize(kAmple);
    ASSERT_EQ(run(words).exit_code, 0);
    EXPECT_TRUE(text_of(target) == bytes) << size;
    EXPECT_TRUE(fs::is_empty(path("elsewhere")));
  }
}

// Less than a quarter of what is expected is free: nothing is begun. A little less than all: it is tried.
class Small : public Filled {
 protected:
  Small() { hill("dem.tif", 400); }

  void expect_refused(const Words& words, const std::string& disk, const std::string& what) const {
    const std::vector<std::string> says{disk, "about", what, "are expected", "are free", "make room"};
    expect_complaint(words, 5, says);
    Words planned = words;
    planned.push_back("--plan");
    expect_complaint(planned, 5, says);
  }
};

TEST_F(Small, DiskForUnfinishedWorkIsRefusedAtTheStart) {
  const SmallDisk disk(path("disk"), 100 * kPage);
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  Words words = words_for(output());
  words.insert(words.end(), {"--tmp", path("disk")});
  expect_refused(words, path("disk"), "of unfinished work");
  EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "disk"}));
  EXPECT_TRUE(fs::is_empty(path("disk")));
}

TEST_F(Small, DiskForTheOutputIsRefusedAtTheStart) {
  const SmallDisk disk(path("disk"), 100 * kPage);
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  fs::create_directories(path("elsewhere"));
  Words words = words_for(path("disk/out.ply"));
  words.insert(words.end(), {"--tmp", path("elsewhere")});
  expect_refused(words, path("disk"), "of output");
  words.resize(words.size() - 2);
  expect_refused(words, path("disk"), "of unfinished work and output");
  EXPECT_TRUE(fs::is_empty(path("disk")));
  EXPECT_TRUE(fs::is_empty(path("elsewhere")));
}

TEST_F(Small, DiskThatMayDoIsTriedWithAWarning) {
  const SmallDisk disk(path("disk"), kAmple);
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  Words words = words_for(output());
  words.insert(words.end(), {"--tmp", path("disk"), "--no-verify", "--plan", "--json", "-"});
  const auto expected = nlohmann::json::parse(run(words).out)["expected_scratch_bytes"].get<std::uint64_t>();
  disk.resize(expected / kPage * kPage / 10 * 9);
  const auto planned = run(words);
  EXPECT_EQ(planned.exit_code, 0);
  EXPECT_NE(planned.err.find("are expected and"), std::string::npos) << planned.err;
  EXPECT_EQ(nlohmann::json::parse(planned.out)["doubts"].size(), 1U);
  words.resize(words.size() - 3);
  const Outcome begun = run(words);
  EXPECT_NE(begun.exit_code, 5);
  EXPECT_NE(begun.err.find("are expected and"), std::string::npos) << begun.err;
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
