#pragma once
// What every run that compresses asks of its options.

#include "tinsmith/options.hpp"

namespace tinsmith {

/// Throws UsageError when they make no sense.
void require_sensible(const CompressOptions& options);

/// Threads to use.
int thread_count(const CompressOptions& options);

}  // namespace tinsmith
