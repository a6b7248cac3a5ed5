#pragma once
// The judge: a mesh in memory against a field, and the steps of it for meshes that are not in memory.

#include <cstdint>

#include "geodesy/grid_frame.hpp"
#include "judge/blocked_mesh.hpp"
#include "judge/findings.hpp"
#include "samples/colour_grid.hpp"
#include "samples/height_grid.hpp"
#include "tinsmith/certificate.hpp"
#include "tinsmith/progress.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// The raster that a mesh is judged against, and how: block by block, so that neither need fit in memory.
struct Samples {
  const HeightField& field;
  const GridFrame& frame;
  BlockSize block;
  Progress progress;
  const ColourField* colours = nullptr;  // on the grid of the field; null: those of the mesh are not measured
};

/// Everything in the certificate, the same for all sizes of blocks and all budgets. The mesh is in the CRS of
/// samples.frame, all its indices in range.
Certificate measure(const Tin& tin, const Samples& samples, const Budget& budget = {});

/// The blocks in which there is anything to measure, in their order.
std::vector<BlockNumber> blocks_to_measure(const BlockedMesh& mesh, const HeightField& field);

/// Bytes that measuring a block takes, about.
std::uint64_t memory_of(const BlockedMesh& mesh, BlockNumber block, const Samples& samples);

/// Adds all that is found in a block. Several threads may measure different blocks of a mesh.
void measure_block(BlockedMesh& mesh, BlockNumber block, const Samples& samples, Findings& findings);

/// From the findings of all blocks. Throws nothing.
Certificate conclude(const BlockedMesh& mesh, Findings findings, const GridFrame& frame);

/// Throws Interrupted when the caller wants to stop.
void report_progress(const Samples& samples, double fraction);

}  // namespace tinsmith
