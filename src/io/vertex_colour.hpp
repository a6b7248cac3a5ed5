#pragma once
// Colours of vertices as mesh files hold them: red, green, blue and perhaps alpha, whole levels.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/colour.hpp"
#include "io/input_file.hpp"
#include "io/mesh_file.hpp"

namespace tinsmith {

/// Grey becomes red, green and blue; two channels are grey and alpha.
constexpr int n_stored_channels(int n_channels) { return n_channels == 0 ? 0 : n_channels % 2 == 1 ? 3 : 4; }

/// The stored bytes of a colour; without alpha the fourth is 0.
inline std::array<std::uint8_t, 4> stored_colour(const Levels& colour, int n_channels) {
  std::array<std::uint8_t, 4> bytes{};
  for (std::size_t i = 0; i < kMaxChannels; ++i)
    bytes[i] = static_cast<std::uint8_t>(std::lround(std::clamp(colour[i], 0.0F, 255.0F)));
  const auto [first, second, third, fourth] = bytes;
  if (n_channels == 3) return {first, second, third, 0};
  if (n_channels == 4) return {first, second, third, fourth};
  return {first, first, first, n_channels == 2 ? second : std::uint8_t{0}};
}

/// The levels of so many stored bytes.
inline Levels levels_of_bytes(const char* bytes, int n_stored) {
  Levels levels{};
  for (int i = 0; i < n_stored; ++i)
    levels[static_cast<std::size_t>(i)] = static_cast<float>(static_cast<unsigned char>(bytes[i]));
  return levels;
}

/// A vertex as a file holds it, in CRS coordinates.
struct ColouredVertex {
  std::array<double, 3> position{};
  Levels colour{};
};

/// Hands a block of vertices on: first their colours, if there are any and somebody wants them, then their
/// positions.
inline void visit_coloured(std::span<const ColouredVertex> vertices, int n_stored, const MeshVisitor& visitor) {
  if (n_stored > 0 && visitor.colours) {
    std::vector<Levels> colours(vertices.size());
    std::transform(vertices.begin(), vertices.end(), colours.begin(), [](const auto& v) { return v.colour; });
    visitor.colours(colours, n_stored);
  }
  std::vector<std::array<double, 3>> positions(vertices.size());
  std::transform(vertices.begin(), vertices.end(), positions.begin(), [](const auto& v) { return v.position; });
  visitor.vertices(positions);
}

/// Where a binary file has its vertices: so many, in records of so many bytes, with this many channels of colour at
/// an offset, and what makes levels of them.
struct VertexRecords {
  std::uint64_t n = 0;
  std::size_t bytes = 0;
  int n_stored = 0;
  std::size_t colour_offset = 0;
  Levels (*levels_at)(const char* bytes, int n_stored) = levels_of_bytes;
};

/// Visits the vertices, of which position_at(bytes) makes the place.
template <class PositionAt>
void visit_vertex_records(InputFile& file, const VertexRecords& records, PositionAt position_at,
                          const MeshVisitor& visitor) {
  if (records.n_stored == 0) {
    visit_records(file, records.n, records.bytes, position_at, visitor.vertices);
    return;
  }
  const std::function<void(std::span<const ColouredVertex>)> visit = [&](std::span<const ColouredVertex> vertices) {
    visit_coloured(vertices, records.n_stored, visitor);
  };
  visit_records(
      file, records.n, records.bytes,
      [&](const char* bytes) {
        return ColouredVertex{position_at(bytes),
                              records.levels_at(bytes + records.colour_offset, records.n_stored)};
      },
      visit);
}

}  // namespace tinsmith
