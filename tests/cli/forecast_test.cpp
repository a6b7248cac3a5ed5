// The time left.

#include "forecast.hpp"

#include <gtest/gtest.h>

namespace tinsmith::cli {
namespace {

Forecast::Clock::time_point after(double seconds) {
  return Forecast::Clock::time_point() +
         std::chrono::duration_cast<Forecast::Clock::duration>(std::chrono::duration<double>(seconds));
}

TEST(Forecast, OfARunCountsTheStagesToCome) {
  Forecast forecast(1000, {{"simplify", 0.8}, {"write", 0.02}, {"verify", 0.18}});
  for (double t = 0; t <= 80; t += 0.5) {
    const auto left = forecast.at(after(t), t / 80, "simplify").seconds_left;
    if (t > 1.5) EXPECT_NEAR(left.value_or(0), 100 - t, 1e-6) << t;
  }
  EXPECT_NEAR(forecast.at(after(80.6), 0.3, "write").seconds_left.value_or(19.4), 19.4, 3);
  for (double t = 82; t <= 100; t += 0.5) {
    const auto left = forecast.at(after(t), (t - 82) / 18, "verify").seconds_left;
    if (t > 84) EXPECT_NEAR(left.value_or(-1), 100 - t, 1e-6) << t;
  }
}

TEST(Forecast, OfAResumedRunIsThatOfItsOwnPace) {
  Forecast forecast(1000, {{"simplify", 0.8}, {"verify", 0.2}});
  for (double t = 0; t <= 20; t += 0.5) {
    const auto left = forecast.at(after(t), 0.75 + t / 80, "simplify").seconds_left;
    if (t > 1.5) EXPECT_NEAR(left.value_or(0), 40 - t, 1e-6) << t;
  }
}

TEST(Forecast, OfAStageWithoutOthersIsItsOwn) {
  Forecast forecast(1000, {{"simplify", 0.8}, {"verify", 0.2}});
  forecast.at(after(0), 0, "try 1");
  EXPECT_NEAR(forecast.at(after(10), 0.5, "try 1").seconds_left.value_or(0), 10, 1e-6);
  EXPECT_EQ(forecast.at(after(20), 1, "try 1").seconds_left, 0);
}

TEST(Forecast, SaysNothingBeforeItKnows) {
  Forecast forecast(1000, {{"simplify", 0.8}, {"write", 0.02}, {"verify", 0.18}});
  EXPECT_FALSE(forecast.at(after(0), 0, "simplify").seconds_left);
  EXPECT_FALSE(forecast.at(after(0.5), 0.01, "simplify").seconds_left);
  forecast.at(after(0.6), 0, "write");
  EXPECT_FALSE(forecast.at(after(3), 0.5, "write").seconds_left) << "how long the verification takes is not known";
}

}  // namespace
}  // namespace tinsmith::cli
