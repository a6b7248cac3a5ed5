#pragma once
// The work on one window: a pure function of samples, options and the chunks that touch it. The same task
// runs for every window of a round, in any order, on any thread.

#include <cstdint>
#include <limits>
#include <vector>

#include "samples/colour_grid.hpp"
#include "samples/height_grid.hpp"
#include "simplify/colour_fit.hpp"
#include "tile/chunk.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

struct WindowOptions {
  double tolerance = 0;  // vertical units
  double aspect = 1;     // metres between rows / metres between columns, at the window
  Placement placement = Placement::kOptimal;
  Effort effort = Effort::kDefault;
  ColourOptions colour = {};  // for fields with colours
  // Cells: of the triangles of the whole surface, see typical_area()
  double typical_area = std::numeric_limits<double>::infinity();
};

/// The tolerance less what the rounding of doubles may add when somebody else measures. A tolerance of nearly zero
/// is taken as that rounding: exact planes are planes.
double safe_tolerance(const HeightGrid& samples, double tolerance);

/// What a task of round 0 gives.
struct FirstChunk {
  Chunk chunk;
  std::uint64_t start_triangles = 0;  // before simplification
  std::uint64_t valid_cells = 0;
  std::uint64_t samples = 0;  // valid ones; the window's right and lower border are its neighbours'
};

/// Round 0: select, triangulate, simplify; the vertices on the window's border stay as they are.
/// With `colours`, which lie on the grid of the field, every sample is selected, and vertices have colours.
FirstChunk first_chunk(const HeightField& field, const GridRect& window, const WindowOptions& options,
                       const ColourField* colours = nullptr);

/// Later rounds: the parts of the earlier round's chunks that belong to the window are welded, and the seams
/// that now lie inside dissolve. `colours` as in round 0.
Chunk seam_chunk(const HeightField& field, const std::vector<const Chunk*>& parts, const WindowOptions& options,
                 const ColourField* colours = nullptr);

}  // namespace tinsmith
