#pragma once
// What compress --plan says.

#include <string>
#include <vector>

#include "report.hpp"
#include "tinsmith/plan.hpp"

namespace tinsmith::cli {

/// The plan's numbers by their names.
Json plan_report(const CompressPlan& plan, const std::vector<std::string>& inputs, const std::string& output);

/// A few lines on standard output. has_limit: a number or ratio of triangles is aimed for.
void print_plan(const CompressPlan& plan, const std::string& output, bool has_limit);

}  // namespace tinsmith::cli
