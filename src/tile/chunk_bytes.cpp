#include "tile/chunk_bytes.hpp"

#include <cstring>

#include "base/check.hpp"

namespace tinsmith {

namespace {

template <class T>
void append_vector(std::string& bytes, const std::vector<T>& values) {
  const std::uint64_t n = values.size();
  bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  bytes.append(reinterpret_cast<const char*>(values.data()), n * sizeof(T));
}

template <class T>
void take_vector(std::string_view& bytes, std::vector<T>& values) {
  std::uint64_t n = 0;
  TINSMITH_ASSERT(bytes.size() >= sizeof n);
  std::memcpy(&n, bytes.data(), sizeof n);
  bytes.remove_prefix(sizeof n);
  TINSMITH_ASSERT(bytes.size() >= n * sizeof(T));
  values.resize(n);
  if (n > 0) std::memcpy(values.data(), bytes.data(), n * sizeof(T));
  bytes.remove_prefix(n * sizeof(T));
}

template <class ChunkType, class F>
void for_each_vector(ChunkType& chunk, F&& f) {
  f(chunk.position);
  f(chunk.height);
  f(chunk.is_settled);
  f(chunk.triangles);
  f(chunk.colour);
}

}  // namespace

void append_chunk(std::string& bytes, const Chunk& chunk) {
  for_each_vector(chunk, [&](const auto& values) { append_vector(bytes, values); });
}

Chunk chunk_from(std::string_view bytes) {
  Chunk chunk;
  for_each_vector(chunk, [&](auto& values) { take_vector(bytes, values); });
  return chunk;
}

std::size_t bytes_held(const Chunk& chunk) {
  std::size_t n = sizeof(Chunk);
  for_each_vector(chunk, [&](const auto& values) { n += values.capacity() * sizeof(values[0]); });
  return n;
}

}  // namespace tinsmith
