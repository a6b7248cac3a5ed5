// Runs that are killed or interrupted at any moment: nothing is lost but the windows at work.

#include "cli/kill_plan.hpp"

namespace tinsmith::test {
namespace {

constexpr unsigned kSeed = 20260;

Words mountains_to(const std::string& output) {
  const std::string input = TINSMITH_SOURCE_DIR "/data/matterhorn.tif";
  return {"compress", input, output, "--max-error", "5", "--window", "64", "--no-verify"};
}

class Killed : public KillTest {};

// A short version of tests/soak.
TEST_F(Killed, AtAnyMomentGoesOnToTheSameBytesWithLittleMoreWork) {
  const Words words = mountains_to(output());
  Course course = follow(words);
  const std::string bytes = take_output();
  std::mt19937 random(kSeed);
  Killings killings = kill_again_and_again(words, course, SIGKILL, 12, 4, random);
  EXPECT_TRUE(text_of(output()) == bytes);
  EXPECT_EQ(files(), (std::vector<std::string>{"out.ply"}));
  // A machine's speed may change meanwhile: undisturbed work is measured before and after.
  course.cpu_seconds = (course.cpu_seconds + follow(words).cpu_seconds) / 2;
  print(killings, course);
  EXPECT_GE(killings.n, 8) << "the seed is " << kSeed;
  EXPECT_GE(killings.by_stage["write"], 1);
  EXPECT_LE(work_ratio(killings, course), 1.3);
}

TEST_F(Killed, AskedToEndItSaysHowToGoOn) {
  const Words words = mountains_to(output());
  const Course course = follow(words);
  const std::string bytes = take_output();
  std::mt19937 random(kSeed);
  for (const int signal : {SIGINT, SIGTERM}) {
    const Killings killings = kill_again_and_again(words, course, signal, 4, 1, random);
    print(killings, course);
    EXPECT_GE(killings.n_said, 2);
    EXPECT_TRUE(text_of(output()) == bytes);
    EXPECT_EQ(files(), (std::vector<std::string>{"out.ply"}));
    fs::remove(output());
  }
}

TEST_F(Killed, WhileItVerifiesItDoesNotBeginAnew) {
  Words words = mountains_to(output());
  words.pop_back();
  const std::string bytes = undisturbed(words);
  for (const int signal : {SIGKILL, SIGINT}) {
    const Running running = start(words);
    ASSERT_TRUE(wait_until(running, [&] { return fs::exists(output()); }));
    kill(running.process, signal);
    const Outcome outcome = wait_for(running);
    EXPECT_EQ(outcome.exit_code, signal == SIGINT ? 130 : -1);
    if (signal == SIGINT)
      EXPECT_NE(outcome.err.find("is written, but not verified"), std::string::npos) << outcome.err;
    EXPECT_TRUE(text_of(output()) == bytes) << "whole, though not verified";
    EXPECT_TRUE(has_index());
    expect_goes_on(words, bytes);
    fs::remove(output());
  }
}

}  // namespace
}  // namespace tinsmith::test
