#include "pipeline/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "io/colour_raster.hpp"
#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "judge/plan.hpp"
#include "pipeline/compress_options.hpp"
#include "pipeline/memory_plan.hpp"
#include "pipeline/room.hpp"
#include "pipeline/search.hpp"
#include "pipeline/trial.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/plan.hpp"

namespace tinsmith {

namespace {

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

int n_channels(const ColourField* colours) { return colours != nullptr ? colours->n_channels() : 0; }

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

constexpr double kBytesPerTriangle = 12 + 17 / 2.0;  // see append_chunk: two triangles a vertex
// In two rounds at a time, with the judge's; entries of the index and colours are less.
constexpr std::uint64_t kMostScratchPerTriangle = 64 + sizeof(Facet);

// Finished windows in the folder: the result, and those of the rounds before that still wait to be read, of some
// rows of windows. Then the judge, if the mesh does not fit into its memory.
std::uint64_t scratch_of(const CompressPlan& plan, const Outset& outset, const Trial& trial) {
  constexpr double kBytesPerEntry = 150;  // of the index
  constexpr double kRowsWaiting = 3;
  const double rows = outset.graph.windows(0).rows;
  const double n_windows = static_cast<double>(plan.windows);
  const double first =
      trial.n_windows > 0 ? trial.first_triangles / static_cast<double>(trial.n_windows) * n_windows : 0;
  const double run = kBytesPerTriangle * (static_cast<double>(plan.expected_triangles) +
                                          first * std::min(1.0, kRowsWaiting / rows)) +
                     kBytesPerEntry * n_windows * plan.rounds;
  const double judge = static_cast<double>(plan.expected_triangles) * sizeof(Facet);
  const double while_judged = kBytesPerTriangle * static_cast<double>(plan.expected_triangles) + judge;
  return static_cast<std::uint64_t>(judge > static_cast<double>(plan.memory) / 4 ? std::max(run, while_judged)
                                                                                 : run);
}

// Everything takes what it holds, and no more than it may.
std::uint64_t peak_of(const CompressPlan& plan, const Trial& trial) {
  constexpr double kBytesPerVertex = 206;       // at work: see memory_plan.cpp
  constexpr double kBytesHeld = 12 + 25 / 2.0;  // by triangle
  const double n_tried = static_cast<double>(std::max<std::uint64_t>(trial.n_windows, 1));
  const double samples =
      static_cast<double>(plan.samples) / static_cast<double>(std::max<std::uint64_t>(plan.windows, 1));
  const double at_work =
      plan.threads * (trial.most_start_triangles / 2 * kBytesPerVertex + samples * sizeof(double));
  const double chunks = kBytesHeld * trial.first_triangles / n_tried * static_cast<double>(plan.windows);
  return plan.memory_program + std::min(plan.memory_windows, static_cast<std::uint64_t>(at_work)) +
         std::min(plan.memory_chunks, static_cast<std::uint64_t>(chunks)) +
         std::min(plan.memory_raster_cache, plan.samples * sizeof(float));
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

CompressPlan plan_of(const Outset& outset, const MemoryPlan& memory) {
  CompressPlan plan;
  plan.width = outset.field.width();
  plan.height = outset.field.height();
  plan.windows = outset.windows.size();
  plan.all_windows = static_cast<std::uint64_t>(outset.graph.windows(0).count());
  for (const std::int64_t w : outset.windows)
    plan.samples += static_cast<std::uint64_t>(outset.graph.samples({0, w}).area());
  plan.rounds = outset.graph.n_rounds();
  plan.threads = memory.threads;
  plan.memory = memory.total;
  plan.memory_program = memory.own;
  plan.memory_windows = memory.windows;
  plan.memory_raster_cache = memory.raster_cache;
  plan.memory_chunks = memory.chunks;
  return plan;
}

CompressPlan estimate(const Outset& outset, const MemoryPlan& memory, const std::string& output) {
  CompressPlan plan = plan_of(outset, memory);
  const Trial trial = try_out(outset, plan);
  plan.tried_windows = trial.n_windows;
  plan.expected_output =
      expected_mesh_bytes(output, plan.expected_triangles / 2, plan.expected_triangles, n_channels(outset.colours));
  plan.expected_scratch = scratch_of(plan, outset, trial);
  plan.expected_peak_memory = peak_of(plan, trial);
  look_for_room(output, outset.options.tmp, plan);
  return plan;
}

}  // namespace

std::vector<std::string> require_result_may_fit(const RunToPlan& run, std::uint64_t work_there) {
  const auto n_samples =
      static_cast<std::uint64_t>(run.field.width()) * static_cast<std::uint64_t>(run.field.height());
  CompressPlan most;
  look_for_room(run.output, run.options.tmp, most);
  most.expected_output = expected_mesh_bytes(run.output, n_samples, 2 * n_samples, n_channels(run.colours));
  most.expected_scratch = 2 * n_samples * kMostScratchPerTriangle;
  const bool has_format = !run.options.max_error || holds(run.output, 2 * n_samples);
  if (has_format && most.expected_output + most.expected_scratch <= std::min(most.free_scratch, most.free_output))
    return {};
  const Outset outset = outset_of(run.field, run.options, run.colours);
  const CompressPlan plan = estimate(outset, run.memory, run.output);
  if (run.options.max_error) require_format_holds_half(run.output, plan);
  return require_room(plan, work_there);
}

CompressPlan plan(const std::vector<std::string>& inputs, const std::string& output,
                  const InputOptions& input_options, const CompressOptions& options) {
  require_sensible(options);
  require_mesh_extension(output);
  if (!options.color.empty()) require_format_holds_colour(output, 1);
  const RasterField field(inputs, input_options);
  std::optional<ColourRaster> colours;
  if (!options.color.empty()) colours.emplace(options.color, field.frame(), field.width(), field.height());
  const Outset outset = outset_of(field, options, colours ? &*colours : nullptr);
  const int channels = n_channels(outset.colours);
  require_format_holds_colour(output, channels);
  const MemoryPlan memory = plan_memory(field, {options.window, options.threads, options.memory, channels});
  set_raster_cache(memory.raster_cache);
  CompressPlan plan = estimate(outset, memory, output);
  plan.doubts = require_room(plan, 0);
  require_format_holds_half(output, plan);
  return plan;
}

}  // namespace tinsmith
