#pragma once
// The real program, started as a user would, and what it said.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "io/raster_fixture.hpp"

namespace tinsmith::test {

struct Outcome {
  int exit_code = -1;  // -1: ended by a signal
  std::string out;
  std::string err;
  double cpu_seconds = 0;  // user and system
  double peak_bytes = 0;
};

/// A program at work; what it says goes to files of this name.
struct Running {
  pid_t process = -1;
  std::string name;
};

struct Limits {
  std::optional<rlim_t> file_size{};  // bytes: the disk is full when a file is as large
  std::optional<uid_t> user{};        // for whom the superuser runs it
};

inline std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void send_output_to(const std::string& path, int descriptor) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  dup2(file, descriptor);
  close(file);
}

class CliTest : public RasterTest {
 protected:
  /// The words of a command line after the program's name.
  Outcome run(const std::vector<std::string>& words, const Limits& limits = {}) const {
    return wait_for(start(words, limits));
  }

  /// Sends SIGINT as soon as it is_so.
  template <class Condition>
  Outcome run_until(Condition is_so, const std::vector<std::string>& words) const {
    const Running running = start(words);
    if (wait_until(running, [&] { return is_so(running); })) kill(running.process, SIGINT);
    return wait_for(running);
  }

  /// Waits until it is so, or the program has ended: then false.
  template <class Condition>
  bool wait_until(const Running& running, Condition is_so) const {
    while (!is_so()) {
      siginfo_t ended{};
      waitid(P_PID, static_cast<id_t>(running.process), &ended, WEXITED | WNOHANG | WNOWAIT);
      if (ended.si_pid != 0) return false;
      usleep(200);
    }
    return true;
  }

  Running start(std::vector<std::string> words, const Limits& limits = {}, const std::string& name = "said") const {
    words.insert(words.begin(), TINSMITH_BINARY_DIR "/tinsmith");
    const pid_t child = fork();
    if (child == 0) become_program(words, limits, name);
    return {child, name};
  }

  Outcome wait_for(const Running& running) const {
    int status = 0;
    rusage usage{};
    wait4(running.process, &status, 0, &usage);
    const auto seconds = [](const timeval& time) {
      return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec) * 1e-6;
    };
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(said(running.name, "out")),
            text_of(said(running.name, "err")), seconds(usage.ru_utime) + seconds(usage.ru_stime),
            static_cast<double>(usage.ru_maxrss) * 1024};
  }

  /// The files in which the finished windows are kept, the index among them, sorted.
  std::vector<std::filesystem::path> work_files(const std::string& folder) const {
    std::vector<std::filesystem::path> found;
    if (!std::filesystem::exists(folder)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
      if (entry.is_regular_file() && entry.path().filename() != "run" && entry.path().filename() != "lock")
        found.push_back(entry.path());
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Whether the program has come so far as to catch SIGINT.
  static bool catches_interrupts(const Running& running) {
    std::ifstream status("/proc/" + std::to_string(running.process) + "/status");
    for (std::string word; status >> word;) {
      if (word != "SigCgt:") continue;
      std::uint64_t caught = 0;
      status >> std::hex >> caught;
      return (caught >> (SIGINT - 1) & 1) != 0;
    }
    return false;
  }

  /// The file that holds what a program of the name said on a stream, "out" or "err".
  std::string said(const std::string& name, const char* stream) const { return path(name + "." + stream); }

  /// A smooth hill of size x size samples of 30 m.
  std::string hill(const std::string& name, int size, const RasterRecipe& like = {}) const {
    RasterRecipe recipe = like;
    recipe.width = recipe.height = size;
    recipe.type = GDT_Float32;
    recipe.values.clear();
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x)
        recipe.values.push_back(500 + 200 * std::sin(x * 0.11) * std::cos(y * 0.07) + 3 * std::sin(x * 1.7 + y));
    return write(name, recipe);
  }

  /// Exit code, one line on standard error with these words, nothing on standard output.
  void expect_complaint(const std::vector<std::string>& words, int exit_code, const std::vector<std::string>& says,
                        const Limits& limits = {}) const {
    const Outcome outcome = run(words, limits);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_TRUE(outcome.err.starts_with("tinsmith: ")) << outcome.err;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    for (const std::string& word : says)
      EXPECT_NE(outcome.err.find(word), std::string::npos) << word << " in: " << outcome.err;
  }

  /// An input that compress can't use: exit code 3, and what stood at the output still stands there, alone.
  void expect_unusable(const std::string& input, const std::vector<std::string>& says,
                       const std::vector<std::string>& options = {}) const {
    const std::string output = write_text("old.ply", "old");
    const std::size_t n_files = files().size();
    std::vector<std::string> words{"compress", input, output, "--max-error", "1"};
    words.insert(words.end(), options.begin(), options.end());
    expect_complaint(words, 3, says);
    EXPECT_EQ(text_of(output), "old");
    EXPECT_EQ(files().size(), n_files);
  }

  /// All in the test's folder but what the program said.
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path("")))
      if (!entry.path().filename().string().starts_with("said.")) names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  [[noreturn]] void become_program(const std::vector<std::string>& words, const Limits& limits,
                                   const std::string& name) const {
    send_output_to(said(name, "out"), STDOUT_FILENO);
    send_output_to(said(name, "err"), STDERR_FILENO);
    if (limits.user && setuid(*limits.user) != 0) _exit(126);
    if (limits.file_size) {
      const rlimit limit{*limits.file_size, *limits.file_size};
      setrlimit(RLIMIT_FSIZE, &limit);
    }
    std::vector<char*> arguments;
    for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    execv(arguments.front(), arguments.data());
    _exit(127);
  }
};

}  // namespace tinsmith::test
