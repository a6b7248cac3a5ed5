#include "io/mesh_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "io/glb.hpp"
#include "io/mesh_text.hpp"
#include "io/obj.hpp"
#include "io/ply.hpp"
#include "io/two_dm.hpp"
#include "io/vertex_colour.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr float kFullLevel = 255;

struct Format {
  std::string_view extension;
  std::uint64_t vertex_bytes;    // of a text line with the coordinates of a metric CRS, heights in full
  std::uint64_t colour_bytes;    // of a vertex with three channels
  std::uint64_t triangle_bytes;  // of a text line without the numbers of the vertices
  std::uint64_t digits;          // numbers of vertices on the two kinds of lines; 0: not a text
  void (*write)(const std::string&, const TerrainSurface&, const GridFrame&);
  std::string (*visit)(const std::string&, const MeshVisitor&);
};

constexpr std::array kFormats{
    Format{".ply", 24, 3, 13, 0, write_ply, visit_ply},
    Format{".obj", 45, 33, 5, 3, write_obj, visit_obj},
    Format{".glb", 12, 8, 12, 0, write_glb, visit_glb},
    Format{".2dm", 50, 0, 10, 4, write_two_dm, visit_two_dm},
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

/// Counts what was read, and complains of numbers that no mesh has.
struct SoundMesh {
  const std::string& path;
  std::uint64_t n_vertices = 0;
  std::uint64_t n_triangles = 0;

  void require_finite(std::span<const std::array<double, 3>> vertices) {
    for (const auto& vertex : vertices) {
      for (const double coordinate : vertex)
        if (!std::isfinite(coordinate))
          throw InputError(fmt::format("{}: vertex {} has a coordinate that is not finite; write the mesh again",
                                       path, n_vertices));
      ++n_vertices;
    }
  }

  void require_levels(std::span<const Levels> colours) const {
    for (const Levels& colour : colours) {
      for (const float level : colour)
        if (!(level >= 0 && level <= kFullLevel))
          throw InputError(fmt::format(
              "{}: a vertex from number {} on has a colour beyond 0 to 1; write the mesh again", path, n_vertices));
    }
  }

  void require_length(double metres) const {
    if (!(metres > 0 && std::isfinite(metres)))
      throw InputError(
          fmt::format("{}: says that a unit of height is {} metres; write the mesh again", path, metres));
  }

  void require_in_range(std::span<const std::array<std::uint64_t, 3>> triangles) {
    for (const auto& triangle : triangles) {
      for (const std::uint64_t corner : triangle)
        if (corner >= n_vertices)
          throw InputError(fmt::format("{}: triangle {} names vertex {} of {}; write the mesh again", path,
                                       n_triangles, corner, n_vertices));
      ++n_triangles;
    }
  }
};

void require_numbers(const std::string& path, std::uint64_t n_vertices) {
  if (n_vertices > std::uint64_t{1} << 32)
    throw ResourceError(fmt::format("{}: {} vertices are more than a mesh in memory can number; take a coarser one",
                                    path, n_vertices));
}

}  // namespace

bool is_mesh_path(const std::string& path) { return format_of(path) != nullptr; }

void require_mesh_extension(const std::string& path) {
  if (format_of(path) == nullptr) throw UsageError(unknown_extension(path));
}

double height_rounding(const std::string& path, double lowest, double highest) {
  return extension(path) == ".glb" ? glb_height_rounding(lowest, highest) : 0;
}

void require_format_holds(const std::string& path, std::uint64_t n_vertices, std::uint64_t n_triangles) {
  if (extension(path) == ".glb") require_glb_holds(path, n_vertices, n_triangles);
}

std::uint64_t expected_mesh_bytes(const std::string& path, std::uint64_t n_vertices, std::uint64_t n_triangles,
                                  int n_channels) {
  require_mesh_extension(path);
  const Format& format = *format_of(path);
  const std::uint64_t n_digits = format.digits * std::to_string(n_vertices).size();
  const std::uint64_t of_vertex = format.vertex_bytes + (n_channels > 0 ? format.colour_bytes : 0);
  return n_vertices * of_vertex + n_triangles * (format.triangle_bytes + n_digits);
}

void require_place_for_crs(const std::string& path, const std::string& crs_wkt) {
  const std::string format = extension(path);
  if (format == ".obj" || format == ".2dm") require_free_prj(path, crs_wkt);
}

void require_format_holds_colour(const std::string& path, int n_channels) {
  const std::string format = extension(path);
  if (n_channels > 0 && format == ".2dm")
    throw UsageError(fmt::format("{}: .2dm holds no colours; write .ply, .glb or .obj, or leave --color", path));
  if (n_stored_channels(n_channels) == 4 && format == ".obj")
    throw UsageError(
        fmt::format("{}: .obj holds no alpha, which {} channels of colour have; write .ply or .glb, or choose 1 or "
                    "3 bands with "
                    "gdal_translate -b",
                    path, n_channels));
}

void write_mesh(const std::string& path, const TerrainSurface& surface, const GridFrame& frame) {
  require_mesh_extension(path);
  require_format_holds_colour(path, surface.extent().n_channels);
  format_of(path)->write(path, surface, frame);
}

void write_mesh(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame) {
  write_mesh(path, MeshSurface(mesh), frame);
}

std::string visit_mesh(const std::string& path, const MeshVisitor& visitor) {
  const Format* format = format_of(path);
  if (format == nullptr) throw InputError(unknown_extension(path));
  SoundMesh sound{path};
  MeshVisitor checked = visitor;
  checked.vertices = [&](std::span<const std::array<double, 3>> vertices) {
    sound.require_finite(vertices);
    visitor.vertices(vertices);
  };
  checked.colours = [&](std::span<const Levels> colours, int n_channels) {
    sound.require_levels(colours);
    if (visitor.colours) visitor.colours(colours, n_channels);
  };
  checked.height_unit = [&](double metres) {
    sound.require_length(metres);
    if (visitor.height_unit) visitor.height_unit(metres);
  };
  checked.triangles = [&](std::span<const std::array<std::uint64_t, 3>> triangles) {
    sound.require_in_range(triangles);
    visitor.triangles(triangles);
  };
  return format->visit(path, checked);
}

Tin read_mesh(const std::string& path, std::vector<Levels>* colours) {
  Tin tin;
  MeshVisitor visitor;
  if (colours != nullptr) {
    colours->clear();
    visitor.colours = [&](std::span<const Levels> block, int /*n_channels*/) {
      colours->insert(colours->end(), block.begin(), block.end());
    };
  }
  visitor.counts = [&](std::uint64_t n_vertices, std::uint64_t n_triangles) {
    require_numbers(path, n_vertices);
    tin.vertices.reserve(n_vertices);
    tin.triangles.reserve(n_triangles);
  };
  visitor.vertices = [&](std::span<const std::array<double, 3>> vertices) {
    require_numbers(path, tin.vertices.size() + vertices.size());
    tin.vertices.insert(tin.vertices.end(), vertices.begin(), vertices.end());
  };
  visitor.triangles = [&](std::span<const std::array<std::uint64_t, 3>> triangles) {
    for (const auto& [a, b, c] : triangles)
      tin.triangles.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  };
  visitor.height_unit = [&](double metres) { tin.metres_per_height = metres; };
  tin.crs_wkt = visit_mesh(path, visitor);
  return tin;
}

}  // namespace tinsmith
