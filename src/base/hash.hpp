#pragma once
// A number for a text, the same on any machine.

#include <cstdint>
#include <string_view>

namespace tinsmith {

/// FNV-1a.
inline std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return hash;
}

}  // namespace tinsmith
