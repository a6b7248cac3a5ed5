#include "io/obj.hpp"

#include "io/mesh_text.hpp"

namespace tinsmith {

void write_obj(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame) {
  FileWithPrj file(path, frame.crs_wkt);
  file.mesh().write(counts_comment(mesh));
  std::string line;
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    line = std::string_view("v");
    for (const double coordinate : vertex_in_crs(mesh, v, frame)) append_number(line, coordinate);
    file.mesh().write(line += '\n');
  }
  for (const auto& triangle : mesh.triangles) {
    line = std::string_view("f");
    for (const std::uint64_t corner : turned(triangle, frame.is_mirrored())) append_number(line, corner + 1);
    file.mesh().write(line += '\n');
  }
  file.commit();
}

Tin read_obj(const std::string& path) {
  InputFile file(path);
  Tin tin;
  tin.crs_wkt = read_prj(path);
  TextCounts counts;
  for (std::string_view line; file.read_line(line);) {
    LineNumbers numbers(file, line.substr(std::min<std::size_t>(2, line.size())));
    if (line.starts_with("v ")) {
      tin.vertices.push_back({numbers.coordinate(), numbers.coordinate(), numbers.coordinate()});
      numbers.end();
    } else if (line.starts_with("f ")) {
      tin.triangles.push_back({numbers.index(), numbers.index(), numbers.index()});
      numbers.end();
    } else if (!line.empty() && !line.starts_with('#')) {
      file.fail("a line is neither a vertex nor a triangle");
    } else {
      counts.read_comment(file, line);
    }
  }
  counts.require_whole(file, tin);
  return tin;
}

}  // namespace tinsmith
