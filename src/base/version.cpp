#include "tinsmith/version.hpp"

namespace tinsmith {

const char* version() noexcept { return TINSMITH_VERSION; }

}  // namespace tinsmith
