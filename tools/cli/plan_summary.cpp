#include "plan_summary.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "text.hpp"
#include "tinsmith/version.hpp"

namespace tinsmith::cli {
namespace {

void line(const char* name, const std::string& value) { std::printf("  %-14s %s\n", name, value.c_str()); }

std::string in_folder(std::uint64_t bytes, const std::string& folder, std::uint64_t free) {
  return fmt::format("about {} in {}, of {} free", byte_size(bytes), folder, byte_size(free));
}

std::string division(const CompressPlan& plan) {
  const std::uint64_t divided =
      plan.memory_program + plan.memory_windows + plan.memory_raster_cache + plan.memory_chunks;
  return fmt::format("{}: {} program, {} windows at work, {} raster cache, {} finished windows, {} to spare",
                     byte_size(plan.memory), byte_size(plan.memory_program), byte_size(plan.memory_windows),
                     byte_size(plan.memory_raster_cache), byte_size(plan.memory_chunks),
                     byte_size(plan.memory > divided ? plan.memory - divided : 0));
}

// Three digits: more are not known.
std::string about(std::uint64_t number) {
  std::uint64_t unit = 1;
  while (number / unit >= 1000) unit *= 10;
  return "about " + grouped((number + unit / 2) / unit * unit);
}

}  // namespace

Json plan_report(const CompressPlan& plan, const std::vector<std::string>& inputs, const std::string& output) {
  Json report;
  report["version"] = version();
  report["input"] = inputs;
  report["output"] = output;
  report["width"] = plan.width;
  report["height"] = plan.height;
  report["samples"] = plan.samples;
  report["windows"] = plan.windows;
  report["all_windows"] = plan.all_windows;
  report["rounds"] = plan.rounds;
  report["threads"] = plan.threads;
  report["tried_windows"] = plan.tried_windows;
  report["memory_bytes"] = plan.memory;
  report["memory_program_bytes"] = plan.memory_program;
  report["memory_windows_bytes"] = plan.memory_windows;
  report["memory_raster_cache_bytes"] = plan.memory_raster_cache;
  report["memory_chunks_bytes"] = plan.memory_chunks;
  report["expected_peak_memory_bytes"] = plan.expected_peak_memory;
  report["tolerance"] = plan.tolerance;
  report["passes"] = plan.passes;
  report["expected_triangles"] = plan.expected_triangles;
  report["expected_bytes"] = plan.expected_output;
  report["expected_scratch_bytes"] = plan.expected_scratch;
  report["expected_seconds"] = plan.expected_seconds;
  report["scratch_folder"] = plan.scratch_folder;
  report["free_scratch_bytes"] = plan.free_scratch;
  report["output_folder"] = plan.output_folder;
  report["free_output_bytes"] = plan.free_output;
  report["doubts"] = plan.doubts;
  return report;
}

void print_plan(const CompressPlan& plan, const std::string& output, bool has_limit) {
  line("input", fmt::format("{} x {}, {} samples in the windows that may hold any", plan.width, plan.height,
                            grouped(plan.samples)));
  line("windows", fmt::format("{} of {} may hold samples; {} round{} on {} thread{}", grouped(plan.windows),
                              grouped(plan.all_windows), plan.rounds, plan.rounds == 1 ? "" : "s", plan.threads,
                              plan.threads == 1 ? "" : "s"));
  line("memory", division(plan));
  std::printf("estimated from %s windows that were really compressed:\n", grouped(plan.tried_windows).c_str());
  if (has_limit)
    line("tolerance", fmt::format("about {}, found in {} passes", metres(plan.tolerance), plan.passes));
  line("triangles", about(plan.expected_triangles));
  line("time", fmt::format("about {}, without verification", duration(plan.expected_seconds)));
  line("peak memory", "about " + byte_size(plan.expected_peak_memory));
  line("scratch", in_folder(plan.expected_scratch, plan.scratch_folder, plan.free_scratch));
  line("output",
       fmt::format("{}: {}", output, in_folder(plan.expected_output, plan.output_folder, plan.free_output)));
  std::puts("nothing was written");
}

}  // namespace tinsmith::cli
