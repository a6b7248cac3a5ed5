#pragma once
// The judge without files: a mesh in memory against a field.

#include "judge/coverage.hpp"
#include "tinsmith/certificate.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// Everything in the certificate. The mesh is in the CRS of samples.frame, all its indices in range.
Certificate measure(const Tin& tin, const Samples& samples);

}  // namespace tinsmith
