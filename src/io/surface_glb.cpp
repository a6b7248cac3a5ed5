#include "io/surface_glb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/glb_chunks.hpp"
#include "io/linear_colour.hpp"
#include "io/output_file.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

using Json = nlohmann::ordered_json;
using Place = std::array<double, 3>;
using LocalPlace = std::array<float, 3>;
using Shares = std::array<std::uint16_t, 4>;  // of red, green, blue, and full alpha: it fills glTF's four bytes

static_assert(std::endian::native == std::endian::little, "glTF is written in the machine's byte order");

constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;

/// Where the node stands: in the middle of the box along the axes on which float32 does not hold the coordinates
/// as they are, at 0 along the others, so that what came from float32 comes back the same.
Place origin_of(const Surface& surface) {
  Place low = surface.position.at(0);
  Place high = low;
  std::array<bool, 3> is_exact{true, true, true};
  for (const Place& place : surface.position)
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], place[k]);
      high[k] = std::max(high[k], place[k]);
      is_exact[k] = is_exact[k] && std::abs(place[k]) <= std::numeric_limits<float>::max() &&
                    static_cast<double>(static_cast<float>(place[k])) == place[k];
    }
  Place origin;
  for (std::size_t k = 0; k < 3; ++k) origin[k] = is_exact[k] ? 0 : low[k] / 2 + high[k] / 2;
  return origin;
}

LocalPlace local_place(const Place& place, const Place& origin) {
  return {static_cast<float>(place[0] - origin[0]), static_cast<float>(place[1] - origin[1]),
          static_cast<float>(place[2] - origin[2])};
}

void require_float_holds(const std::string& path, const Surface& surface, const Place& origin) {
  for (const Place& place : surface.position)
    for (std::size_t k = 0; k < 3; ++k)
      if (!(std::abs(place[k] - origin[k]) <= std::numeric_limits<float>::max()))
        throw ResourceError(
            fmt::format("{}: {} is beyond the float32 of glTF; write .ply instead", path, place[k]));
}

/// The arrays in the binary chunk, in order.
struct Description {
  Json views = Json::array();
  Json accessors = Json::array();
  std::uint64_t binary_size = 0;

  /// Returns the number of the accessor.
  std::size_t add(Json accessor, std::uint64_t size, int target) {
    views.push_back({{"buffer", 0}, {"byteOffset", binary_size}, {"byteLength", size}, {"target", target}});
    binary_size += padded(size);
    accessor["bufferView"] = views.size() - 1;
    accessors.push_back(std::move(accessor));
    return accessors.size() - 1;
  }
};

Json vectors_accessor(std::size_t n_vertices) {
  return {{"componentType", kFloat}, {"count", n_vertices}, {"type", "VEC3"}};
}

Json places_accessor(const Surface& surface, const Place& origin) {
  LocalPlace low = local_place(surface.position[0], origin);
  LocalPlace high = low;
  for (const Place& place : surface.position) {
    const LocalPlace local = local_place(place, origin);
    for (std::size_t k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], local[k]);
      high[k] = std::max(high[k], local[k]);
    }
  }
  Json accessor = vectors_accessor(surface.position.size());
  // As doubles: the shortest decimals of a float are not the float to those who read doubles.
  accessor["min"] = Place{low[0], low[1], low[2]};
  accessor["max"] = Place{high[0], high[1], high[2]};
  return accessor;
}

/// Index 65535 is not a vertex in glTF.
std::uint64_t index_bytes(const Surface& surface) { return surface.position.size() < 65536 ? 2 : 4; }

std::string json_text(const Surface& surface, const Place& origin) {
  const std::size_t n_vertices = surface.position.size();
  const std::uint64_t vectors_size = n_vertices * sizeof(LocalPlace);
  Description description;
  Json attributes;
  attributes["POSITION"] = description.add(places_accessor(surface, origin), vectors_size, kVertexBuffer);
  if (surface.find(AttributeKind::kNormal) != nullptr)
    attributes["NORMAL"] = description.add(vectors_accessor(n_vertices), vectors_size, kVertexBuffer);
  if (surface.find(AttributeKind::kColour) != nullptr)
    attributes["COLOR_0"] =
        description.add({{"componentType", kUint16}, {"normalized", true}, {"count", n_vertices}, {"type", "VEC4"}},
                        n_vertices * sizeof(Shares), kVertexBuffer);
  const std::uint64_t n_corners = 3 * surface.triangles.size();
  const std::size_t indices = description.add(
      {{"componentType", index_bytes(surface) == 2 ? kUint16 : kUint32}, {"count", n_corners}, {"type", "SCALAR"}},
      n_corners * index_bytes(surface), kIndexBuffer);
  Json json;
  json["asset"] = {{"version", "2.0"}, {"generator", "tinsmith"}};
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"mesh", 0}, {"translation", origin}}};
  json["meshes"] = {{{"primitives", {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}};
  json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  json["accessors"] = description.accessors;
  json["bufferViews"] = description.views;
  json["buffers"] = {{{"byteLength", description.binary_size}}};
  std::string text = json.dump();
  text.resize(padded(text.size()), ' ');
  return text;
}

void write_normals(OutputFile& file, const Surface& surface) {
  const SurfaceAttribute* const normal = surface.find(AttributeKind::kNormal);
  if (normal != nullptr) file.write(normal->values.data(), normal->values.size() * sizeof(float));
}

void write_colours(OutputFile& file, const Surface& surface) {
  const SurfaceAttribute* const colour = surface.find(AttributeKind::kColour);
  if (colour == nullptr) return;
  for (std::size_t k = 0; k < colour->values.size(); k += 3) {
    Shares shares{0, 0, 0, std::numeric_limits<std::uint16_t>::max()};
    for (std::size_t i = 0; i < 3; ++i) shares[i] = share_of_level(255.0 * double{colour->values[k + i]});
    file.write(shares.data(), sizeof shares);
  }
}

void write_indices(OutputFile& file, const Surface& surface) {
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t corner : triangle) file.write(&corner, index_bytes(surface));
  const std::uint64_t size = 3 * surface.triangles.size() * index_bytes(surface);
  file.write(std::string(padded(size) - size, '\0'));
}

std::uint64_t binary_size(const Surface& surface) {
  std::uint64_t size = surface.position.size() * sizeof(LocalPlace);
  if (surface.find(AttributeKind::kNormal) != nullptr) size += surface.position.size() * sizeof(LocalPlace);
  if (surface.find(AttributeKind::kColour) != nullptr) size += surface.position.size() * sizeof(Shares);
  return size + padded(3 * surface.triangles.size() * index_bytes(surface));
}

}  // namespace

void write_surface_glb(const std::string& path, const Surface& surface) {
  if (surface.triangles.empty())
    throw ResourceError(path + ": glTF can't hold a mesh without triangles; write .ply instead");
  const Place origin = origin_of(surface);
  require_float_holds(path, surface, origin);
  const std::string json = json_text(surface, origin);
  const std::uint32_t total = glb_size(path, json.size(), binary_size(surface));

  OutputFile file(path);
  write_glb_header(file, total);
  write_chunk_header(file, json.size(), kJsonChunk);
  file.write(json);
  write_chunk_header(file, binary_size(surface), kBinChunk);
  for (const Place& place : surface.position) {
    const LocalPlace local = local_place(place, origin);
    file.write(local.data(), sizeof local);
  }
  write_normals(file, surface);
  write_colours(file, surface);
  write_indices(file, surface);
  file.commit();
}

}  // namespace tinsmith
