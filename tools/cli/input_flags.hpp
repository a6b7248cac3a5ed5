#pragma once
// The options that say which samples of the inputs count; the same for every verb.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tinsmith/options.hpp"

namespace tinsmith::cli {

struct InputFlags {
  int band = 1;
  std::vector<double> bbox;
  std::string nodata;
  std::string vertical_unit;
  std::string overlap = "first";
  bool skip_unreadable = false;
};

/// --band, --bbox, --nodata, --overlap, --skip-unreadable and --vertical-unit.
void add_input_flags(CLI::App& verb, InputFlags& flags);

/// Throws UsageError for values that make no sense.
InputOptions to_input_options(const InputFlags& flags);

/// The tolerance in metres. Throws UsageError unless it is finite and not negative.
double require_tolerance(const std::string& option, double value);

/// How the manuals describe them.
#define TINSMITH_INPUT_MANUAL                                                                                    \
  "  INPUT @FILE          the paths in FILE, one a line, as inputs; ./@FILE is a raster of that name\n"          \
  "  --band N             band of the rasters, from 1 (default 1)\n"                                             \
  "  --bbox W S E N       only samples whose centres lie inside, in the raster's CRS\n"                          \
  "  --nodata V           this value is a void, whatever the files declare; nan is a value too\n"                \
  "  --overlap O          where several inputs hold a height: that of the first or the last one named, or the\n" \
  "                       mean of all (default first)\n"                                                         \
  "  --skip-unreadable    what can't be opened, or a block that can't be read, is a void and does not end the\n" \
  "                       run; a remark names the files\n"                                                       \
  "  --vertical-unit U    heights are in m, ft (0.3048 m), us-ft (1200/3937 m) or NUMBER metres, whatever the\n" \
  "                       files declare\n"

}  // namespace tinsmith::cli
