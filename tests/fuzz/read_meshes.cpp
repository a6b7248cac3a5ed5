// Any bytes, read as a mesh of every format: each reader returns what keeps its promises or throws an Error; no
// crash, no undefined behaviour, no allocation that the bytes don't pay for. Run by tests/fuzz/run.sh.

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/mesh_file.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/progressive.hpp"
#include "tinsmith/simplify.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {
namespace {

// Larger ones take their time, and no other path.
constexpr std::size_t kSimplified = 500;

void expect(bool holds) {
  if (!holds) std::abort();
}

/// One file under a name for each format, in memory; gone with the object.
class NamedBytes {
 public:
  NamedBytes() {
    std::string name = "/dev/shm/tinsmith-fuzz-XXXXXX";
    folder_ = mkdtemp(name.data());
    for (const char* extension : {".ply", ".obj", ".stl", ".glb", ".2dm", ".tspm"})
      std::filesystem::create_symlink("bytes", path(extension));
  }
  NamedBytes(const NamedBytes&) = delete;
  NamedBytes& operator=(const NamedBytes&) = delete;
  ~NamedBytes() { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& extension) const { return folder_ / ("mesh" + extension); }
  void put(const std::uint8_t* bytes, std::size_t size) const {
    std::ofstream(folder_ / "bytes", std::ios::binary | std::ios::trunc)
        .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  }

 private:
  std::filesystem::path folder_;
};

template <class Try>
void allow_errors(Try run) {
  try {
    run();
  } catch (const Error& error) {
    const std::string text = error.what();
    expect(!text.empty() && text.find('\n') == std::string::npos);
  }
}

void expect_sound(const Surface& surface) {
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t corner : triangle) expect(corner < surface.position.size());
  for (const auto& place : surface.position)
    for (const double coordinate : place) expect(std::isfinite(coordinate));
  for (const SurfaceAttribute& attribute : surface.attributes) {
    expect(attribute.values.size() == surface.position.size() * static_cast<std::size_t>(attribute.components()));
    for (const float value : attribute.values) {
      expect(std::isfinite(value));
      expect(attribute.kind != AttributeKind::kColour || (value >= 0 && value <= 1));
    }
  }
}

void simplify_to_half(const Surface& surface) {
  expect_sound(surface);
  if (surface.triangles.size() > kSimplified || surface.position.size() > kSimplified) return;
  SimplifySurfaceOptions options;
  options.ratio = 0.5;
  options.crease = 40;
  SimplifySurfaceReport report;
  allow_errors([&] { expect_sound(simplify_surface(surface, options, report)); });
}

void read_terrain(const std::string& path) {
  std::uint64_t n_vertices = 0;
  MeshVisitor visitor;
  visitor.vertices = [&](std::span<const std::array<double, 3>> vertices) { n_vertices += vertices.size(); };
  visitor.colours = [](std::span<const Levels> colours, int) {
    for (const Levels& colour : colours)
      for (const float level : colour) expect(level >= 0 && level <= 255);
  };
  visitor.triangles = [&](std::span<const std::array<std::uint64_t, 3>> triangles) {
    for (const auto& triangle : triangles)
      for (const std::uint64_t corner : triangle) expect(corner < n_vertices);
  };
  visit_mesh(path, visitor);
  read_mesh(path);
}

void read_all(const NamedBytes& file) {
  for (const char* extension : {".ply", ".obj", ".stl", ".glb"})
    allow_errors([&] { simplify_to_half(read_surface(file.path(extension))); });
  for (const char* extension : {".ply", ".obj", ".glb", ".2dm"})
    allow_errors([&] { read_terrain(file.path(extension)); });
  allow_errors([&] { simplify_to_half(restore(read_progressive(file.path(".tspm")))); });
}

}  // namespace
}  // namespace tinsmith

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const tinsmith::NamedBytes file;
  file.put(bytes, size);
  tinsmith::read_all(file);
  return 0;
}
