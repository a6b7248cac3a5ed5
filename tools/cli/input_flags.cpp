#include "input_flags.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <map>
#include <optional>

#include "choose.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith::cli {
namespace {

std::optional<double> number(const std::string& text) {
  double value = 0;
  const char* const first = text.data() + (text.starts_with('+') ? 1 : 0);
  const auto [end, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double metres_per_unit(const std::string& name) {
  static const std::map<std::string, double> units{{"m", 1}, {"ft", 0.3048}, {"us-ft", 1200.0 / 3937}};
  if (const auto unit = units.find(name); unit != units.end()) return unit->second;
  const auto metres = number(name);
  if (!metres || !(*metres > 0) || !std::isfinite(*metres))
    throw UsageError(
        fmt::format("--vertical-unit {}: no unit of height; use m, ft, us-ft or metres per unit as a "
                    "number above 0",
                    name));
  return *metres;
}

std::array<double, 4> box(const std::vector<double>& bbox) {
  const std::array<double, 4> result{bbox[0], bbox[1], bbox[2], bbox[3]};
  if (!(result[0] < result[2] && result[1] < result[3]))
    throw UsageError(
        fmt::format("--bbox {}: the box is empty; give west south east north with west < east and "
                    "south < north",
                    fmt::join(bbox, " ")));
  return result;
}

}  // namespace

void add_input_flags(CLI::App& verb, InputFlags& flags) {
  verb.add_option("--band", flags.band);
  verb.add_option("--bbox", flags.bbox)->expected(4);
  verb.add_option("--nodata", flags.nodata);
  verb.add_option("--overlap", flags.overlap);
  verb.add_flag("--skip-unreadable", flags.skip_unreadable);
  verb.add_option("--vertical-unit", flags.vertical_unit);
}

InputOptions to_input_options(const InputFlags& flags) {
  InputOptions options;
  if (flags.band < 1) throw UsageError(fmt::format("--band {}: bands are numbered from 1", flags.band));
  options.band = flags.band;
  if (!flags.bbox.empty()) options.bbox = box(flags.bbox);
  if (!flags.nodata.empty()) {
    options.nodata = number(flags.nodata);
    if (!options.nodata) throw UsageError(fmt::format("--nodata {}: no number; use one, or nan", flags.nodata));
  }
  if (!flags.vertical_unit.empty()) options.vertical_unit = metres_per_unit(flags.vertical_unit);
  options.overlap = choose<Overlap>(
      "--overlap", flags.overlap, {{"first", Overlap::kFirst}, {"last", Overlap::kLast}, {"mean", Overlap::kMean}});
  options.skip_unreadable = flags.skip_unreadable;
  return options;
}

double require_tolerance(const std::string& option, double value) {
  if (std::isfinite(value) && value >= 0) return value;
  throw UsageError(fmt::format("{} {}: no tolerance; use a finite number of metres, 0 or more", option, value));
}

}  // namespace tinsmith::cli
