#pragma once
// GDAL's progress bar, with the rate and the time left.

#include <cstdint>

#include "tinsmith/progress.hpp"

namespace tinsmith::cli {

/// A Progress that stops the run when the user interrupted it, and that draws a bar for each stage when `quiet`
/// is false and standard error is a terminal. n_samples: what the whole of a stage is, for the rate.
Progress make_progress(bool quiet, std::uint64_t n_samples);

}  // namespace tinsmith::cli
