#pragma once
// The judge by several threads.

#include <cstdint>

#include "judge/measure.hpp"

namespace tinsmith {

/// Measures all blocks of a closed mesh, as many at a time as there are threads and as fit into `memory` bytes,
/// one at the least. The certificate does not depend on either. Throws Interrupted on request.
Certificate measure_blocks(BlockedMesh& mesh, const Samples& samples, int threads, std::uint64_t memory);

}  // namespace tinsmith
