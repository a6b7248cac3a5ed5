#pragma once
// Whether inputs that overlap agree: neighbours that share a border row should.

#include <cstdint>
#include <optional>
#include <string>

#include "geodesy/grid_frame.hpp"
#include "io/mosaic.hpp"
#include "io/raster_index.hpp"
#include "io/raster_inputs.hpp"

namespace tinsmith {

/// Two inputs where both hold a valid height.
struct OverlapCheck {
  std::size_t a = 0;  // inputs, a before b
  std::size_t b = 0;
  std::uint64_t n_compared = 0;
  std::uint64_t n_differing = 0;  // by more than a float's rounding
  double largest = 0;             // difference in the vertical unit
  std::int32_t column = 0;        // of the largest, in the mosaic
  std::int32_t row = 0;
};

/// All of them.
struct OverlapReport {
  std::uint64_t n_pairs = 0;  // that overlap
  std::uint64_t n_compared_pairs = 0;
  std::uint64_t n_differing_pairs = 0;
  bool is_partial = false;  // not all overlapping samples were compared
  OverlapCheck worst;       // by largest difference; the first one of equals
};

/// Compares the inputs where they overlap, reading no more than the overlaps. As much is decoded as 270 million
/// samples or a sixteenth of the inputs, whichever is more; beyond that evenly spread parts of the overlaps are
/// compared, the same ones in every run. Throws UnreadableError.
OverlapReport compare_overlaps(const RasterInputs& inputs, const RasterIndex& index, const Mosaic& mosaic);

/// One sentence on the disagreement; none when there is none.
std::optional<std::string> remark_on_overlaps(const OverlapReport& report, const RasterInputs& inputs,
                                              const GridFrame& frame);

}  // namespace tinsmith
