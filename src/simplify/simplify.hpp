#pragma once
// Edge collapse in the order of the quadric error, under an error bound (DESIGN section 4).
//
// Sources: Garland and Heckbert 1997 (quadric error), Lindstrom and Turk 1998 (quadrics of the present mesh),
// and the paper's steps 2 to 7 with its half-space test, eq. 12-24, in the horizontal plane, where it is exact.

#include <cstddef>
#include <cstdint>
#include <limits>

#include "mesh/window_mesh.hpp"
#include "samples/colour_grid.hpp"
#include "samples/height_grid.hpp"
#include "simplify/colour_fit.hpp"
#include "simplify/labour.hpp"
#include "tinsmith/options.hpp"

namespace tinsmith {

struct SimplifyOptions {
  double tolerance = 0;  // vertical units of the samples: no sample under the mesh is ever farther off
  Placement placement = Placement::kOptimal;
  Labour labour;
  bool only_unsettled = false;  // start only from vertices that are not settled, and from what changes around them
  ColourOptions colour = {};    // of meshes that have colours
  // Cells: of most triangles of the whole surface. No new star may have far more squared error than these.
  double typical_area = std::numeric_limits<double>::infinity();
};

/// What happened, for reports and for tests that want to know that they tested something.
struct SimplifyCounts {
  std::uint64_t collapses = 0;
  std::uint64_t moves = 0;
  std::uint64_t flips = 0;
  std::uint64_t refused_topology = 0;    // link condition, shape, valence
  std::uint64_t refused_half_space = 0;  // every candidate outside the kernel
  std::uint64_t refused_bound = 0;       // no feasible height at any candidate
  std::uint64_t refused_colour = 0;      // heights, but no colour within the colour tolerance
};

/// Collapses edges until none is legal. Before and after: every sample in or on a triangle is within the
/// tolerance of it, kinds and invariants of the mesh hold. `samples` must contain every sample under the mesh.
/// With colours the mesh has one at every vertex, `colours` holds one for every sample under it, and what would
/// spoil them is refused too; vertices that are not locked end with those that fit the samples best.
SimplifyCounts simplify(WindowMesh& mesh, const HeightGrid& samples, const SimplifyOptions& options,
                        const ColourGrid* colours = nullptr);

}  // namespace tinsmith
