#include "io/ply.hpp"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "io/input_file.hpp"
#include "io/mesh_file.hpp"
#include "io/mesh_text.hpp"
#include "io/output_file.hpp"
#include "io/vertex_colour.hpp"

namespace tinsmith {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's byte order");

constexpr std::size_t kPositionBytes = 3 * sizeof(double);
constexpr std::string_view kHeightUnit = "comment metres per unit of height ";
constexpr std::array kColours{"red", "green", "blue", "alpha"};

constexpr std::size_t vertex_bytes(int n_stored) { return kPositionBytes + static_cast<std::size_t>(n_stored); }

/// The type of an index.
enum class Index { kInt, kUint, kDouble };

/// The one that most readers know and that holds all indices.
Index index_for(std::uint64_t n_vertices) {
  if (n_vertices <= std::uint64_t{1} << 31) return Index::kInt;
  return n_vertices <= std::uint64_t{1} << 32 ? Index::kUint : Index::kDouble;
}

const char* name(Index index) { return index == Index::kInt ? "int" : index == Index::kUint ? "uint" : "double"; }

/// Bytes of a triangle: how many corners, and these.
constexpr std::size_t triangle_bytes(Index index) { return 1 + std::size_t{3} * (index == Index::kDouble ? 8 : 4); }

std::string header(const TerrainExtent& extent, const GridFrame& frame) {
  std::string colours;
  for (int i = 0; i < n_stored_channels(extent.n_channels); ++i)
    colours += fmt::format("property uchar {}\n", kColours[static_cast<std::size_t>(i)]);
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\n{}{}{}\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n{}"
      "element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
      frame.crs_wkt.empty() ? "" : fmt::format("comment crs {}\n", one_line(frame.crs_wkt)), kHeightUnit,
      frame.metres_per_vertical_unit, extent.n_vertices, colours, extent.n_triangles,
      name(index_for(extent.n_vertices)));
}

template <class T>
void put_triangle(const std::array<std::uint64_t, 3>& corners, char* bytes) {
  *bytes++ = 3;
  const std::array numbers{static_cast<T>(corners[0]), static_cast<T>(corners[1]), static_cast<T>(corners[2])};
  std::memcpy(bytes, numbers.data(), sizeof numbers);
}

struct Header {
  std::uint64_t n_vertices = 0;
  std::uint64_t n_triangles = 0;
  Index index = Index::kInt;
  int n_stored = 0;  // channels of colour
  std::string crs_wkt;
  std::optional<double> metres_per_height;
};

std::string_view next_line(InputFile& file) {
  std::string_view line;
  if (!file.read_line(line)) file.fail("the PLY header ends too early");
  return line;
}

/// The line without the start that it must have.
std::string after(const InputFile& file, std::string_view start, std::string_view line) {
  if (!line.starts_with(start)) file.fail(fmt::format("the PLY header lacks '{}' as tinsmith writes it", start));
  return std::string(line.substr(start.size()));
}

/// The next line that is not a comment.
std::string next_entry(InputFile& file, Header& header) {
  constexpr std::string_view kCrs = "comment crs ";
  std::string_view line = next_line(file);
  for (; line.starts_with("comment"); line = next_line(file)) {
    if (line.starts_with(kCrs)) header.crs_wkt = line.substr(kCrs.size());
    if (line.starts_with(kHeightUnit))
      header.metres_per_height = LineNumbers(file, line.substr(kHeightUnit.size())).only();
  }
  return std::string(line);
}

std::string next_entry(InputFile& file, std::string_view start, Header& header) {
  return after(file, start, next_entry(file, header));
}

/// Reads the colours, if there are any, and gives the line after them.
std::string read_colours(InputFile& file, Header& header) {
  std::string line = next_entry(file, header);
  for (const char* colour : kColours) {
    if (line != fmt::format("property uchar {}", colour)) break;
    ++header.n_stored;
    line = next_entry(file, header);
  }
  if (header.n_stored == 1 || header.n_stored == 2) file.fail("the PLY header lacks a colour beside another");
  return line;
}

