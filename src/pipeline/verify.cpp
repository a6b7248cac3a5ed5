#include "tinsmith/verify.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "base/machine_memory.hpp"
#include "io/colour_raster.hpp"
#include "io/mesh_file.hpp"
#include "io/raster_field.hpp"
#include "judge/colour_error.hpp"
#include "pipeline/measure_blocks.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// What the program itself takes, with its libraries and the histograms of errors.
constexpr std::uint64_t kOwnMemory = std::uint64_t{80} << 20;
constexpr std::uint64_t kCacheShare =
    8;  // one part of the memory is left to GDAL, for decoded blocks of the raster
// More makes nothing faster, since the blocks come from the system's file cache; so large meshes take what small
// ones take.
constexpr std::uint64_t kMostWorking = std::uint64_t{96} << 20;

/// Bytes for the mesh and its blocks; a quarter where the program itself leaves less.
std::uint64_t working_memory(std::uint64_t memory) {
  return std::min(kMostWorking, std::max(memory / 4, memory - std::min(memory, kOwnMemory + memory / kCacheShare)));
}

int thread_count(const VerifyOptions& options) {
  if (options.threads < 0) throw UsageError(fmt::format("threads is {}: it must be 0 or more", options.threads));
  return options.threads > 0 ? options.threads : tbb::info::default_concurrency();
}

/// Colours of the mesh, for comparison with a raster.
void visit_colours(const std::string& mesh_path, const ColourField& field, BlockedMesh& mesh,
                   MeshVisitor& visitor) {
  const auto wanted = static_cast<int>(n_mesh_channels(field.n_channels()));
  visitor.colours = [&mesh, &mesh_path, wanted](std::span<const Levels> colours, int n_channels) {
    if (n_channels != wanted)
      throw InputError(
          fmt::format("{}: has {} channels of colour, the raster of colours gives {}; name the one that the "
                      "mesh was made with",
                      mesh_path, n_channels, wanted));
    mesh.add_colours(colours);
  };
}

void require_colours(const std::string& mesh_path, const BlockedMesh& mesh) {
  if (mesh.n_vertices() == 0 || mesh.has_colours()) return;
  throw InputError(mesh_path + ": has no colours to measure; leave --color, or make the mesh with it");
}

/// Of the whole, reading the mesh is the first part, measuring the other.
class ReadingProgress {
 public:
  explicit ReadingProgress(const Samples& samples) : samples_(samples) {}

  void expect(std::uint64_t n_vertices, std::uint64_t n_triangles) {
    n_expected_ = n_vertices + n_triangles;
    const double reading = kSamplesPerElement * static_cast<double>(n_expected_);
    share_ = reading / (reading + n_samples());
  }
  void add(std::size_t n_elements) {
    n_read_ += n_elements;
    const auto n_expected = static_cast<double>(std::max(n_expected_, n_read_));
    report_progress(samples_, share_ * static_cast<double>(n_read_) / n_expected);
  }
  Progress of_measuring() const {
    if (!samples_.progress) return {};
    return [progress = samples_.progress, share = share_](double fraction, std::string_view stage) {
      return progress(share + (1 - share) * fraction, stage);
    };
  }

 private:
  // A vertex or triangle takes as long to read and sort into blocks as so many samples to measure.
  static constexpr double kSamplesPerElement = 6;

  double n_samples() const {
    const BlockGrid grid(samples_.field, samples_.block);
    double n = 0;
    for (const BlockNumber block : grid.blocks_with_samples(samples_.field))
      n += static_cast<double>(grid.samples_of(block).area());
    return std::max(n, 1.0);
  }

  const Samples& samples_;
  double share_ = 0;  // of reading
  std::uint64_t n_expected_ = 0;
  std::uint64_t n_read_ = 0;
};

/// Gives the progress of what is left to do.
Progress add_file(const std::string& mesh_path, const Samples& samples, BlockedMesh& mesh) {
  ReadingProgress reading(samples);
  MeshVisitor visitor;
  visitor.counts = [&](std::uint64_t n_vertices, std::uint64_t n_triangles) {
    reading.expect(n_vertices, n_triangles);
  };
  if (samples.colours != nullptr) visit_colours(mesh_path, *samples.colours, mesh, visitor);
  visitor.vertices = [&](std::span<const std::array<double, 3>> vertices) {
    mesh.add_vertices(vertices);
    reading.add(vertices.size());
  };
  visitor.triangles = [&](std::span<const std::array<std::uint64_t, 3>> triangles) {
    for (const auto& triangle : triangles) mesh.add_triangle(triangle);
    reading.add(triangles.size());
  };
  visit_mesh(mesh_path, visitor);
  if (samples.colours != nullptr) require_colours(mesh_path, mesh);
  mesh.close();
  return reading.of_measuring();
}

std::string scratch_folder(const std::string& mesh_path, const VerifyOptions& options) {
  return options.tmp.empty() ? std::filesystem::path(mesh_path).parent_path().string() : options.tmp;
}

}  // namespace

Certificate verify(const std::vector<std::string>& inputs, const std::string& mesh_path,
                   const InputOptions& input_options, const VerifyOptions& options) {
  const int threads = thread_count(options);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  const std::uint64_t memory = options.memory > 0 ? options.memory : machine_memory() / 4;
  const RasterField field(inputs, input_options);
  std::optional<ColourRaster> colours;
  if (!options.color.empty()) colours.emplace(options.color, field.frame(), field.width(), field.height());
  Samples samples{field, field.frame(), {}, options.progress, colours ? &*colours : nullptr};
  const BlockGrid grid(field, samples.block);
  const std::uint64_t working = working_memory(memory);
  // Vertices are let go of before blocks are measured. Colours take up to two thirds as much again.
  const std::uint64_t share = colours ? working / 7 : working / 4;
  BlockedMesh mesh(grid, field.frame(), {share, share, scratch_folder(mesh_path, options)});
  samples.progress = add_file(mesh_path, samples, mesh);
  return_free_memory();  // vertices, and facets that went to the disk
  return measure_blocks(mesh, samples, threads, working / 4 * 3);
}

}  // namespace tinsmith
