#pragma once
// How far the work is: as GDAL's progress bar, with the rate, the time left and the memory, or as JSON.

#include <cstdint>
#include <string>
#include <vector>

#include "forecast.hpp"
#include "tinsmith/progress.hpp"

namespace tinsmith::cli {

enum class ProgressForm {
  kBar,   // drawn on standard error
  kJson,  // a line on standard error, twice a second at most
  kNone,
};

/// bar, json or none; a bar only when not quiet and standard error is a terminal. Throws UsageError.
ProgressForm choose_progress(const std::string& name, bool quiet);

/// A Progress that stops the run when the user interrupted it, and that shows each stage. n_samples: what the whole
/// of a stage is, for the rate. `stages` of the run, for the time left; none: that of each stage is told.
Progress make_progress(ProgressForm form, std::uint64_t n_samples, const std::vector<StageShare>& stages = {});

/// How the manuals describe it.
#define TINSMITH_PROGRESS_MANUAL                                                                                  \
  "  --progress P         bar (on a terminal), json or none (default bar). json: one object a line on standard\n" \
  "                       error, twice a second at most, also when that is no terminal: stage, fraction of it\n"  \
  "                       (never falls), samples_per_second, seconds_left (of the run; of the attempt where\n"    \
  "                       --triangles or --ratio make several; null: not known yet), memory_bytes,\n"             \
  "                       elapsed_seconds\n"

}  // namespace tinsmith::cli
