#include "progress_bar.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>

#include "base/machine_memory.hpp"
#include "choose.hpp"
#include "interrupt.hpp"
#include "report.hpp"
#include "text.hpp"

namespace tinsmith::cli {
namespace {

using Clock = Forecast::Clock;

constexpr int kRoomForWords = 115;  // columns of a terminal
constexpr double kSecondsBetweenDraws = 0.1;
constexpr double kSecondsBetweenLines = 0.5;  // of JSON

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
  explicit ProgressBar(Forecast forecast) : forecast_(std::move(forecast)) {}
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { end_line(); }

  void show(double fraction, std::string_view stage) {
    const auto now = Clock::now();
    const Moment moment = forecast_.at(now, fraction, stage);
    if (stage != stage_) {
      end_line();
      stage_ = stage;
    } else if (fraction < 1 && seconds_between(drawn_, now) < kSecondsBetweenDraws) {
      return;
    }
    drawn_ = now;
    draw(moment);
  }

 private:
  void draw(const Moment& moment) {
    const int width = terminal_width() - 1;
    const bool is_short = width < kRoomForWords;
    std::string line = fmt::format("{:<8} {}", stage_, ruler(moment.fraction));
    if (moment.samples_per_second > 0) line += "  " + rate(moment.samples_per_second, is_short);
    if (moment.fraction >= 1)
      line += ", " + duration(moment.stage_seconds);
    else if (moment.seconds_left)
      line += ", " + duration(*moment.seconds_left) + (is_short ? "" : " left");
    line += ", " + byte_size(resident_memory());
    // Spaces wipe out what a longer line left behind; a line too long for the terminal would not be drawn over.
    std::fprintf(stderr, "\r%-*.*s", width, width, line.c_str());
    std::fflush(stderr);
  }

  void end_line() {
    if (!stage_.empty()) std::fputc('\n', stderr);
    stage_.clear();
  }

  Forecast forecast_;
  std::string stage_;
  Clock::time_point drawn_;
};

std::string json_line(const Moment& moment) {
  Json line;
  line["stage"] = moment.stage;
  line["fraction"] = moment.fraction;
  line["samples_per_second"] = moment.samples_per_second;
  line["seconds_left"] = moment.seconds_left ? Json(*moment.seconds_left) : Json();
  line["memory_bytes"] = resident_memory();
  line["elapsed_seconds"] = resources_so_far().seconds;
  return line.dump() + "\n";
}

// JSON for schedulers. What came too soon after the last line is kept: the last word is always said.
class ProgressLines {
 public:
  explicit ProgressLines(Forecast forecast) : forecast_(std::move(forecast)) {}
  ProgressLines(const ProgressLines&) = delete;
  ProgressLines& operator=(const ProgressLines&) = delete;
  ~ProgressLines() { print(); }

  void show(double fraction, std::string_view stage) {
    const auto now = Clock::now();
    kept_ = json_line(forecast_.at(now, fraction, stage));
    if (seconds_between(printed_, now) < kSecondsBetweenLines) return;
    printed_ = now;
    print();
  }

 private:
  void print() {
    std::fputs(kept_.c_str(), stderr);
    std::fflush(stderr);
    kept_.clear();
  }

  Forecast forecast_;
  std::string kept_;
  Clock::time_point printed_;
};

template <class Shown>
Progress shown_by(const Forecast& forecast) {
  auto shown = std::make_shared<Shown>(forecast);
  return [shown](double fraction, std::string_view stage) {
    shown->show(fraction, stage);
    return !is_interrupted();
  };
}

}  // namespace

ProgressForm choose_progress(const std::string& name, bool quiet) {
  const auto form = choose<ProgressForm>(
      "--progress", name,
      {{"bar", ProgressForm::kBar}, {"json", ProgressForm::kJson}, {"none", ProgressForm::kNone}});
  return form == ProgressForm::kBar && (quiet || isatty(STDERR_FILENO) == 0) ? ProgressForm::kNone : form;
}

Progress make_progress(ProgressForm form, std::uint64_t n_samples, const std::vector<StageShare>& stages) {
  const Forecast forecast(n_samples, stages);
  if (form == ProgressForm::kBar) return shown_by<ProgressBar>(forecast);
  if (form == ProgressForm::kJson) return shown_by<ProgressLines>(forecast);
  return [](double, std::string_view) { return !is_interrupted(); };
}

}  // namespace tinsmith::cli
