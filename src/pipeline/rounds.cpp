#include "pipeline/rounds.hpp"

#include <tbb/parallel_for.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <utility>

#include "stitch/window_task.hpp"
#include "tile/chunk.hpp"
#include "tile/windows.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// Part of the whole run that each round takes, for the progress; measured on mountains at 10 m.
constexpr std::array<double, kRounds> kShare{0.9, 0.06, 0.04};

// Counts finished windows of a round and tells the caller; one thread at a time.
class RoundProgress {
 public:
  RoundProgress(const Progress& progress, int round, std::int64_t n_windows)
      : progress_(progress), round_(static_cast<std::size_t>(round)), n_windows_(n_windows) {
    for (std::size_t r = 0; r < round_; ++r) before_ += kShare[r];
  }

  void window_done() {
    const std::int64_t done = ++done_;
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    told_ = std::max(told_, done);
    const double fraction = before_ + kShare[round_] * static_cast<double>(told_) / static_cast<double>(n_windows_);
    if (!progress_(fraction, round_ == 0 ? "simplify" : "stitch"))
      throw Interrupted("interrupted; nothing was written");
  }

 private:
  const Progress& progress_;
  std::size_t round_;
  std::int64_t n_windows_;
  double before_ = 0;
  std::atomic<std::int64_t> done_ = 0;
  std::mutex mutex_;
  std::int64_t told_ = 0;
};

class Rounds {
 public:
  Rounds(const HeightField& field, const GridFrame& frame, const RoundsOptions& options, const Progress& progress,
         CompressReport& report)
      : field_(field), frame_(frame), options_(options), progress_(progress), report_(report) {
    report_.round_triangles.clear();
    report_.round_seconds.clear();
  }

  std::vector<Chunk> run() {
    std::vector<Chunk> chunks = first_round();
    if (chunks.size() > 1) {
      for (int round = 1; round < kRounds; ++round) chunks = seam_round(std::move(chunks), round);
    }
    return chunks;
  }

 private:
  WindowOptions window_options(const GridRect& window) const {
    const auto [step_x, step_y] =
        frame_.metres_per_step(window.x0 + window.width / 2.0, window.y0 + window.height / 2.0);
    return {options_.tolerance, step_y / step_x, options_.placement, options_.effort};
  }

  std::vector<Chunk> first_round() {
    const Stopwatch stopwatch;
    const WindowGrid windows = window_grid(field_.width(), field_.height(), options_.window, 0);
    RoundProgress progress(progress_, 0, windows.count());
    std::vector<FirstChunk> results(static_cast<std::size_t>(windows.count()));
    tbb::parallel_for(std::int64_t{0}, windows.count(), [&](std::int64_t w) {
      const GridRect rect = windows.samples(w, field_.width(), field_.height());
      results[static_cast<std::size_t>(w)] = first_chunk(field_, rect, window_options(rect));
      progress.window_done();
    });
    report_.windows = results.size();
    report_.samples = report_.start_triangles = report_.full_triangles = 0;
    std::vector<Chunk> chunks;
    chunks.reserve(results.size());
    for (FirstChunk& result : results) {
      report_.samples += result.samples;
      report_.start_triangles += result.start_triangles;
      report_.full_triangles += 2 * result.valid_cells;
      chunks.push_back(std::move(result.chunk));
    }
    note_round(stopwatch, chunks);
    return chunks;
  }

  std::vector<Chunk> seam_round(std::vector<Chunk>&& earlier, int round) {
    const Stopwatch stopwatch;
    const WindowGrid windows = window_grid(field_.width(), field_.height(), options_.window, round);
    std::vector<std::vector<ChunkPart>> parts(earlier.size());
    tbb::parallel_for(std::size_t{0}, earlier.size(), [&](std::size_t i) {
      parts[i] = split(earlier[i], windows);
      earlier[i] = {};
    });
    std::vector<std::vector<const Chunk*>> by_window(static_cast<std::size_t>(windows.count()));
    for (const auto& of_chunk : parts) {
      for (const ChunkPart& part : of_chunk)
        by_window[static_cast<std::size_t>(part.window)].push_back(&part.chunk);
    }
    RoundProgress progress(progress_, round, windows.count());
    std::vector<Chunk> chunks(by_window.size());
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t w) {
      const GridRect rect = windows.samples(static_cast<std::int64_t>(w), field_.width(), field_.height());
      chunks[w] = seam_chunk(field_, by_window[w], window_options(rect));
      progress.window_done();
    });
    note_round(stopwatch, chunks);
    return chunks;
  }

  void note_round(const Stopwatch& stopwatch, const std::vector<Chunk>& chunks) {
    std::uint64_t n = 0;
    for (const Chunk& chunk : chunks) n += chunk.triangles.size();
    report_.round_triangles.push_back(n);
    report_.round_seconds.push_back(stopwatch.seconds());
  }

  const HeightField& field_;
  const GridFrame& frame_;
  const RoundsOptions& options_;
  const Progress& progress_;
  CompressReport& report_;
};

TerrainMesh surface_of(const std::vector<Chunk>& chunks) {
  std::vector<const Chunk*> parts;
  parts.reserve(chunks.size());
  for (const Chunk& chunk : chunks) parts.push_back(&chunk);
  WindowMesh mesh = mesh_of(weld(parts));
  TerrainMesh surface;
  surface.triangles.reserve(mesh.origin.size() / 3);
  for (std::size_t h = 0; h < mesh.origin.size(); h += 3) {
    const auto name = [&](std::size_t k) { return static_cast<std::uint32_t>(mesh.origin[h + k]); };
    surface.triangles.push_back({name(0), name(1), name(2)});
  }
  surface.position = std::move(mesh.position);
  surface.height = std::move(mesh.height);
  return surface;
}

}  // namespace

TerrainMesh run_rounds(const HeightField& field, const GridFrame& frame, const RoundsOptions& options,
                       const Progress& progress, CompressReport& report) {
  TerrainMesh surface = surface_of(Rounds(field, frame, options, progress, report).run());
  report.vertices = surface.position.size();
  report.triangles = surface.triangles.size();
  return surface;
}

}  // namespace tinsmith
