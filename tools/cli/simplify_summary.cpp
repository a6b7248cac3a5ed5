#include "simplify_summary.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdio>

#include "text.hpp"

namespace tinsmith::cli {
namespace {

struct Defect {
  const char* key;
  std::uint64_t SurfaceDefects::*count;
  const char* one;
  const char* many;
  const char* outcome;
};

constexpr const char* kCutApart = "cut apart there, and locked so that nothing gapes";

constexpr std::array kDefects{
    Defect{"duplicated_triangles", &SurfaceDefects::duplicated_triangles, "triangle was there again",
           "triangles were there again", "removed"},
    Defect{"degenerate_triangles", &SurfaceDefects::degenerate_triangles, "triangle had no area",
           "triangles had no area", "removed where a corner was there twice"},
    Defect{"flipped_triangles", &SurfaceDefects::flipped_triangles, "triangle faced against its neighbours",
           "triangles faced against their neighbours", "turned over"},
    Defect{"non_manifold_edges", &SurfaceDefects::non_manifold_edges, "edge had more than two triangles",
           "edges had more than two triangles", kCutApart},
    Defect{"non_manifold_vertices", &SurfaceDefects::non_manifold_vertices,
           "vertex joined parts that share no edge there", "vertices joined parts that share no edge there",
           kCutApart},
    Defect{"unorientable_edges", &SurfaceDefects::unorientable_edges,
           "edge lay where the surface has only one side", "edges lay where the surface has only one side",
           kCutApart},
    Defect{"unreferenced_vertices", &SurfaceDefects::unreferenced_vertices, "vertex belonged to no triangle",
           "vertices belonged to no triangle", "removed"},
};

void line(const char* name, const std::string& value) { std::printf("  %-14s %s\n", name, value.c_str()); }

std::uint64_t number(const Json& report, const char* key) { return report[key].get<std::uint64_t>(); }

std::string count(const Json& report, const char* key) { return grouped(number(report, key)); }

void print_size(const Json& report) {
  const auto triangles = report["triangles"].get<double>();
  const double times = triangles > 0 ? report["input_triangles"].get<double>() / triangles : 1;
  const std::string than = times > 1 ? fmt::format(", {:.4g} times fewer than the input's ", times) : " of ";
  line("triangles", count(report, "triangles") + than + count(report, "input_triangles"));
  line("vertices", count(report, "vertices") + " of " + count(report, "input_vertices"));
  line("parts", count(report, "components") + " in the input, each connected by edges");
  line("kept lines", fmt::format("{} border edges and {} feature edges in the input", count(report, "border_edges"),
                                 count(report, "feature_edges")));
}

void print_work(const Json& report) {
  line("collapses",
       fmt::format("{}, the costliest {:.4g}", count(report, "collapses"), report["last_cost"].get<double>()));
  line("refused", fmt::format("{} that would tear something, {} that would turn a triangle over",
                              count(report, "refused_topology"), count(report, "refused_half_space")));
  line("file", fmt::format("{}, {} bytes", report["output"].get<std::string>(), count(report, "bytes")));
  line("time", fmt::format("{}, {} without files, peak memory {}", duration(report["seconds"]),
                           duration(report["simplify_seconds"]), byte_size(number(report, "peak_memory_bytes"))));
}

void print_defects(const Json& report) {
  bool is_first = true;
  for (const Defect& defect : kDefects) {
    const std::uint64_t n_found = number(report, defect.key);
    if (n_found == 0) continue;
    if (is_first) std::puts("  wrong with the input:");
    is_first = false;
    std::printf("    %s %s: %s\n", grouped(n_found).c_str(), n_found == 1 ? defect.one : defect.many,
                defect.outcome);
  }
}

}  // namespace

void add_defects(Json& report, const SurfaceDefects& defects) {
  for (const Defect& defect : kDefects) report[defect.key] = defects.*defect.count;
}

void print_simplify_summary(const Json& report, bool verbose) {
  print_size(report);
  print_work(report);
  print_defects(report);
  if (verbose) print_table(report);
}

}  // namespace tinsmith::cli
