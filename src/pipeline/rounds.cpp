#include "pipeline/rounds.hpp"

#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>
#include <utility>
#include <vector>

#include "pipeline/typical_area.hpp"
#include "pipeline/window_queue.hpp"
#include "pipeline/workload.hpp"
#include "stitch/welded_surface.hpp"
#include "tile/chunk_store.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

class Stopwatch {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// After a stop there may be many windows to weld before the first task.
constexpr int kWindowsBetweenLooks = 64;

// How often a run begins anew, from what is whole, because a chunk was found damaged: then the disk is no good.
constexpr int kMostRestarts = 100;

// The surface and all that it is made of.
struct Finished {
  Finished(const HeightField& field, const RoundsOptions& options)
      : graph(field.width(), field.height(), options.window),
        store(graph, {options.folder, options.chunk_memory}),
        surface(
            graph, [this](std::int64_t window) { return store.result(window); },
            options.colours ? options.colours->n_channels() : 0) {}

  WindowGraph graph;
  ChunkStore store;
  WeldedSurface surface;
};

// One run through the tasks that are not done. A runner takes one task after the other; when none is ready it ends,
// and whoever makes more tasks ready than there are runners starts new ones.
class Run {
 public:
  Run(const HeightField& field, const GridFrame& frame, const RoundsOptions& options, const Progress& progress,
      Finished& result)
      : field_(field),
        frame_(frame),
        options_(options),
        progress_(progress),
        graph_(result.graph),
        store_(result.store),
        surface_(result.surface),
        workload_(field, graph_),
        queue_(graph_, [&](WindowName task) { return note_if_done(task); }) {}

  void operator()() {
    tell();  // where an earlier run stopped
    weld_what_is_done();
    if (is_whole()) return;
    typical_area_ = typical_area(field_, options_.tolerance);
    start_runners(n_most_);
    group_.wait();
    weld_what_is_done();
  }

  double seconds(int round) const { return seconds_[at(round)]; }

 private:
  bool is_whole() const { return surface_.n_added() == graph_.windows(graph_.last_round()).count(); }

  bool note_if_done(WindowName task) {
    if (!store_.is_done(task)) return false;
    workload_.add_done(task);
    return true;
  }

  void start_runners(std::int64_t n_ready) {
    const std::lock_guard lock(runners_mutex_);
    for (; n_ready > 0 && n_runners_ < n_most_; --n_ready, ++n_runners_) group_.run([this] { run_tasks(); });
  }

  void run_tasks() {
    try {
      while (const auto task = is_stopped_ ? std::nullopt : queue_.next()) {
        work(*task);
        workload_.add_done(*task);
        start_runners(queue_.done(*task) - 1);
        tell();
      }
    } catch (...) {
      is_stopped_ = true;
      throw;
    }
    const std::lock_guard lock(runners_mutex_);
    --n_runners_;
  }

  void work(WindowName task) {
    const Stopwatch stopwatch;
    if (task.round == 0) {
      work_first(task);
    } else {
      work_later(task);
    }
    if (task.round == graph_.last_round()) weld_what_is_done();
    const std::lock_guard lock(seconds_mutex_);
    seconds_[at(task.round)] += stopwatch.seconds();
  }

  void work_first(WindowName task) {
    if (workload_.is_void(task)) return store_.put_empty(task);
    const GridRect rect = graph_.samples(task);
    FirstChunk result =
        first_chunk(field_, rect, window_options(frame_, rect, options_, typical_area_), options_.colours);
    const WindowCounts counts{result.samples, result.valid_cells, result.start_triangles,
                              result.chunk.triangles.size()};
    store_.put(task, parts_of(task, std::move(result.chunk)), counts);
  }

  void work_later(WindowName task) {
    if (!store_.has_parts_for(task)) return store_.put_empty(task);
    const auto held = store_.parts_for(task);
    std::vector<const Chunk*> parts;
    parts.reserve(held.size());
    for (const auto& part : held) parts.push_back(part.get());
    const WindowOptions options = window_options(frame_, graph_.samples(task), options_, typical_area_);
    Chunk chunk = seam_chunk(field_, parts, options, options_.colours);
    const WindowCounts counts{0, 0, 0, chunk.triangles.size()};
    store_.put(task, parts_of(task, std::move(chunk)), counts);
  }

