// Surface files by extension, and what every surface that was read must be.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <string_view>

#include "io/surface_glb.hpp"
#include "io/surface_obj.hpp"
#include "io/surface_ply.hpp"
#include "io/surface_stl.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {
namespace {

struct Format {
  std::string_view extension;
  Surface (*read)(const std::string&);
  void (*write)(const std::string&, const Surface&);
};

constexpr std::array kFormats{
    Format{".ply", read_surface_ply, write_surface_ply},
    Format{".obj", read_surface_obj, write_surface_obj},
    Format{".stl", read_surface_stl, write_surface_stl},
    Format{".glb", read_surface_glb, write_surface_glb},
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
  return fmt::format("{}: '{}' is no extension of a surface file; use .ply, .obj, .stl or .glb", path,
                     extension(path));
}

void require_finite_places(const std::string& path, const Surface& surface) {
  for (std::size_t v = 0; v < surface.position.size(); ++v)
    for (const double coordinate : surface.position[v])
      if (!std::isfinite(coordinate))
        throw InputError(
            fmt::format("{}: vertex {} has a coordinate that is not finite; write the mesh again", path, v));
}

const char* what(AttributeKind kind) {
  if (kind == AttributeKind::kScalar) return "scalar";
  return kind == AttributeKind::kColour ? "colour" : "normal";
}

void require_finite_values(const std::string& path, const SurfaceAttribute& attribute) {
  for (std::size_t k = 0; k < attribute.values.size(); ++k)
    if (!std::isfinite(attribute.values[k]))
      throw InputError(fmt::format("{}: vertex {} has a {} {} that is not finite in float32; write it without",
                                   path, k / static_cast<std::size_t>(attribute.components()), what(attribute.kind),
                                   attribute.name));
}

// Programs that compute colours in float32 go over the ends by a few steps; what is farther off is another unit.
constexpr float kColourSlack = 1e-5F;

void bring_colours_into_range(const std::string& path, SurfaceAttribute& colour) {
  for (std::size_t k = 0; k < colour.values.size(); ++k) {
    float& value = colour.values[k];
    if (!(value >= -kColourSlack && value <= 1 + kColourSlack))
      throw InputError(fmt::format("{}: vertex {} has a colour of {}; colours that are not bytes go from 0 to 1",
                                   path, k / 3, value));
    value = std::clamp(value, 0.0F, 1.0F);
  }
}

// A normal of float32 has this squared length but for rounding (three steps of 2^-24 each, and the sum's); it stays
// as it is.
constexpr double kSquaredLengthSlack = 1e-6;

/// 0 0 0 stays: it says that there is none.
void bring_normals_to_unit_length(SurfaceAttribute& normal) {
  for (std::size_t k = 0; k < normal.values.size(); k += 3) {
    double squared = 0;
    for (std::size_t i = k; i < k + 3; ++i) squared += double{normal.values[i]} * normal.values[i];
    if (squared == 0 || std::abs(squared - 1) <= kSquaredLengthSlack) continue;
    for (std::size_t i = k; i < k + 3; ++i)
      normal.values[i] = static_cast<float>(normal.values[i] / std::sqrt(squared));
  }
}

}  // namespace

Surface read_surface(const std::string& path) {
  const Format* format = format_of(path);
  if (format == nullptr) throw InputError(unknown_extension(path));
  Surface surface = format->read(path);
  if (surface.triangles.empty())
    throw InputError(path + ": has no triangles; a surface needs one at least (points alone are none)");
  require_finite_places(path, surface);
  for (SurfaceAttribute& attribute : surface.attributes) {
    require_finite_values(path, attribute);
    if (attribute.kind == AttributeKind::kColour) bring_colours_into_range(path, attribute);
    if (attribute.kind == AttributeKind::kNormal) bring_normals_to_unit_length(attribute);
  }
  return surface;
}

void write_surface(const std::string& path, const Surface& surface) {
  const Format* format = format_of(path);
  if (format == nullptr) throw UsageError(unknown_extension(path));
  format->write(path, surface);
}

}  // namespace tinsmith
