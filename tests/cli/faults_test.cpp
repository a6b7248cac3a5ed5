// Two runs at once, and runs that find another world than the one they left.

#include <array>
#include <set>

#include "cli/faults_fixture.hpp"

namespace tinsmith::test {
namespace {

constexpr uid_t kNobody = 65534;

class Faults : public FaultsTest {
 protected:
  Faults() { hill("dem.tif", 260); }

  Words words(const std::string& max_error = "0.1") const {
    return {"compress", path("dem.tif"), output(), "--max-error", max_error, "--window", "32", "--no-verify"};
  }

  void expect_other_run(const Words& other, const std::vector<std::string>& says) const {
    std::vector<std::string> all{"unfinished run", "--fresh"};
    all.insert(all.end(), says.begin(), says.end());
    expect_complaint(other, 2, all);
    EXPECT_TRUE(has_index()) << "the work is still there";
  }
};

TEST_F(Faults, ASecondRunOnOneOutputIsRefusedAndTheFirstGoesOn) {
  const std::string bytes = undisturbed(words());
  const Running first = start(words(), {}, "said.first");
  ASSERT_TRUE(while_it_stands(
      first, [&] { return has_index(); },
      [&] {
        expect_no_output(run(words()), {output(), "another run is at work"});
        expect_no_output(run(words("0.2")), {output(), "another run is at work"});
        Words fresh = words();
        fresh.push_back("--fresh");
        expect_no_output(run(fresh), {output(), "another run is at work"});
      }));
  EXPECT_EQ(wait_for(first).exit_code, 0);
  EXPECT_TRUE(text_of(output()) == bytes);
  EXPECT_FALSE(fs::exists(work()));
}

TEST_F(Faults, ASecondRunIsRefusedWhereverItsUnfinishedWorkIs) {
  const std::string bytes = undisturbed(words());
  fs::create_directories(path("elsewhere"));
  Words with_tmp = words();
  with_tmp.insert(with_tmp.end(), {"--tmp", path("elsewhere")});
  const std::array<std::array<Words, 2>, 2> pairs{{{words(), with_tmp}, {with_tmp, words()}}};
  for (const auto& [one, other] : pairs) {
    const Running first = start(one, {}, "said.first");
    const std::string work_of_one = one.size() == words().size() ? work() : path("elsewhere");
    ASSERT_TRUE(while_it_stands(
        first, [&] { return !work_files(work_of_one).empty(); },
        [&, &second = other] {
          expect_no_output(run(second), {output(), "another run is at work"});
        }));
    EXPECT_EQ(wait_for(first).exit_code, 0);
    EXPECT_TRUE(take_output() == bytes);
  }
  const Running killed = start(with_tmp);
  ASSERT_TRUE(wait_until(killed, [&] { return !work_files(path("elsewhere")).empty(); }));
  kill(killed.process, SIGKILL);
  wait_for(killed);
  EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "elsewhere"})) << "beside the output nothing is left";
  expect_goes_on(words(), bytes);
}

TEST_F(Faults, OtherOptionsNeedAFreshStart) {
  const std::string bytes = undisturbed(words());
  const std::string bytes_of_other = undisturbed(words("0.2"));
  leave_unfinished(words());
  expect_other_run(words("0.2"), {"'max error: 0.1' then, 'max error: 0.2' now"});
  Words with_window = words();
  with_window[6] = "48";
  expect_other_run(with_window, {"'window: 32' then, 'window: 48' now"});
  Words fresh = words("0.2");
  fresh.push_back("--fresh");
  expect_goes_on(fresh, bytes_of_other);
  Words in_one_thread = words();
  in_one_thread.insert(in_one_thread.end(), {"--threads", "1"});
  leave_unfinished(words());
  expect_goes_on(in_one_thread, bytes);  // what can't change the result may change
}

TEST_F(Faults, ASearchKeepsTheWorkOfOneAttemptAndGoesOn) {
  const Words search{"compress", path("dem.tif"), output(), "--triangles", "3000", "--window", "32", "--no-verify"};
  const std::string bytes = undisturbed(search);
  finish_all_but_the_output(search);
  std::set<fs::path> attempts;
  for (const fs::path& file : work_files(work()))
    if (file.parent_path() != work()) attempts.insert(file.parent_path());
  EXPECT_EQ(attempts.size(), 1U);
  expect_goes_on(search, bytes);
  const Running killed = start(search);
  ASSERT_TRUE(wait_until(killed, [&] { return fs::exists(work() + "/attempts"); }));
  kill(killed.process, SIGKILL);
  wait_for(killed);
  expect_goes_on(search, bytes);
}

TEST_F(Faults, OtherInputsNeedAFreshStart) {
  const std::string bytes = undisturbed(words());
  leave_unfinished(words());
  const auto time = fs::last_write_time(path("dem.tif"));
  fs::last_write_time(path("dem.tif"), time + std::chrono::seconds(2));
  expect_other_run(words(), {"input: " + path("dem.tif"), "of second"});
  std::string content = text_of(path("dem.tif"));
  std::string changed = content;
  const std::size_t samples_end = content.size() - 1;  // the last sample is one of those that are looked at
  changed[samples_end] = static_cast<char>(changed[samples_end] ^ 1);
  write_text("dem.tif", changed);
  fs::last_write_time(path("dem.tif"), time);
  expect_other_run(words(), {"checksum"});
  write_text("dem.tif", content);
  fs::last_write_time(path("dem.tif"), time);
  expect_goes_on(words(), bytes);
}

TEST_F(Faults, AStartThatKeptNothingIsNoObstacle) {
  const std::string bytes = undisturbed(words());
  fs::create_directory(work());
  write_text(".out.ply.tinsmith/run", "torn");
  expect_goes_on(words(), bytes);
}

TEST_F(Faults, AFolderThatMayNotBeWrittenIsNamedAtOnce) {
  if (geteuid() != 0) GTEST_SKIP() << "only the superuser can run it for others";
  fs::create_directory(path("locked"));
  fs::permissions(path("locked"), fs::perms::owner_all | fs::perms::others_read | fs::perms::others_exec);
  Words there = words();
  there[2] = path("locked/out.ply");
  expect_no_output(run(there, {.user = kNobody}), {path("locked/out.ply"), "denied"});
  fs::create_directory(path("open"));
  fs::permissions(path("open"), fs::perms::all);
  Words with_tmp = words();
  with_tmp[2] = path("open/out.ply");
  with_tmp.insert(with_tmp.end(), {"--tmp", path("locked")});
  expect_no_output(run(with_tmp, {.user = kNobody}), {path("locked"), "denied", "--tmp"});
}

TEST_F(Faults, UnfinishedWorkMayLieOnAnotherDevice) {
  const std::string bytes = undisturbed(words());
  const SmallDisk disk(path("disk"), 64 << 20);
  if (!disk.is_there()) GTEST_SKIP() << "no file system can be mounted here";
  Words with_tmp = words();
  with_tmp.insert(with_tmp.end(), {"--tmp", path("disk")});
  const Running running = start(with_tmp);
  ASSERT_TRUE(wait_until(running, [&] { return !work_files(path("disk")).empty(); }));
  kill(running.process, SIGKILL);
  wait_for(running);
  expect_goes_on(with_tmp, bytes);
  EXPECT_TRUE(fs::is_empty(path("disk")));
}

TEST_F(Faults, AnOutputThatBecameAFolderIsNamedAndTheWorkKept) {
  const std::string bytes = undisturbed(words());
  finish_all_but_the_output(words());
  expect_goes_on(words(), bytes);
}

}  // namespace
}  // namespace tinsmith::test
