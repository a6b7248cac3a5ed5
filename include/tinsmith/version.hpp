#pragma once

namespace tinsmith {

/// The version of the library, "major.minor.patch".
const char* version() noexcept;

}  // namespace tinsmith
