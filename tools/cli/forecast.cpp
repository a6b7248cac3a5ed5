#include "forecast.hpp"

namespace tinsmith::cli {
namespace {

constexpr double kSecondsBeforeForecast = 1;  // the first moments say little about the rest

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
  return moment;
}

}  // namespace tinsmith::cli
