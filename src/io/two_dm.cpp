#include "io/two_dm.hpp"

#include "io/mesh_file.hpp"
#include "io/mesh_text.hpp"

namespace tinsmith {
namespace {

/// The records are numbered; anything but 1, 2, 3... would need a map that no file of ours needs.
void require_number(LineNumbers& numbers, std::uint64_t n_before) {
  if (numbers.count() != n_before + 1) numbers.fail("the numbers of vertices or triangles are not 1, 2, 3...");
}

TextVertex vertex_of(LineNumbers& numbers, std::uint64_t n_before) {
  require_number(numbers, n_before);
  return {{numbers.coordinates(), {}}, false};
}

std::array<std::uint64_t, 3> triangle_of(LineNumbers& numbers, std::uint64_t n_before) {
  require_number(numbers, n_before);
  const auto corners = numbers.corners();
  numbers.count();  // the material
  return corners;
}

bool is_ignored(std::string_view line) { return line.empty(); }

}  // namespace

void write_two_dm(const std::string& path, const TerrainSurface& surface, const GridFrame& frame) {
  FileWithPrj file(path, frame.crs_wkt);
  file.mesh().write("MESH2D\n");
  file.mesh().write(counts_comment(surface.extent().n_vertices, surface.extent().n_triangles));
  file.mesh().write(height_unit_comment(frame.metres_per_vertical_unit));
  std::string lines;
  std::uint64_t number = 0;
  surface.for_each_triangle_block([&](TerrainSurface::TriangleBlock triangles) {
    lines.clear();
    for (const auto& triangle : triangles) {
      lines += "E3T";
      append_number(lines, ++number);
      for (const std::uint64_t corner : turned(triangle, frame.is_mirrored())) append_number(lines, corner + 1);
      lines += " 1\n";
    }
    file.mesh().write(lines);
  });
  number = 0;
  surface.for_each_vertex_block([&](TerrainSurface::VertexBlock vertices) {
    lines.clear();
    for (const TerrainVertex& vertex : vertices) {
      lines += "ND";
      append_number(lines, ++number);
      for (const double coordinate : vertex_in_crs(vertex, frame)) append_number(lines, coordinate);
      lines += '\n';
    }
    file.mesh().write(lines);
  });
  file.commit();
}

std::string visit_two_dm(const std::string& path, const MeshVisitor& visitor) {
  InputFile file(path);
  std::string_view line;
  if (!file.read_line(line) || line != "MESH2D") file.fail("does not begin with MESH2D");
  std::string crs_wkt = read_prj(path);
  visit_text(file, {"ND ", "E3T ", vertex_of, triangle_of, is_ignored}, visitor);
  return crs_wkt;
}

}  // namespace tinsmith
