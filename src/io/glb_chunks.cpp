#include "io/glb_chunks.hpp"

#include <fmt/format.h>

#include <array>
#include <limits>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;  // "glTF"
constexpr std::uint64_t kHeaderBytes = 12;
constexpr std::uint64_t kChunkHeaderBytes = 8;

}  // namespace

std::uint32_t glb_size(const std::string& path, std::uint64_t json_size, std::uint64_t binary_size) {
  const std::uint64_t total = kHeaderBytes + 2 * kChunkHeaderBytes + json_size + binary_size;
  if (total > std::numeric_limits<std::uint32_t>::max())
    throw ResourceError(
        fmt::format("{}: {} bytes are more than the 4 GiB of a .glb; write .ply instead", path, total));
  return static_cast<std::uint32_t>(total);
}

void write_glb_header(OutputFile& file, std::uint32_t total_size) {
  const std::array<std::uint32_t, 3> header{kMagic, 2, total_size};
  file.write(header.data(), sizeof header);
}

void write_chunk_header(OutputFile& file, std::uint64_t size, std::uint32_t type) {
  const std::array<std::uint32_t, 2> header{static_cast<std::uint32_t>(size), type};
  file.write(header.data(), sizeof header);
}

void read_glb_header(InputFile& file) {
  if (file.read<std::uint32_t>() != kMagic || file.read<std::uint32_t>() != 2) file.fail("is no binary glTF 2");
  if (file.read<std::uint32_t>() != file.size()) file.fail("is not as long as its head says");
}

std::uint64_t read_chunk_header(InputFile& file, std::uint32_t type, const char* name) {
  const std::uint64_t size = file.read<std::uint32_t>();
  if (file.read<std::uint32_t>() != type || size > file.left())
    file.fail(fmt::format("has no whole {} chunk here", name));
  return size;
}

}  // namespace tinsmith
