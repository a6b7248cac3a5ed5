#pragma once
// DEM in, TIN out.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tinsmith/certificate.hpp"
#include "tinsmith/options.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// What a compression did. Heights and the tolerance are in metres.
struct CompressReport {
  double tolerance = 0;       // that the result was made with (found by search for triangles and ratio)
  std::uint64_t samples = 0;  // valid samples
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  std::uint64_t full_triangles = 0;            // of the full grid: two for each valid 2 x 2 block
  std::uint64_t windows = 0;                   // of round 0
  int threads = 0;                             // windows at a time; 0 for heights in memory
  std::uint64_t start_triangles = 0;           // after select and triangulate
  std::vector<std::uint64_t> round_triangles;  // after each round
  std::vector<double> round_seconds;           // spent in the tasks of the round, all threads added up
  std::uint64_t unreadable_inputs = 0;         // left as voids, wholly or in part (InputOptions::skip_unreadable)
  std::vector<std::string> remarks;            // what the user should be told once
};

/// Called when the output stands under its name and the unfinished work is still there: when it throws, the same
/// call of compress() goes on from that. For verify(), which is long.
using WhenWritten = std::function<void(const CompressReport& report)>;

/// Reads the rasters as one grid, compresses them and writes `output` (.ply .obj .glb .2dm). The bytes
/// written depend on the inputs and options only, not on threads. A raster `color` of 1 to 4 bands, in any CRS and
/// resolution, gives the vertices colours (not in .2dm, .obj without alpha), which weigh in what is kept; the
/// largest vertical error is the same promise. Where it has none they are white. Throws one of tinsmith/error.hpp;
/// then what stood at `output` before still stands there, unless it was `when_written` that threw. The caller
/// measures the result with verify().
CompressReport compress(const std::vector<std::string>& inputs, const std::string& output,
                        const InputOptions& input_options, const CompressOptions& options,
                        const WhenWritten& when_written = {});

/// A grid of heights in memory: row by row, width * height of them, NaN is a void. Steps in metres.
struct HeightArray {
  std::int32_t width = 0;
  std::int32_t height = 0;
  const double* z = nullptr;  // not owned
  double step_x = 1;          // metres between columns
  double step_y = 1;          // metres between rows
};

/// The same for heights in memory: x = column * step_x, y = row * step_y, z as given.
Tin compress(const HeightArray& heights, const CompressOptions& options, CompressReport* report = nullptr);

}  // namespace tinsmith
