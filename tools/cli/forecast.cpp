#include "forecast.hpp"

#include <algorithm>

namespace tinsmith::cli {
namespace {

constexpr double kSecondsBeforeForecast = 1;  // the first moments say little about the rest
constexpr double kLeastTellingShare = 0.1;    // of the run: a shorter stage says little about the others

double seconds_between(Forecast::Clock::time_point from, Forecast::Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

}  // namespace

Moment Forecast::at(Clock::time_point now, double fraction, std::string_view stage) {
  const Mark here{now, fraction};
  if (stage != stage_) {
    stage_ = stage;
    start_ = from_ = middle_ = here;
  }
  const double seconds = seconds_between(start_.time, now);
  if (seconds >= 2 * seconds_between(start_.time, middle_.time) && seconds > kSecondsBeforeForecast) {
    from_ = middle_;
    middle_ = here;
  }
  Moment moment{stage_, fraction, 0, {}, seconds};
  const double lately = seconds_between(from_.time, now);
  const double done = fraction - from_.fraction;
  if (lately > 0 && done > 0) {
    moment.samples_per_second = done * static_cast<double>(n_samples_) / lately;
    if (seconds > kSecondsBeforeForecast) moment.seconds_left = lately * (1 - fraction) / done;
  }
  if (fraction >= 1) moment.seconds_left = 0;
  if (!moment.seconds_left) return moment;
  const auto later = later_seconds(done > 0 ? lately / done : 0);
  moment.seconds_left = later ? std::optional(*moment.seconds_left + *later) : std::nullopt;
  return moment;
}

// Of the stages that are still to come, when the present one takes so long in all (0: not known).
std::optional<double> Forecast::later_seconds(double stage_seconds) {
  const auto here = std::find_if(stages_.begin(), stages_.end(), [&](auto& one) { return one.stage == stage_; });
  if (here == stages_.end()) return 0;
  double later = 0;
  for (auto next = here + 1; next != stages_.end(); ++next) later += next->share;
  if (here->share >= kLeastTellingShare && stage_seconds > 0) run_seconds_ = stage_seconds / here->share;
  if (later > 0 && run_seconds_ == 0) return {};
  return later * run_seconds_;
}

}  // namespace tinsmith::cli
