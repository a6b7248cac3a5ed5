#include "report.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <map>

#include "io/output_file.hpp"
#include "text.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/version.hpp"

namespace tinsmith::cli {
namespace {

namespace fs = std::filesystem;

const auto started = std::chrono::steady_clock::now();

constexpr int kDoesNotHold = 1;

const std::map<std::string, const char*>& units() {
  static const std::map<std::string, const char*> units_by_key{{"max_error", "m"},
                                                               {"rmse", "m"},
                                                               {"mean_error", "m"},
                                                               {"p99_error", "m"},
                                                               {"tolerance", "m"},
                                                               {"area_plan", "m2"},
                                                               {"area_valid", "m2"},
                                                               {"rounding", "m"},
                                                               {"color_samples", "samples"},
                                                               {"color_rmse", "levels of 255"},
                                                               {"color_max_error", "levels of 255"},
                                                               {"seconds", "s"},
                                                               {"simplify_seconds", "s"},
                                                               {"verify_seconds", "s"},
                                                               {"bytes", "bytes"},
                                                               {"peak_memory_bytes", "bytes"},
                                                               {"max_error_column", "samples"},
                                                               {"max_error_row", "samples"}};
  return units_by_key;
}

std::string as_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.10g}", value.get<double>());
  return value.dump();
}

// What is not there yet is compared by its folder and name.
bool is_same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (a == b || fs::equivalent(a, b, error)) return true;
  const fs::path place = fs::weakly_canonical(fs::absolute(a, error), error);
  return !error && place == fs::weakly_canonical(fs::absolute(b, error), error) && !error;
}

}  // namespace

Resources resources_so_far() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  constexpr std::uint64_t kBytesPerUnit = 1024;  // Linux counts ru_maxrss in kilobytes
  return {std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count(),
          static_cast<std::uint64_t>(usage.ru_maxrss) * kBytesPerUnit};
}

Json empty_report(const std::vector<std::string>& inputs, const std::string& output) {
  Json report;
  for (const char* key :
       {"samples",        "covered",    "uncovered", "vertices", "triangles",          "max_error",
        "rmse",           "mean_error", "p99_error", "folded",   "non_manifold_edges", "t_junctions",
        "area_plan",      "components", "bytes",     "seconds",  "peak_memory_bytes",  "threads",
        "windows",        "version",    "input",     "output",   "tolerance",          "color_rmse",
        "color_max_error"})
    report[key] = nullptr;
  report["version"] = version();
  report["input"] = inputs;
  report["output"] = output;
  return report;
}

void add_certificate(Json& report, const Certificate& c, std::optional<double> tolerance) {
  report["samples"] = c.samples;
  report["covered"] = c.covered;
  report["uncovered"] = c.uncovered;
  report["vertices"] = c.vertices;
  report["triangles"] = c.triangles;
  report["max_error"] = c.max_error;
  report["rmse"] = c.rmse;
  report["mean_error"] = c.mean_error;
  report["p99_error"] = c.p99_error;
  report["folded"] = c.folded;
  report["non_manifold_edges"] = c.non_manifold_edges;
  report["t_junctions"] = c.t_junctions;
  report["area_plan"] = c.area_plan;
  report["components"] = c.components;
  report["overlapped"] = c.overlapped;
  report["non_manifold_vertices"] = c.non_manifold_vertices;
  report["area_valid"] = c.area_valid;
  report["max_error_column"] = static_cast<std::int64_t>(c.max_error_column);
  report["max_error_row"] = static_cast<std::int64_t>(c.max_error_row);
  report["rounding"] = c.rounding;
  if (c.color_samples > 0) {
    report["color_samples"] = c.color_samples;
    report["color_rmse"] = c.color_rmse;
    report["color_max_error"] = c.color_max_error;
  }
  if (tolerance) report["tolerance"] = *tolerance;
  report["broken"] = c.broken_promises(tolerance.value_or(-1));
  report["holds"] = report["broken"].empty();
}

void print_table(const Json& report) {
  for (const auto& [key, value] : report.items()) {
    if (value.is_null() || value.is_array() || value.is_boolean()) continue;
    const auto unit = units().find(key);
    const std::string line =
        fmt::format("{:<22} {} {}", key, as_text(value), unit != units().end() ? unit->second : "");
    std::puts(in_one_line(line).c_str());
  }
}

void write_json(const Json& report, const std::string& path) {
  // A path need not be UTF-8, but JSON must be.
  const std::string text = report.dump(path == "-" ? -1 : 2, ' ', false, Json::error_handler_t::replace) + "\n";
  if (path == "-") {
    std::fputs(text.c_str(), stdout);
    return;
  }
  OutputFile file(path);
  file.write(text);
  file.commit();
}

void require_writable(const std::string& path) { const OutputFile probe(path); }

void require_apart(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs) {
  std::vector<std::string> earlier;
  for (const std::string& output : outputs) {
    if (output.empty() || output == "-") continue;
    for (const std::string& input : inputs)
      if (is_same_file(output, input))
        throw UsageError(fmt::format("{}: is an input too; write the output under another name", output));
    for (const std::string& other : earlier)
      if (is_same_file(output, other))
        throw UsageError(fmt::format("{}: is named for two outputs; give each a name of its own", output));
    earlier.push_back(output);
  }
}

int verdict(const Json& report, const std::string& mesh) {
  if (report["holds"]) return 0;
  std::string promises;
  for (const auto& sentence : report["broken"])
    promises += (promises.empty() ? "" : " ") + sentence.get<std::string>();
  std::fprintf(stderr, "tinsmith: %s: does not hold: %s\n", mesh.c_str(), in_one_line(promises).c_str());
  return kDoesNotHold;
}

}  // namespace tinsmith::cli
