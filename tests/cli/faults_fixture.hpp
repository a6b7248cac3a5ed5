#pragma once
// Runs that are disturbed: killed, stopped in the middle, out of room.

#include <sys/mount.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "cli/run_program.hpp"

namespace tinsmith::test {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// A file system in memory of so many bytes; none where the user may not mount one.
class SmallDisk {
 public:
  SmallDisk(const std::string& folder, std::uint64_t bytes) : folder_(folder) {
    fs::create_directories(folder_);
    is_mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, size_of(bytes).c_str()) == 0;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (is_mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }

  bool is_there() const { return is_mounted_; }
  void resize(std::uint64_t bytes) const {
    EXPECT_EQ(mount("tmpfs", folder_.c_str(), "tmpfs", MS_REMOUNT, size_of(bytes).c_str()), 0);
  }

 private:
  static std::string size_of(std::uint64_t bytes) { return "size=" + std::to_string(bytes) + ",mode=0777"; }

  std::string folder_;
  bool is_mounted_ = false;
};

class FaultsTest : public CliTest {
 protected:
  std::string output() const { return path("out.ply"); }
  std::string work() const { return path(".out.ply.tinsmith"); }

  bool has_index() const {
    const auto files = work_files(work());
    return !files.empty() && fs::file_size(files.front()) > 0;
  }

  /// Whether this process, or any, has begun to write the output.
  bool is_writing(pid_t process = 0) const {
    const std::string prefix = ".tinsmith-out.ply-" + (process > 0 ? std::to_string(process) + "-" : "");
    for (const std::string& name : files())
      if (name.starts_with(prefix)) return true;
    return false;
  }

  /// Of the output, by this process.
  double bytes_written(pid_t process) const {
    // Before the work a probe of the same process stands there for a moment, empty.
    const std::string prefix = ".tinsmith-out.ply-" + std::to_string(process) + "-";
    double bytes = 0;
    for (const std::string& name : files()) {
      std::error_code gone;
      const std::uintmax_t size = name.starts_with(prefix) ? fs::file_size(path(name), gone) : 0;
      if (!gone) bytes += static_cast<double>(size);
    }
    return bytes;
  }

  /// Stops the program at a moment, does something, and lets it go on.
  template <class Condition, class Action>
  bool while_it_stands(const Running& running, Condition is_so, Action act) const {
    if (!wait_until(running, is_so)) return false;
    kill(running.process, SIGSTOP);
    siginfo_t stopped{};
    waitid(P_PID, static_cast<id_t>(running.process), &stopped, WSTOPPED | WEXITED | WNOWAIT);
    act();
    kill(running.process, SIGCONT);
    return true;
  }

  /// Interrupts a run when so many entries' bytes are in its index, and expects that it says so.
  void leave_unfinished(const Words& words, std::uint64_t index_bytes = 4000) const {
    const Running running = start(words);
    ASSERT_TRUE(wait_until(running, [&] {
      const auto files = work_files(work());
      return !files.empty() && fs::file_size(files.front()) > index_bytes;
    }));
    kill(running.process, SIGINT);
    const Outcome outcome = wait_for(running);
    ASSERT_EQ(outcome.exit_code, 130) << outcome.err;
  }

  /// Leaves a run with all windows done, by a folder in place of the output.
  void finish_all_but_the_output(const Words& words) const {
    const Running running = start(words);
    ASSERT_TRUE(while_it_stands(
        running, [&] { return has_index(); }, [&] { fs::create_directory(output()); }));
    expect_no_output(wait_for(running), {output(), "not a regular file"});
    ASSERT_TRUE(has_index());
    fs::remove(output());
  }

  /// Exit code 4 and one line with these words.
  static void expect_no_output(const Outcome& outcome, const std::vector<std::string>& says) {
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& word : says) EXPECT_NE(outcome.err.find(word), std::string::npos) << outcome.err;
  }

  /// The bytes that nothing disturbed; leaves nothing.
  std::string undisturbed(const Words& words) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return take_output();
  }

  std::string take_output() const {
    std::string bytes = text_of(output());
    fs::remove(output());
    return bytes;
  }

  /// The same command again: done, these bytes, and nothing else left. Returns what it remarked.
  std::string expect_goes_on(const Words& words, const std::string& bytes) const {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(text_of(output()) == bytes) << "other bytes than undisturbed";
    EXPECT_FALSE(fs::exists(work()));
    EXPECT_FALSE(is_writing());
    return outcome.err;
  }
};

}  // namespace tinsmith::test
