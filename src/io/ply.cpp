#include "io/ply.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <limits>

#include "io/input_file.hpp"
#include "io/mesh_text.hpp"
#include "io/output_file.hpp"

namespace tinsmith {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's byte order");

constexpr std::size_t kVertexBytes = 3 * sizeof(double);
constexpr std::size_t kTriangleBytes = 1 + 3 * sizeof(std::uint32_t);

std::string header(const TerrainMesh& mesh, const GridFrame& frame) {
  // Readers that only know int take these indices too, as long as they fit.
  const bool fits_int = mesh.position.size() <= std::uint64_t{1} << 31;
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\n{}"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      frame.crs_wkt.empty() ? "" : fmt::format("comment crs {}\n", one_line(frame.crs_wkt)), mesh.position.size(),
      mesh.triangles.size(), fits_int ? "int" : "uint");
}

struct Header {
  std::uint64_t n_vertices = 0;
  std::uint64_t n_triangles = 0;
  std::string crs_wkt;
};

std::string_view next_line(InputFile& file) {
  std::string_view line;
  if (!file.read_line(line)) file.fail("the PLY header ends too early");
  return line;
}

/// The next line that is not a comment, without the start that it must have.
std::string next_entry(InputFile& file, std::string_view start, Header& header) {
  constexpr std::string_view kCrs = "comment crs ";
  std::string_view line = next_line(file);
  for (; line.starts_with("comment"); line = next_line(file))
    if (line.starts_with(kCrs)) header.crs_wkt = line.substr(kCrs.size());
  if (!line.starts_with(start)) file.fail(fmt::format("the PLY header lacks '{}' as tinsmith writes it", start));
  return std::string(line.substr(start.size()));
}

std::uint64_t count(const InputFile& file, const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    file.fail("the PLY header has a count that is none");
  return value;
}

Header read_header(InputFile& file) {
  Header header;
  next_entry(file, "ply", header);
  next_entry(file, "format binary_little_endian 1.0", header);
  header.n_vertices = count(file, next_entry(file, "element vertex ", header));
  for (const char* axis : {"x", "y", "z"}) next_entry(file, fmt::format("property double {}", axis), header);
  header.n_triangles = count(file, next_entry(file, "element face ", header));
  const std::string list = next_entry(file, "property list uchar ", header);
  if (list != "int vertex_indices" && list != "uint vertex_indices") file.fail("the PLY faces are no index lists");
  next_entry(file, "end_header", header);
  return header;
}

void require_size(const InputFile& file, const Header& header) {
  const bool fits = header.n_vertices <= file.left() / kVertexBytes &&
                    header.n_triangles <= file.left() / kTriangleBytes &&
                    header.n_vertices * kVertexBytes + header.n_triangles * kTriangleBytes == file.left();
  if (!fits)
    file.fail(fmt::format("{} bytes are not {} vertices and {} triangles", file.left(), header.n_vertices,
                          header.n_triangles));
}

}  // namespace

void write_ply(const std::string& path, const TerrainMesh& mesh, const GridFrame& frame) {
  OutputFile file(path);
  file.write(header(mesh, frame));
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    const auto vertex = vertex_in_crs(mesh, v, frame);
    file.write(vertex.data(), kVertexBytes);
  }
  for (const auto& triangle : mesh.triangles) {
    const auto corners = turned(triangle, frame.is_mirrored());
    const std::uint8_t n_corners = 3;
    file.write(&n_corners, 1);
    file.write(corners.data(), sizeof corners);
  }
  file.commit();
}

Tin read_ply(const std::string& path) {
  InputFile file(path);
  Header header = read_header(file);
  require_size(file, header);
  Tin tin;
  tin.crs_wkt = std::move(header.crs_wkt);
  tin.vertices.resize(header.n_vertices);
  file.read(tin.vertices.data(), tin.vertices.size() * kVertexBytes);
  tin.triangles.resize(header.n_triangles);
  for (auto& triangle : tin.triangles) {
    if (file.read<std::uint8_t>() != 3) file.fail("a face is not a triangle");
    file.read(triangle.data(), sizeof triangle);
  }
  return tin;
}

}  // namespace tinsmith
