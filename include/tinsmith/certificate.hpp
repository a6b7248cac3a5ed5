#pragma once
// What the judge measured on a mesh file, against every sample of the input.

#include <cstdint>
#include <string>
#include <vector>

namespace tinsmith {

/// Heights in metres, areas in square metres, whatever the units of the input. "Sample" is a valid raster
/// cell at its cell centre; a sample counts as coverable when a fully valid 2 x 2 block of samples has it as
/// a corner.
struct Certificate {
  std::uint64_t samples = 0;        // valid samples
  std::uint64_t covered = 0;        // coverable samples that lie in or on a triangle
  std::uint64_t uncovered = 0;      // coverable samples that lie in none
  std::uint64_t overlapped = 0;     // samples strictly inside more than one triangle
  std::uint64_t voids_covered = 0;  // void cells whose centre lies strictly inside a triangle
  std::uint64_t vertices = 0;
  std::uint64_t triangles = 0;
  double max_error = 0;         // largest |z_TIN - z_sample| over the valid samples in or on a triangle
  double max_error_column = 0;  // where: grid column and row of that sample
  double max_error_row = 0;
  double rmse = 0;
  double mean_error = 0;                    // mean of z_TIN - z_sample: the bias
  double p99_error = 0;                     // 99 % of them have at most this |error|; known to 1.6 %
  std::uint64_t folded = 0;                 // triangles whose area in plan is not positive
  std::uint64_t non_manifold_edges = 0;     // used by more than two triangles, or twice in one direction
  std::uint64_t non_manifold_vertices = 0;  // whose triangles form more than one fan
  std::uint64_t t_junctions = 0;            // vertices in the inside of another triangle's edge
  std::uint64_t unwelded_edges = 0;         // border edges that lie on another one in plan: a crack
  std::uint64_t components = 0;             // connected by edges
  double area_plan = 0;                     // of the triangles
  double area_valid = 0;                    // of the fully valid 2 x 2 blocks
  double cells_plan = 0;                    // the same two in cells of the grid, where they can be compared exactly
  double cells_valid = 0;
  std::uint64_t color_samples = 0;  // samples with colour in or on a triangle; 0 too when colours were not measured
  double color_rmse = 0;            // levels of 255, over these samples and the channels of the file
  double color_max_error = 0;       // largest difference of a channel, levels of 255
  double rounding = 0;              // what double arithmetic alone may add to an error at these heights

  /// Empty when everything holds; otherwise one sentence for each thing that does not. A tolerance below
  /// zero means: none was asked for.
  std::vector<std::string> broken_promises(double tolerance) const;
};

}  // namespace tinsmith
