#include "io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include "io/glb.hpp"
#include "io/obj.hpp"
#include "io/ply.hpp"
#include "io/two_dm.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

struct Format {
  std::string_view extension;
  void (*write)(const std::string&, const TerrainMesh&, const GridFrame&);
  Tin (*read)(const std::string&);
};

constexpr std::array kFormats{
    Format{".ply", write_ply, read_ply},
    Format{".obj", write_obj, read_obj},
    Format{".glb", write_glb, read_glb},
    Format{".2dm", write_two_dm, read_two_dm},
};

std::string extension(const std::string& path) {
  std::string text = std::filesystem::path(path).extension().string();
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// Null when there is none.
const Format* format_of(const std::string& path) {
  const std::string wanted = extension(path);
  const auto found = std::find_if(kFormats.begin(), kFormats.end(), [&](auto& f) { return f.extension == wanted; });
  return found == kFormats.end() ? nullptr : &*found;
}

std::string unknown_extension(const std::string& path) {
  return fmt::format("{}: '{}' is no extension of a mesh file; use .ply, .obj, .glb or .2dm", path,
                     extension(path));
}

void require_sound(const std::string& path, const Tin& tin) {
  for (std::size_t v = 0; v < tin.vertices.size(); ++v)
    for (const double coordinate : tin.vertices[v])
      if (!std::isfinite(coordinate))
        throw InputError(
            fmt::format("{}: vertex {} has a coordinate that is not finite; write the mesh again", path, v));
  for (std::size_t t = 0; t < tin.triangles.size(); ++t)
    for (const std::uint32_t corner : tin.triangles[t])
      if (corner >= tin.vertices.size())
        throw InputError(fmt::format("{}: triangle {} names vertex {} of {}; write the mesh again", path, t, corner,
                                     tin.vertices.size()));
}

}  // namespace

bool is_mesh_path(const std::string& path) { return format_of(path) != nullptr; }

void require_mesh_extension(const std::string& path) {
  if (format_of(path) == nullptr) throw UsageError(unknown_extension(path));
}

double height_rounding(const std::string& path, double lowest, double highest) {
  return extension(path) == ".glb" ? glb_height_rounding(lowest, highest) : 0;
}

void write_mesh(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame) {
  require_mesh_extension(path);
  format_of(path)->write(path, mesh, frame);
}

Tin read_mesh(const std::string& path) {
  const Format* format = format_of(path);
  if (format == nullptr) throw InputError(unknown_extension(path));
  Tin tin = format->read(path);
  require_sound(path, tin);
  return tin;
}

std::string visit_mesh(const std::string& path, const MeshVisitor& visitor) {
  constexpr std::size_t kBlock = 4096;
  const Tin tin = read_mesh(path);
  const std::span<const std::array<double, 3>> vertices(tin.vertices);
  for (std::size_t i = 0; i < vertices.size(); i += kBlock)
    visitor.vertices(vertices.subspan(i, std::min(kBlock, vertices.size() - i)));
  std::vector<std::array<std::uint64_t, 3>> block;
  for (std::size_t t = 0; t < tin.triangles.size(); ++t) {
    const auto& [a, b, c] = tin.triangles[t];
    block.push_back({a, b, c});
    if (block.size() < kBlock && t + 1 < tin.triangles.size()) continue;
    visitor.triangles(block);
    block.clear();
  }
  return tin.crs_wkt;
}

}  // namespace tinsmith
