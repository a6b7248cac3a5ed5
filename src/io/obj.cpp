#include "io/obj.hpp"

#include "io/mesh_file.hpp"
#include "io/mesh_text.hpp"
#include "io/vertex_colour.hpp"

namespace tinsmith {
namespace {

constexpr double kFullLevel = 255;

// Three more numbers are a colour, in parts of one.
TextVertex vertex_of(LineNumbers& numbers, std::uint64_t) {
  TextVertex vertex{{numbers.coordinates(), {}}, false};
  if (numbers.is_end()) return vertex;
  vertex.has_colour = true;
  const std::array<double, 3> colour = numbers.coordinates();
  for (std::size_t i = 0; i < 3; ++i) vertex.colour[i] = static_cast<float>(colour[i] * kFullLevel);
  return vertex;
}

std::array<std::uint64_t, 3> triangle_of(LineNumbers& numbers, std::uint64_t) { return numbers.corners(); }

void append_colour(std::string& line, const std::array<std::uint8_t, 4>& colour) {
  for (std::size_t i = 0; i < 3; ++i) append_number(line, static_cast<float>(colour[i] / kFullLevel));
}

bool is_ignored(std::string_view line) { return line.empty() || line.starts_with('#'); }

}  // namespace

void write_obj(const std::string& path, const TerrainSurface& surface, const GridFrame& frame) {
  FileWithPrj file(path, frame.crs_wkt);
  file.mesh().write(counts_comment(surface.extent().n_vertices, surface.extent().n_triangles));
  file.mesh().write(height_unit_comment(frame.metres_per_vertical_unit));
  const int n_channels = surface.extent().n_channels;
  std::string lines;
  surface.for_each_vertex_block([&](TerrainSurface::VertexBlock vertices) {
    lines.clear();
    for (const TerrainVertex& vertex : vertices) {
      lines += 'v';
      for (const double coordinate : vertex_in_crs(vertex, frame)) append_number(lines, coordinate);
      if (n_channels > 0) append_colour(lines, stored_colour(vertex.colour, n_channels));
      lines += '\n';
    }
    file.mesh().write(lines);
  });
  surface.for_each_triangle_block([&](TerrainSurface::TriangleBlock triangles) {
    lines.clear();
    for (const auto& triangle : triangles) {
      lines += 'f';
      for (const std::uint64_t corner : turned(triangle, frame.is_mirrored())) append_number(lines, corner + 1);
      lines += '\n';
    }
    file.mesh().write(lines);
  });
  file.commit();
}

std::string visit_obj(const std::string& path, const MeshVisitor& visitor) {
  InputFile file(path);
  std::string crs_wkt = read_prj(path);
  visit_text(file, {"v ", "f ", vertex_of, triangle_of, is_ignored}, visitor);
  return crs_wkt;
}

}  // namespace tinsmith
