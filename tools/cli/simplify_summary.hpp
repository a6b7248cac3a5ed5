#pragma once
// What simplify says about its result, for people.

#include "report.hpp"
#include "tinsmith/simplify.hpp"

namespace tinsmith::cli {

/// A key of the report for each count of defects.
void add_defects(Json& report, const SurfaceDefects& defects);

/// A few lines on standard output; verbose: also every number of the report.
void print_simplify_summary(const Json& report, bool verbose);

}  // namespace tinsmith::cli