Index index_of(const InputFile& file, const std::string& text) {
  for (const Index index : {Index::kInt, Index::kUint, Index::kDouble})
    if (text == fmt::format("{} vertex_indices", name(index))) return index;
  file.fail("the PLY faces are no index lists");
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
  header.n_triangles = count(file, after(file, "element face ", read_colours(file, header)));
  header.index = index_of(file, next_entry(file, "property list uchar ", header));
  next_entry(file, "end_header", header);
  return header;
}

void require_size(const InputFile& file, const Header& header) {
  const std::size_t bytes = triangle_bytes(header.index);
  const std::size_t of_vertex = vertex_bytes(header.n_stored);
  const bool fits = header.n_vertices <= file.left() / of_vertex && header.n_triangles <= file.left() / bytes &&
                    header.n_vertices * of_vertex + header.n_triangles * bytes == file.left();
  if (!fits)
    file.fail(fmt::format("{} bytes are not {} vertices and {} triangles", file.left(), header.n_vertices,
                          header.n_triangles));
}

std::uint64_t index_from(const InputFile&, std::uint32_t index) { return index; }

std::uint64_t index_from(const InputFile& file, double index) {
  if (!(index >= 0 && index < 0x1p53) || std::trunc(index) != index) file.fail("a face has an index that is none");
  return static_cast<std::uint64_t>(index);
}

template <class T>
std::array<std::uint64_t, 3> triangle_at(const InputFile& file, const char* bytes) {
  if (*bytes != 3) file.fail("a face is not a triangle");
  std::array<T, 3> corners;
  std::memcpy(corners.data(), bytes + 1, sizeof corners);
  return {index_from(file, corners[0]), index_from(file, corners[1]), index_from(file, corners[2])};
}

}  // namespace

void write_ply(const std::string& path, const TerrainSurface& surface, const GridFrame& frame) {
  const Index index = index_for(surface.extent().n_vertices);
  const auto put = index == Index::kDouble ? put_triangle<double> : put_triangle<std::uint32_t>;
  const int n_channels = surface.extent().n_channels;
  const int n_stored = n_stored_channels(n_channels);
  OutputFile file(path);
  file.write(header(surface.extent(), frame));
  surface.for_each_vertex_block([&](TerrainSurface::VertexBlock vertices) {
    write_records(file, vertices, vertex_bytes(n_stored), [&](const TerrainVertex& vertex, char* bytes) {
      std::memcpy(bytes, vertex_in_crs(vertex, frame).data(), kPositionBytes);
      std::memcpy(bytes + kPositionBytes, stored_colour(vertex.colour, n_channels).data(),
                  static_cast<std::size_t>(n_stored));
    });
  });
  surface.for_each_triangle_block([&](TerrainSurface::TriangleBlock triangles) {
    write_records(file, triangles, triangle_bytes(index),
                  [&](const auto& triangle, char* bytes) { put(turned(triangle, frame.is_mirrored()), bytes); });
  });
  file.commit();
}

std::string visit_ply(const std::string& path, const MeshVisitor& visitor) {
  InputFile file(path);
  const Header header = read_header(file);
  require_size(file, header);
  if (visitor.counts) visitor.counts(header.n_vertices, header.n_triangles);
  if (visitor.height_unit && header.metres_per_height) visitor.height_unit(*header.metres_per_height);
  const auto position_at = [](const char* bytes) {
    std::array<double, 3> vertex;
    std::memcpy(vertex.data(), bytes, sizeof vertex);
    return vertex;
  };
  visit_vertex_records(file, {header.n_vertices, vertex_bytes(header.n_stored), header.n_stored, kPositionBytes},
                       position_at, visitor);
  const auto triangle = header.index == Index::kDouble ? triangle_at<double> : triangle_at<std::uint32_t>;
  visit_records(
      file, header.n_triangles, triangle_bytes(header.index),
      [&](const char* bytes) { return triangle(file, bytes); }, visitor.triangles);
  return header.crs_wkt;
}

}  // namespace tinsmith
