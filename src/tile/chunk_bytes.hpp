#pragma once
// A chunk as bytes, for scratch files of this machine's run: as fast as copying memory.

#include <string>
#include <string_view>

#include "tile/chunk.hpp"

namespace tinsmith {

/// Appends the chunk's bytes.
void append_chunk(std::string& bytes, const Chunk& chunk);

/// The chunk again. The bytes are whole and undamaged: whoever kept them has checked.
Chunk chunk_from(std::string_view bytes);

/// What the chunk holds of memory, in bytes.
std::size_t bytes_held(const Chunk& chunk);

}  // namespace tinsmith
