#include "pipeline/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "io/colour_raster.hpp"
#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "judge/plan.hpp"
#include "pipeline/compress_options.hpp"
#include "pipeline/memory_plan.hpp"
#include "pipeline/search.hpp"
#include "pipeline/trial.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/plan.hpp"

namespace tinsmith {

namespace {

namespace fs = std::filesystem;

// A surface of which the size is known, not the triangles.
class ExpectedSurface : public TerrainSurface {
 public:
  explicit ExpectedSurface(double n_triangles) {
    extent_.n_triangles = static_cast<std::uint64_t>(std::max(2.0, n_triangles));
    extent_.n_vertices = extent_.n_triangles / 2;
  }
  const TerrainExtent& extent() const override { return extent_; }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& /*visit*/) const override {}
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& /*visit*/) const override {}

 private:
  TerrainExtent extent_;
};

// What is known before any window is tried.
struct Outset {
  const RasterField& field;
  const CompressOptions& options;
  const ColourField* colours;  // null: none
  WindowGraph graph;
  std::vector<std::int64_t> windows;  // that may hold samples
};

Outset outset_of(const RasterField& field, const CompressOptions& options, const ColourField* colours) {
  Outset outset{field, options, colours, WindowGraph(field.width(), field.height(), options.window), {}};
  outset.windows = windows_with_samples(field, outset.graph);
  return outset;
}

std::vector<GridRect> to_try(const Outset& outset) {
  std::vector<GridRect> rects;
  for (const std::int64_t w : spread_out(outset.windows, outset.graph.windows(0).columns))
    rects.push_back(outset.graph.samples({0, w}));
  return rects;
}

double metres_per_unit(const Outset& outset) { return outset.field.frame().metres_per_vertical_unit; }

// Windows at work at a time make the others wait for the disk and the memory: 1.86 x as fast with two threads.
double speed_of(int threads, std::uint64_t n_windows) {
  constexpr double kPerThread = 0.93;
  const double n = static_cast<double>(std::min<std::uint64_t>(static_cast<std::uint64_t>(threads), n_windows));
  return n > 1 ? kPerThread * n : 1;
}

// With a number or ratio of triangles the whole search is done, on the tried windows.
Trial try_out(const Outset& outset, CompressPlan& plan) {
  const std::vector<GridRect> rects = to_try(outset);
  const double times =
      static_cast<double>(outset.windows.size()) / static_cast<double>(std::max<std::size_t>(rects.size(), 1));
  Trial last;
  double seconds = 0;
  plan.passes = 0;
  const auto run = [&](double tolerance, CompressReport& report) {
    RoundsOptions rounds{tolerance, outset.options.window, outset.options.placement, outset.options.effort};
    rounds.colours = outset.colours;
    rounds.colour.tolerance = outset.options.color_tolerance;
    last = try_windows(outset.field, outset.field.frame(), rects, rounds, outset.options.progress);
    seconds += last.seconds;
    ++plan.passes;
    report.tolerance = tolerance;
    report.full_triangles = static_cast<std::uint64_t>(2 * last.cells * times);
    return std::make_shared<const ExpectedSurface>(last.triangles * times);
  };
  CompressReport report;
  std::shared_ptr<const TerrainSurface> surface;
  if (outset.options.max_error)
    surface = run(*outset.options.max_error / metres_per_unit(outset), report);
  else
    surface = search_tolerance({run}, outset.options.triangles, outset.options.ratio, report);
  if (last.cells == 0) plan.passes = 1;
  plan.tolerance = report.tolerance * metres_per_unit(outset);
  plan.expected_triangles = last.cells > 0 ? surface->extent().n_triangles : 0;
  plan.expected_seconds = seconds * times / speed_of(plan.threads, plan.windows);
  return last;
}

// Finished windows in the folder: the result, and those of the rounds before that still wait to be read, of some
// rows of windows. Then the judge, if the mesh does not fit into its memory.
std::uint64_t scratch_of(const CompressPlan& plan, const Outset& outset, const Trial& trial) {
  constexpr double kBytesPerTriangle = 12 + 17 / 2.0;  // see append_chunk: two triangles a vertex
  constexpr double kBytesPerEntry = 150;               // of the index
  constexpr double kRowsWaiting = 3;
  const double rows = outset.graph.windows(0).rows;
  const double n_windows = static_cast<double>(plan.windows);
  const double first =
      trial.n_windows > 0 ? trial.first_triangles / static_cast<double>(trial.n_windows) * n_windows : 0;
  const double run = kBytesPerTriangle * (static_cast<double>(plan.expected_triangles) +
                                          first * std::min(1.0, kRowsWaiting / rows)) +
                     kBytesPerEntry * n_windows * plan.rounds;
  const double judge = static_cast<double>(plan.expected_triangles) * sizeof(Facet);
  return static_cast<std::uint64_t>(judge > static_cast<double>(plan.memory) / 4 ? std::max(run, judge) : run);
}

