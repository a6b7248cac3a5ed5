#pragma once
// A run that is killed again and again, and what that costs.

#include <cmath>
#include <fstream>
#include <string>

#include "cli/faults_fixture.hpp"

namespace tinsmith::test {

/// A run that nothing disturbs: its time from the start to the writing and to the end, in seconds.
struct Course {
  double until_written_to = 0;
  double total = 0;
  double output_bytes = 0;
  double cpu_seconds = 0;  // without the start of the program
  double peak_bytes = 0;
};

struct Killings {
  int n = 0;
  int n_said = 0;   // runs that were asked to end and said how to go on
  int n_whole = 0;  // runs that did all of their work: the last one, and those whose kill came too late
  std::map<std::string, int> by_stage;
  double cpu_seconds = 0;  // of all runs without their starts
  double peak_bytes = 0;   // the most of any
  double longest_end = 0;  // seconds from the signal to the end
};

class KillTest : public FaultsTest {
 protected:
  using Clock = std::chrono::steady_clock;

  static double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
  }

  Course follow(const Words& words) const {
    const Course start_up = start_up_of(words);
    Course course;
    const auto start_time = Clock::now();
    const Running running = start(words);
    wait_until(running, [&] { return bytes_written(running.process) > 0; });
    course.until_written_to = seconds_since(start_time);
    const Outcome outcome = wait_for(running);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    course.total = seconds_since(start_time);
    course.output_bytes = static_cast<double>(fs::file_size(output()));
    course.cpu_seconds = outcome.cpu_seconds - start_up.cpu_seconds;
    course.peak_bytes = outcome.peak_bytes;
    return course;
  }

  /// Kills the run at random moments of the course, the last `n_writing` of them while the output is written, goes
  /// on each time, and at last lets it come to its end.
  Killings kill_again_and_again(const Words& words, const Course& course, int signal, int n, int n_writing,
                                std::mt19937& random) const {
    Killings killings;
    const Course start_up = start_up_of(words);
    const double part = (course.until_written_to - start_up.total) / (n - n_writing);
    std::uniform_real_distribution<double> share(0, 1);
    for (int i = 0; i < n; ++i) {
      const Running running = start(words);
      if (signal != SIGKILL) wait_until(running, [&] { return catches(running.process, signal); });
      if (i < n - n_writing) {
        // A little less than the parts of an undisturbed run: what is lost at each kill has to be done as well.
        sleep_for(start_up.total + 1.8 * share(random) * part);
      } else {
        const double bytes = 0.8 * share(random) * course.output_bytes;
        wait_until(running, [&] { return bytes_written(running.process) > bytes; });
      }
      end(running, signal, course, killings);
    }
    const Outcome last = run(words);
    EXPECT_EQ(last.exit_code, 0) << last.err;
    add(last, killings);
    ++killings.n_whole;
    killings.cpu_seconds -= (killings.n + killings.n_whole) * start_up.cpu_seconds;
    return killings;
  }

  /// How much more was done in all than without the kills; the starts of the program don't count.
  static double work_ratio(const Killings& killings, const Course& course) {
    return killings.cpu_seconds / (killings.n_whole * course.cpu_seconds);
  }

  static void print(const Killings& killings, const Course& course) {
    std::printf("  %d times in %d runs:", killings.n, killings.n_whole);
    for (const auto& [stage, n] : killings.by_stage) std::printf(" %d in %s", n, stage.c_str());
    const double ratio = work_ratio(killings, course);
    std::printf(
        "; work %.3f x of %.2f s, %.1f ms lost each; %.0f ms to end at most; peak %.0f MiB, undisturbed %.0f\n",
        ratio, course.cpu_seconds, (ratio - 1) * killings.n_whole * course.cpu_seconds / killings.n * 1000,
        killings.longest_end * 1000, killings.peak_bytes / 1048576, course.peak_bytes / 1048576);
  }

 private:
  static void sleep_for(double seconds) { usleep(static_cast<useconds_t>(seconds * 1e6)); }

  /// Whether the program has come so far that a signal does not just end it.
  static bool catches(pid_t process, int signal) {
    std::ifstream status("/proc/" + std::to_string(process) + "/status");
    for (std::string line; std::getline(status, line);)
      if (line.starts_with("SigCgt:")) return std::stoull(line.substr(7), nullptr, 16) >> (signal - 1) & 1;
    return false;
  }

  /// The same on a raster of a few samples.
  Course start_up_of(Words words) const {
    words[1] = hill("few.tif", 8);
    words[2] = path("few.ply");
    const auto start_time = Clock::now();
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    fs::remove(words[1]);
    fs::remove(words[2]);
    return {0, seconds_since(start_time), 0, outcome.cpu_seconds, outcome.peak_bytes};
  }

  void end(const Running& running, int signal, const Course& course, Killings& killings) const {
    const bool was_writing = bytes_written(running.process) > 0;
    const auto start_time = Clock::now();
    kill(running.process, signal);
    const Outcome outcome = wait_for(running);
    killings.longest_end = std::max(killings.longest_end, seconds_since(start_time));
    add(outcome, killings);
    if (fs::exists(output())) {  // too late, even if the program was still about to tidy up and exit
      ++killings.n_whole;
      EXPECT_TRUE(outcome.exit_code == 0 || outcome.exit_code == (signal == SIGKILL ? -1 : 130)) << outcome.err;
      EXPECT_EQ(static_cast<double>(fs::file_size(output())), course.output_bytes);
      fs::remove(output());
      fs::remove_all(work());
      return;
    }
    ++killings.n;
    ++killings.by_stage[was_writing ? "write" : stage_reached()];
    if (signal == SIGKILL) return;
    ++killings.n_said;
    EXPECT_EQ(outcome.exit_code, 130) << outcome.err;
    EXPECT_NE(outcome.err.find("the same command goes on from here"), std::string::npos) << outcome.err;
  }

  static void add(const Outcome& outcome, Killings& killings) {
    killings.cpu_seconds += outcome.cpu_seconds;
    killings.peak_bytes = std::max(killings.peak_bytes, outcome.peak_bytes);
  }

  std::string stage_reached() const {
    std::string stage = "start";
    for (const fs::path& file : work_files(work()))
      if (file.filename().string().starts_with("round-")) stage = file.filename().string().substr(0, 7);
    return stage;
  }
};

}  // namespace tinsmith::test
