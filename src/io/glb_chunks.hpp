#pragma once
// The container of binary glTF 2: a header, a chunk of JSON, a chunk of bytes.

#include <cstdint>
#include <string>

#include "io/input_file.hpp"
#include "io/output_file.hpp"

namespace tinsmith {

constexpr std::uint32_t kJsonChunk = 0x4E4F534A;  // "JSON"
constexpr std::uint32_t kBinChunk = 0x004E4942;   // "BIN"

/// Padding to the four bytes that glTF wants.
constexpr std::uint64_t padded(std::uint64_t size) { return (size + 3) / 4 * 4; }

/// The size of a file with these two chunks. Throws ResourceError when it is more than the header can say.
std::uint32_t glb_size(const std::string& path, std::uint64_t json_size, std::uint64_t binary_size);

void write_glb_header(OutputFile& file, std::uint32_t total_size);
void write_chunk_header(OutputFile& file, std::uint64_t size, std::uint32_t type);

/// Complains unless the file is a glTF 2 of the size that it says.
void read_glb_header(InputFile& file);

/// The size of the chunk that begins here. Complains when it is of another type, or not whole.
std::uint64_t read_chunk_header(InputFile& file, std::uint32_t type, const char* name);

}  // namespace tinsmith