  std::vector<ChunkPart> parts_of(WindowName task, Chunk&& chunk) const {
    if (task.round < graph_.last_round()) return split(chunk, graph_.windows(task.round + 1));
    std::vector<ChunkPart> whole;
    if (!chunk.is_empty()) whole.push_back({task.window, std::move(chunk)});
    return whole;
  }

  // Results are welded in the order of the windows, by whoever comes by.
  void weld_what_is_done() {
    const std::unique_lock lock(weld_mutex_, std::try_to_lock);
    if (!lock) return;
    while (!is_whole() && store_.is_done({graph_.last_round(), surface_.n_added()})) {
      surface_.add_next();
      if (surface_.n_added() % kWindowsBetweenLooks == 0) tell();
    }
  }

  void tell() {
    if (!progress_) return;
    const std::lock_guard lock(tell_mutex_);
    told_ = std::max(told_, workload_.fraction());
    if (progress_(told_, "simplify")) return;
    throw Interrupted(options_.folder.empty() ? "interrupted; nothing was written"
                                              : "interrupted; the same command goes on from here");
  }

  const HeightField& field_;
  const GridFrame& frame_;
  const RoundsOptions& options_;
  const Progress& progress_;
  const WindowGraph& graph_;
  ChunkStore& store_;
  WeldedSurface& surface_;
  double typical_area_ = 0;  // known once there are tasks to do
  Workload workload_;
  WindowQueue queue_;
  tbb::task_group group_;
  std::mutex runners_mutex_;
  std::int64_t n_runners_ = 0;
  std::int64_t n_most_ = tbb::this_task_arena::max_concurrency();
  std::atomic<bool> is_stopped_ = false;
  std::mutex weld_mutex_;
  std::mutex tell_mutex_;
  double told_ = 0;
  std::mutex seconds_mutex_;
  std::array<double, kRounds> seconds_{};
};

void fill(CompressReport& report, const Finished& result, const Run& run) {
  const WindowCounts first = result.store.counts(0);
  report.windows = static_cast<std::uint64_t>(result.graph.windows(0).count());
  report.samples = first.samples;
  report.start_triangles = first.start_triangles;
  report.full_triangles = 2 * first.valid_cells;
  report.vertices = result.surface.extent().n_vertices;
  report.triangles = result.surface.extent().n_triangles;
  report.round_triangles.clear();
  report.round_seconds.clear();
  for (int r = 0; r < result.graph.n_rounds(); ++r) {
    report.round_triangles.push_back(result.store.counts(r).triangles);
    report.round_seconds.push_back(run.seconds(r));
  }
}

// A loss is found anew each time a run begins anew.
void remark_once(CompressReport& report, const std::string& remark) {
  if (std::find(report.remarks.begin(), report.remarks.end(), remark) == report.remarks.end())
    report.remarks.push_back(remark);
}

}  // namespace

WindowOptions window_options(const GridFrame& frame, const GridRect& window, const RoundsOptions& options,
                             double area) {
  const auto [step_x, step_y] =
      frame.metres_per_step(window.x0 + window.width / 2.0, window.y0 + window.height / 2.0);
  return {options.tolerance, step_y / step_x, options.placement, options.effort, options.colour, area};
}

std::shared_ptr<const TerrainSurface> run_rounds(const HeightField& field, const GridFrame& frame,
                                                 const RoundsOptions& options, const Progress& progress,
                                                 CompressReport& report) {
  for (int restarts = 0;; ++restarts) {
    const auto result = std::make_shared<Finished>(field, options);
    for (const std::string& loss : result->store.losses()) remark_once(report, loss + "; computed anew");
    Run run(field, frame, options, progress, *result);
    try {
      run();
      fill(report, *result, run);
      return {result, &result->surface};
    } catch (const DamagedChunk& damage) {
      if (restarts == kMostRestarts) throw OutputError(std::string(damage.what()) + "; choose another --tmp");
      remark_once(report, std::string(damage.what()) + "; computed anew");
    }
  }
}

}  // namespace tinsmith
