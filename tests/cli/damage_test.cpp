// Unfinished work that is damaged on the disk is found, computed anew, and said.

#include "cli/faults_fixture.hpp"

namespace tinsmith::test {
namespace {

constexpr unsigned kSeed = 31;

enum class Damage { kFlippedBit, kTruncated, kRemoved };

void inflict(Damage damage, const fs::path& file, std::mt19937& random) {
  const std::uint64_t place = random() % std::max<std::uint64_t>(fs::file_size(file), 1);
  if (damage == Damage::kRemoved) fs::remove(file);
  if (damage == Damage::kTruncated) fs::resize_file(file, place);
  if (damage != Damage::kFlippedBit) return;
  std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
  stream.seekg(static_cast<std::streamoff>(place));
  const int byte = stream.get() ^ (1 << random() % 8);
  stream.seekp(static_cast<std::streamoff>(place));
  stream.put(static_cast<char>(byte));
}

class Damaged : public FaultsTest {
 protected:
  Damaged() { hill("dem.tif", 260); }

  Words words() const {
    return {"compress", path("dem.tif"), output(), "--max-error", "0.1", "--window", "32", "--no-verify"};
  }
};

TEST_F(Damaged, PartsAreComputedAnew) {
  const std::string bytes = undisturbed(words());
  std::mt19937 random(kSeed);
  int n_said = 0;
  constexpr int kTrials = 9;
  for (int trial = 0; trial < kTrials; ++trial) {
    leave_unfinished(words(), 2000 + random() % 10000);
    const auto files = work_files(work());
    ASSERT_GT(files.size(), 1U);
    inflict(static_cast<Damage>(trial % 3), files[1 + random() % (files.size() - 1)], random);
    const std::string said = expect_goes_on(words(), bytes);
    if (said.find("computed anew") != std::string::npos) ++n_said;
    fs::remove(output());
  }
  // What was read already is not looked at again.
  EXPECT_GE(n_said, kTrials / 2) << "the seed is " << kSeed;
}

TEST_F(Damaged, IndexIsFound) {
  const std::string bytes = undisturbed(words());
  std::mt19937 random(kSeed);
  for (int trial = 0; trial < 6; ++trial) {
    leave_unfinished(words(), 2000 + random() % 10000);
    inflict(static_cast<Damage>(trial % 3), work_files(work()).front(), random);
    const std::string said = expect_goes_on(words(), bytes);
    EXPECT_NE(said.find("/index: "), std::string::npos) << said;
    EXPECT_NE(said.find("computed anew"), std::string::npos) << said;
    fs::remove(output());
  }
}

TEST_F(Damaged, IsSaidInTheReport) {
  undisturbed(words());
  leave_unfinished(words());
  std::mt19937 random(kSeed);
  inflict(Damage::kFlippedBit, work_files(work()).front(), random);
  Words reporting = words();
  reporting.insert(reporting.end(), {"--json", "-"});
  const auto report = nlohmann::json::parse(run(reporting).out);
  ASSERT_EQ(report["remarks"].size(), 1U);
  EXPECT_NE(report["remarks"][0].get<std::string>().find("computed anew"), std::string::npos);
}

TEST_F(Damaged, WhileItIsReadIsComputedAnew) {
  hill("dem.tif", 500);  // whose writing takes some time
  const std::string bytes = undisturbed(words());
  int n_said = 0;
  // On a busy machine a run may be over before it is met writing.
  constexpr int kRows = 4;
  constexpr int kMostRuns = 10 * kRows;
  for (int i = 0; i < kRows || (n_said == 0 && i < kMostRuns); ++i) {
    finish_all_but_the_output(words());
    const fs::path file = work_files(work()).back().parent_path() / ("round-2-row-" + std::to_string(i % kRows));
    ASSERT_TRUE(fs::exists(file));
    // Nothing is in the memory of this run: it writes what it reads.
    const Running running = start(words());
    while_it_stands(
        running, [&] { return is_writing(running.process); },
        [&] {
          if (fs::exists(file)) fs::resize_file(file, fs::file_size(file) / 2);
        });
    const Outcome outcome = wait_for(running);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(text_of(output()) == bytes);
    if (outcome.err.find("are damaged; computed anew") != std::string::npos) ++n_said;
    EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "out.ply"}));
    fs::remove(output());
  }
  EXPECT_GE(n_said, 1);
}

TEST_F(Damaged, AFolderInPlaceOfAFileIsNamed) {
  const std::string bytes = undisturbed(words());
  leave_unfinished(words());
  const fs::path file = work_files(work())[1];
  fs::remove(file);
  fs::create_directory(file);
  expect_no_output(run(words()), {file.string(), "directory"});
  fs::remove(file);
  expect_goes_on(words(), bytes);
}

TEST_F(Damaged, WhatMayNotBeReadIsNamed) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can leave files to others";
  fs::permissions(path(""), fs::perms::all);
  constexpr uid_t kNobody = 65534;
  const std::string bytes = undisturbed(words());
  leave_unfinished(words());
  expect_no_output(run(words(), {.user = kNobody}), {work(), "denied", "--tmp"});
  expect_goes_on(words(), bytes);
}

}  // namespace
}  // namespace tinsmith::test
