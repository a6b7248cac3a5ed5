#pragma once
// How a long run tells its caller where it is.

#include <functional>
#include <string_view>

namespace tinsmith {

/// Called from one thread at a time with the fraction done (0 to 1, never falling within a stage) and the
/// name of the stage. Returning false stops the run with Interrupted. An empty function reports nothing.
using Progress = std::function<bool(double fraction, std::string_view stage)>;

}  // namespace tinsmith
