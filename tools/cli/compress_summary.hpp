#pragma once
// What compress says about its result, for people.

#include "report.hpp"

namespace tinsmith::cli {

/// A few lines on standard output; verbose: also the rounds and the whole certificate.
void print_summary(const Json& report, bool verbose);

}  // namespace tinsmith::cli
