#include "io/two_dm.hpp"

#include "io/mesh_text.hpp"

namespace tinsmith {
namespace {

constexpr std::string_view kVertex = "ND ";
constexpr std::string_view kTriangle = "E3T ";

/// The records are numbered; anything but 1, 2, 3... would need a map that no file of ours needs.
void require_number(const InputFile& file, std::uint64_t number, std::size_t n_before) {
  if (number != n_before + 1) file.fail("the numbers of vertices or triangles are not 1, 2, 3...");
}

void read_vertex(const InputFile& file, std::string_view line, Tin& tin) {
  LineNumbers numbers(file, line.substr(kVertex.size()));
  require_number(file, numbers.count(), tin.vertices.size());
  tin.vertices.push_back({numbers.coordinate(), numbers.coordinate(), numbers.coordinate()});
  numbers.end();
}

void read_triangle(const InputFile& file, std::string_view line, Tin& tin) {
  LineNumbers numbers(file, line.substr(kTriangle.size()));
  require_number(file, numbers.count(), tin.triangles.size());
  tin.triangles.push_back({numbers.index(), numbers.index(), numbers.index()});
  numbers.count();  // the material
  numbers.end();
}

}  // namespace

void write_two_dm(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame) {
  FileWithPrj file(path, frame.crs_wkt);
  file.mesh().write("MESH2D\n");
  file.mesh().write(counts_comment(mesh));
  std::string line;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    line = std::string_view("E3T");
    append_number(line, std::uint64_t{t + 1});
    for (const std::uint64_t corner : turned(mesh.triangles[t], frame.is_mirrored()))
      append_number(line, corner + 1);
    file.mesh().write(line += " 1\n");
  }
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    line = std::string_view("ND");
    append_number(line, std::uint64_t{v + 1});
    for (const double coordinate : vertex_in_crs(mesh, v, frame)) append_number(line, coordinate);
    file.mesh().write(line += '\n');
  }
  file.commit();
}

Tin read_two_dm(const std::string& path) {
  InputFile file(path);
  std::string_view line;
  if (!file.read_line(line) || line != "MESH2D") file.fail("does not begin with MESH2D");
  Tin tin;
  tin.crs_wkt = read_prj(path);
  TextCounts counts;
  while (file.read_line(line)) {
    if (line.starts_with(kVertex))
      read_vertex(file, line, tin);
    else if (line.starts_with(kTriangle))
      read_triangle(file, line, tin);
    else if (!counts.read_comment(file, line) && !line.empty())
      file.fail("a line is neither a vertex nor a triangle");
  }
  counts.require_whole(file, tin);
  return tin;
}

}  // namespace tinsmith
