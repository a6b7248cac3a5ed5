#pragma once
// Where a run is, how fast it goes, and how long it still takes.

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tinsmith::cli {

/// What is known at one moment of a stage.
struct Moment {
  std::string stage;
  double fraction = 0;
  double samples_per_second = 0;       // lately; 0: not known yet
  std::optional<double> seconds_left;  // of the run as far as its stages are known, else of the stage
  double stage_seconds = 0;
};

/// Which part of a run's time a stage takes.
struct StageShare {
  std::string_view stage;  // outlives the forecast
  double share = 0;
};

/// Only what this run did itself counts, and of that the latter part: at least a half of the time since the stage
/// began, so that a start through empty or easy land is forgotten.
class Forecast {
 public:
  using Clock = std::chrono::steady_clock;

  /// n_samples: of a whole stage. `stages` of the run in their order; the time of others is told by themselves.
  explicit Forecast(std::uint64_t n_samples, std::vector<StageShare> stages = {})
      : n_samples_(n_samples), stages_(std::move(stages)) {}

  Moment at(Clock::time_point now, double fraction, std::string_view stage);

 private:
  struct Mark {
    Clock::time_point time;
    double fraction = 0;
  };

  std::optional<double> later_seconds(double stage_seconds);

  std::uint64_t n_samples_;
  std::vector<StageShare> stages_;
  double run_seconds_ = 0;  // all of the run, by the last stage long enough to tell; 0: not known yet
  std::string stage_;
  Mark start_;   // where the stage was when it was first heard of: a resumed run begins farther on
  Mark from_;    // what the rate is measured from
  Mark middle_;  // the next such
};

}  // namespace tinsmith::cli
