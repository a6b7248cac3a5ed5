#include "progress_bar.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>

#include "interrupt.hpp"
#include "text.hpp"

namespace tinsmith::cli {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRoomForWords = 105;  // columns of a terminal
constexpr double kSecondsBetweenDraws = 0.1;
constexpr double kSecondsBeforeForecast = 1;  // the first moments say little about the rest

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

// "0...10...20." up to the fraction done: four characters for each tenth.
std::string ruler(double fraction) {
  constexpr std::string_view kRuler = "0...10...20...30...40...50...60...70...80...90...100";
  const auto n_ticks = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * 40);
  std::string text = "0";
  for (int tick = 1; tick <= n_ticks; ++tick) text += tick % 4 == 0 ? std::to_string(tick / 4 * 10) : ".";
  text.resize(kRuler.size(), ' ');
  return text;
}

int terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 1 ? size.ws_col : 80;
}

// Of samples; a narrow terminal has room for the unit only.
std::string rate(double samples_per_second, bool is_short) {
  const char* const what = is_short ? "" : " samples";
  if (samples_per_second >= 1e6) return fmt::format("{:.1f} M{}/s", samples_per_second / 1e6, what);
  return fmt::format("{:.0f} k{}/s", samples_per_second / 1e3, what);
}

// One line for each stage, drawn over until the stage is done.
class ProgressBar {
 public:
  explicit ProgressBar(std::uint64_t n_samples) : n_samples_(n_samples) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { end_line(); }

  void show(double fraction, std::string_view stage) {
    const auto now = Clock::now();
    if (stage != stage_) {
      end_line();
      stage_ = stage;
      started_ = now;
      started_at_ = fraction;
    } else if (fraction < 1 && seconds_between(drawn_, now) < kSecondsBetweenDraws) {
      return;
    }
    drawn_ = now;
    draw(fraction, seconds_between(started_, now));
  }

 private:
  void draw(double fraction, double seconds) {
    const int width = terminal_width() - 1;
    const double done = fraction - started_at_;
    std::string line = fmt::format("{:<8} {}", stage_, ruler(fraction));
    if (n_samples_ > 0 && done > 0 && seconds > 0)
      line += "  " + rate(done * static_cast<double>(n_samples_) / seconds, width < kRoomForWords);
    if (fraction >= 1)
      line += ", " + duration(seconds);
    else if (done > 0 && seconds > kSecondsBeforeForecast)
      line += ", " + duration(seconds * (1 - fraction) / done) + (width < kRoomForWords ? "" : " left");
    // Spaces wipe out what a longer line left behind; a line too long for the terminal would not be drawn over.
    std::fprintf(stderr, "\r%-*.*s", width, width, line.c_str());
    std::fflush(stderr);
  }

  void end_line() {
    if (!stage_.empty()) std::fputc('\n', stderr);
    stage_.clear();
  }

  std::uint64_t n_samples_;
  std::string stage_;
  Clock::time_point started_;
  double started_at_ = 0;  // the fraction that earlier stages had done
  Clock::time_point drawn_;
};

}  // namespace

Progress make_progress(bool quiet, std::uint64_t n_samples) {
  if (quiet || isatty(STDERR_FILENO) == 0) return [](double, std::string_view) { return !is_interrupted(); };
  auto bar = std::make_shared<ProgressBar>(n_samples);
  return [bar](double fraction, std::string_view stage) {
    bar->show(fraction, stage);
    return !is_interrupted();
  };
}

}  // namespace tinsmith::cli
