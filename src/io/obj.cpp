#include "io/obj.hpp"

#include "io/mesh_file.hpp"
#include "io/mesh_text.hpp"

namespace tinsmith {
namespace {

std::array<double, 3> vertex_of(LineNumbers& numbers, std::uint64_t) { return numbers.coordinates(); }

std::array<std::uint64_t, 3> triangle_of(LineNumbers& numbers, std::uint64_t) { return numbers.corners(); }

bool is_ignored(std::string_view line) { return line.empty() || line.starts_with('#'); }

}  // namespace

void write_obj(const std::string& path, const TerrainSurface& surface, const GridFrame& frame) {
  FileWithPrj file(path, frame.crs_wkt);
  file.mesh().write(counts_comment(surface.extent().n_vertices, surface.extent().n_triangles));
  std::string lines;
  surface.for_each_vertex_block([&](TerrainSurface::VertexBlock vertices) {
    lines.clear();
    for (const TerrainVertex& vertex : vertices) {
      lines += 'v';
      for (const double coordinate : vertex_in_crs(vertex, frame)) append_number(lines, coordinate);
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
