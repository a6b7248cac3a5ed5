#include "compress_summary.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "text.hpp"

namespace tinsmith::cli {
namespace {

void line(const char* name, const std::string& value) { std::printf("  %-14s %s\n", name, value.c_str()); }

std::string count(const Json& report, const char* key) { return grouped(report[key].get<std::uint64_t>()); }

void print_size(const Json& report) {
  const auto full = report["full_triangles"].get<double>();
  const auto triangles = report["triangles"].get<double>();
  line("triangles", fmt::format("{}, {:.4g} times fewer than the full grid's {}", count(report, "triangles"),
                                triangles > 0 ? full / triangles : 0, count(report, "full_triangles")));
  line("vertices", fmt::format("{} for {} samples", count(report, "vertices"), count(report, "samples")));
  line("tolerance", metres(report["tolerance"]));
}

void print_errors(const Json& report) {
  if (!report.contains("holds")) {
    line("error", "not measured (--no-verify)");
    return;
  }
  line("largest error",
       fmt::format("{} at column {:.0f}, row {:.0f}", metres(report["max_error"]),
                   report["max_error_column"].get<double>(), report["max_error_row"].get<double>()));
  line("rmse", fmt::format("{}, mean {}, 99 % within {}", metres(report["rmse"]), metres(report["mean_error"]),
                           metres(report["p99_error"])));
  if (report["color_rmse"].is_null()) return;
  line("colour", fmt::format("rmse {:.4g}, largest difference {:.4g} of 255 levels",
                             report["color_rmse"].get<double>(), report["color_max_error"].get<double>()));
}

void print_cost(const Json& report) {
  const std::string check = report.contains("verify_seconds")
                                ? fmt::format(", and {} to verify", duration(report["verify_seconds"]))
                                : "";
  line("file", fmt::format("{}, {} bytes", report["output"].get<std::string>(), count(report, "bytes")));
  line("time", duration(report["seconds"]) + check);
  const bool is_one = report["threads"] == 1;
  line(report["windows"] == 1 ? "window" : "windows",
       fmt::format("{} on {} thread{}, peak memory {}", count(report, "windows"), count(report, "threads"),
                   is_one ? "" : "s", byte_size(report["peak_memory_bytes"])));
}

void print_rounds(const Json& report) {
  line("start", count(report, "start_triangles") + " triangles");
  const auto& seconds = report["round_seconds"];
  for (std::size_t round = 0; round < report["round_triangles"].size(); ++round) {
    const std::string time = round < seconds.size() ? ", " + duration(seconds[round]) : "";
    line(fmt::format("round {}", round).c_str(),
         grouped(report["round_triangles"][round].get<std::uint64_t>()) + " triangles" + time);
  }
}

}  // namespace

void print_summary(const Json& report, bool verbose) {
  print_size(report);
  print_errors(report);
  print_cost(report);
  if (verbose) {
    print_rounds(report);
    print_table(report);
  }
  if (!report.contains("holds")) return;
  std::puts(report["holds"] ? "  certified: every promise of the certificate holds"
                            : "  NOT certified; does not hold:");
  for (const auto& promise : report["broken"]) std::printf("    %s\n", promise.get<std::string>().c_str());
}

}  // namespace tinsmith::cli
