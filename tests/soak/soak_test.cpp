// The long version of tests/cli/kill_test.cpp, by `cmake --build build --target soak`: 67 million samples in 256
// MiB, killed 25 times. TINSMITH_SOAK_SIZE=WIDTHxHEIGHT takes another size.

#include <cstdlib>

#include "cli/kill_plan.hpp"

namespace tinsmith::test {
namespace {

constexpr unsigned kSeed = 67;
constexpr int kKills = 25;
constexpr int kWhileWriting = 4;
constexpr double kMemory = 256.0 * 1024 * 1024;

class Soak : public KillTest {
 protected:
  /// Mountains in 1024 windows.
  Words words() const {
    const char* size = std::getenv("TINSMITH_SOAK_SIZE");
    const std::string command = std::string(TINSMITH_BINARY_DIR "/make_terrain --type int16 --size ") +
                                (size ? size : "8193x8193") + " " + path("dem.tif");
    EXPECT_EQ(std::system(command.c_str()), 0);
    return {"compress", path("dem.tif"), output(), "--max-error", "20", "--memory", "256M", "--no-verify"};
  }
};

TEST_F(Soak, KilledTwentyFiveTimesGivesTheSameBytesInTheMemory) {
  const Words words = this->words();
  const Course course = follow(words);
  std::printf("  undisturbed: %.1f s, %.1f s of them until the writing\n", course.total, course.until_written_to);
  const std::string undisturbed_output = path("undisturbed.ply");
  fs::rename(output(), undisturbed_output);
  std::mt19937 random(kSeed);
  Killings killings = kill_again_and_again(words, course, SIGKILL, kKills, kWhileWriting, random);
  print(killings, course);
  EXPECT_TRUE(text_of(output()) == text_of(undisturbed_output));
  EXPECT_EQ(files(), (std::vector<std::string>{"dem.tif", "out.ply", "undisturbed.ply"}));
  EXPECT_GE(killings.n, kKills - 2) << "the seed is " << kSeed;
  EXPECT_GE(killings.by_stage["write"], kWhileWriting / 2);
  EXPECT_LE(work_ratio(killings, course), 1.3);
  EXPECT_LE(std::max(killings.peak_bytes, course.peak_bytes), kMemory);
  const Outcome verified = run({"verify", path("dem.tif"), output(), "--max-error", "20", "--memory", "256M"});
  EXPECT_EQ(verified.exit_code, 0) << verified.err;
  EXPECT_LE(verified.peak_bytes, kMemory);
  std::printf("  verified in %.1f s of work, peak %.0f MiB\n", verified.cpu_seconds, verified.peak_bytes / 1048576);
}

}  // namespace
}  // namespace tinsmith::test