// Everything takes what it holds, and no more than it may.
std::uint64_t peak_of(const CompressPlan& plan, const Trial& trial) {
  constexpr double kBytesPerVertex = 206;  // at work: see memory_plan.cpp
  constexpr double kBytesPerTriangle = 12 + 25 / 2.0;
  const double n_tried = static_cast<double>(std::max<std::uint64_t>(trial.n_windows, 1));
  const double samples =
      static_cast<double>(plan.samples) / static_cast<double>(std::max<std::uint64_t>(plan.windows, 1));
  const double at_work =
      plan.threads * (trial.most_start_triangles / 2 * kBytesPerVertex + samples * sizeof(double));
  const double chunks = kBytesPerTriangle * trial.first_triangles / n_tried * static_cast<double>(plan.windows);
  return plan.memory_program + std::min(plan.memory_windows, static_cast<std::uint64_t>(at_work)) +
         std::min(plan.memory_chunks, static_cast<std::uint64_t>(chunks)) +
         std::min(plan.memory_raster_cache, plan.samples * sizeof(float));
}

std::string folder_of(const std::string& file) {
  const fs::path folder = fs::absolute(file).parent_path();
  return folder.string();
}

std::uint64_t free_space(const std::string& folder) {
  std::error_code error;
  const fs::space_info space = fs::space(folder, error);
  if (error)
    throw OutputError(
        fmt::format("{}: can't be used: {}; make the folder or choose another", folder, error.message()));
  return space.available;
}

std::string megabytes(std::uint64_t bytes) { return fmt::format("{} MB", (bytes + 999999) / 1000000); }

void require_room(const std::string& folder, std::uint64_t free, std::uint64_t expected, const char* what,
                  const char* remedy) {
  if (expected / 2 <= free) return;
  throw ResourceError(fmt::format("{}: about {} of {} are expected and {} are free; make room, {}", folder,
                                  megabytes(expected), what, megabytes(free), remedy));
}

void require_format_holds_half(const std::string& output, const CompressPlan& plan) {
  require_format_holds(output, plan.expected_triangles / 4, plan.expected_triangles / 2);
}

bool holds(const std::string& output, std::uint64_t n_triangles) {
  try {
    require_format_holds(output, n_triangles / 2, n_triangles);
    return true;
  } catch (const ResourceError&) {
    return false;
  }
}

// Certain is what half of the estimate is too much for.
void require_fit(const CompressPlan& plan, const std::string& output) {
  require_room(plan.scratch_folder, plan.free_scratch, plan.expected_scratch, "unfinished work",
               "or choose another folder with --tmp");
  require_room(plan.output_folder, plan.free_output, plan.expected_output, "output", "or write elsewhere");
  require_format_holds_half(output, plan);
}

CompressPlan plan_of(const Outset& outset, const MemoryPlan& memory) {
  CompressPlan plan;
  plan.width = outset.field.width();
  plan.height = outset.field.height();
  plan.windows = outset.windows.size();
  plan.all_windows = static_cast<std::uint64_t>(outset.graph.windows(0).count());
  for (const std::int64_t w : outset.windows)
    plan.samples += static_cast<std::uint64_t>(outset.graph.samples({0, w}).area());
  plan.rounds = outset.graph.n_rounds();
  plan.threads = thread_count(outset.options);
  plan.memory = memory.total;
  plan.memory_program = memory.own;
  plan.memory_windows = memory.windows;
  plan.memory_raster_cache = memory.raster_cache;
  plan.memory_chunks = memory.chunks;
  return plan;
}

}  // namespace

void require_format_may_hold(const RasterField& field, const std::string& output, const CompressOptions& options,
                             const ColourField* colours) {
  const auto n_samples = static_cast<std::uint64_t>(field.width()) * static_cast<std::uint64_t>(field.height());
  if (holds(output, 2 * n_samples)) return;
  const Outset outset = outset_of(field, options, colours);
  CompressPlan plan;
  plan.threads = 1;
  try_out(outset, plan);
  require_format_holds_half(output, plan);
}

CompressPlan plan(const std::vector<std::string>& inputs, const std::string& output,
                  const InputOptions& input_options, const CompressOptions& options) {
  require_sensible(options);
  require_mesh_extension(output);
  if (!options.color.empty()) require_format_holds_colour(output, 1);
  const RasterField field(inputs, input_options);
  std::optional<ColourRaster> colours;
  if (!options.color.empty()) colours.emplace(options.color, field.frame(), field.width(), field.height());
  const int n_channels = colours ? colours->n_channels() : 0;
  require_format_holds_colour(output, n_channels);
  const MemoryPlan memory = plan_memory(field, {options.window, thread_count(options), options.memory, n_channels});
  set_raster_cache(memory.raster_cache);
  const Outset outset = outset_of(field, options, colours ? &*colours : nullptr);
  CompressPlan plan = plan_of(outset, memory);
  const Trial trial = try_out(outset, plan);
  plan.tried_windows = trial.n_windows;
  plan.expected_output =
      expected_mesh_bytes(output, plan.expected_triangles / 2, plan.expected_triangles, n_channels);
  plan.expected_scratch = scratch_of(plan, outset, trial);
  plan.expected_peak_memory = peak_of(plan, trial);
  plan.output_folder = folder_of(output);
  plan.scratch_folder = options.tmp.empty() ? plan.output_folder : options.tmp;
  plan.free_scratch = free_space(plan.scratch_folder);
  plan.free_output = free_space(plan.output_folder);
  require_fit(plan, output);
  return plan;
}

}  // namespace tinsmith
