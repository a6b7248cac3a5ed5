#pragma once
// What a caller may choose. Every field has its default, unit and meaning on its line.

#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "tinsmith/progress.hpp"

namespace tinsmith {

/// Which height counts where several inputs hold a valid one.
enum class Overlap {
  kFirst,  // of the input named first
  kLast,   // of the input named last
  kMean,   // the mean of all
};

/// Which samples of the inputs count.
struct InputOptions {
  int band = 1;                               // GDAL's numbering, from 1
  std::optional<double> nodata;               // overrides what the files declare; NaN is a value too
  std::optional<std::array<double, 4>> bbox;  // west, south, east, north in the input's CRS: cell centres inside
  std::optional<double> vertical_unit;        // metres per unit of height; overrides what the files declare
  Overlap overlap = Overlap::kFirst;
  bool skip_unreadable = false;  // what can't be opened or read becomes void instead of an InputError
};

/// Where a collapsed edge's new vertex may lie.
enum class Placement {
  kOptimal,  // anywhere in the kernel of the star, on a lattice of 1/16 cell
  kSegment,  // on the edge
  kSubset,   // at one of its ends: every vertex of the result is a sample, with the sample's own height
};

/// How much refinement follows the first pass: vertices move, edges flip, and what becomes legal collapses.
/// On the sample terrain at 10 m, fast : default : best need 1 : 1.35 : 2.55 of the time and 1 : 0.97 : 0.89 of the
/// triangles.
enum class Effort {
  kFast,     // none
  kDefault,  // one round
  kBest,     // eight rounds
};

/// What a compression aims for and how. Exactly one of max_error, triangles and ratio must be set.
struct CompressOptions {
  std::optional<double> max_error;  // metres: largest vertical error against any sample
  std::optional<double> triangles;  // at most so many triangles, with the least error that reaches it
  std::optional<double> ratio;      // the same as a fraction (0 to 1] of the full grid's triangles
  std::string color;  // raster that gives the vertices colours; empty: none. For compress() of rasters only
  double color_tolerance = 12;  // levels of 255: root mean square that no collapse may exceed about itself; above 0
  Placement placement = Placement::kOptimal;
  Effort effort = Effort::kDefault;
  int window = 192;          // samples along a window's side; may change the result, never its guarantees
  int threads = 0;           // 0: as many as the machine has; never changes the result
  std::uint64_t memory = 0;  // bytes for the whole process; 0: a quarter of the machine's; never changes the result
  std::string tmp;           // folder for unfinished work; empty: beside the output; never changes the result
  bool fresh = false;        // throw away the unfinished work of another run on the same output
  Progress progress;         // empty: silent
  std::function<void(const std::string&)> doubt;  // told before the work where the disks may not suffice
};

}  // namespace tinsmith
