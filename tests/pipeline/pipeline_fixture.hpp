#pragma once
// Runs of the whole engine for the tests of the pipeline.

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <atomic>
#include <string>

#include "io/raster_field.hpp"
#include "pipeline/rounds.hpp"
#include "stitch/welded_surface.hpp"
#include "support/random_grid.hpp"
#include "support/surface_check.hpp"

namespace tinsmith::test {

struct Outcome {
  TerrainMesh mesh;
  CompressReport report;
};

inline Outcome run_in(int threads, const HeightField& field, const GridFrame& frame, const RoundsOptions& options) {
  Outcome run;
  // More threads than the machine has, too.
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  arena.execute([&] { run.mesh = mesh_of(*run_rounds(field, frame, options, {}, run.report)); });
  return run;
}

inline Outcome run_on(const HeightGrid& grid, const RoundsOptions& options, int threads = 2) {
  return run_in(threads, GridField(grid), GridFrame{}, options);
}

/// A field that counts what is asked of it.
class CountedField : public GridField {
 public:
  using GridField::GridField;
  HeightGrid read(const GridRect& rect) const override {
    ++n_reads_;
    n_samples_ += rect.area();
    return GridField::read(rect);
  }
  int n_reads() const { return n_reads_; }
  std::int64_t n_samples() const { return n_samples_; }

 private:
  mutable std::atomic<int> n_reads_ = 0;
  mutable std::atomic<std::int64_t> n_samples_ = 0;
};

/// The sample terrain: 1025 x 1025 samples of mountains.
inline const RasterField& matterhorn() {
  static const RasterField field({std::string(TINSMITH_SOURCE_DIR) + "/data/matterhorn.tif"}, {});
  return field;
}

inline Outcome run_on_matterhorn(double tolerance, std::int32_t window) {
  return run_in(2, matterhorn(), matterhorn().frame(), {tolerance, window, Placement::kOptimal});
}

}  // namespace tinsmith::test
