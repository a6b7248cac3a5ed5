#include "io/glb.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>

#include "io/glb_chunks.hpp"
#include "io/input_file.hpp"
#include "io/linear_colour.hpp"
#include "io/mesh_file.hpp"
#include "io/mesh_text.hpp"
#include "io/output_file.hpp"
#include "io/vertex_colour.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// Local frame of the node: X = column - origin column, Z = +-(row - origin row), in cells, Y = metres above the
// origin's height. A vertex's colour stands behind its position, padded to eight bytes. The sign makes it a
// right-handed frame with Y up, so that the node never mirrors. World: X = east, Y = up, Z = -north, each the CRS
// coordinate times metres_per_unit.

using Json = nlohmann::ordered_json;
using Position = std::array<float, 3>;
using Triangle = std::array<std::uint64_t, 3>;

static_assert(std::endian::native == std::endian::little, "glTF is written in the machine's byte order");

constexpr std::uint64_t kMaxJsonBytes = 1 << 24;  // ours have some kilobytes: a CRS and a page of numbers
constexpr std::uint64_t kJsonRoom = 1 << 16;      // left for it when a mesh is refused by its counts
constexpr std::uint64_t kMaxCount = std::uint64_t{1} << 48;  // far beyond 4 GiB, and no size of it overflows
constexpr int kFloat = 5126, kUint16 = 5123, kUint32 = 5125;
using Shares = std::array<std::uint16_t, 4>;          // of colour; without alpha two bytes of padding end them
constexpr std::size_t kColourBytes = sizeof(Shares);  // glTF wants every vertex to begin at a multiple of four
constexpr int kSharesPerAlpha = 65535 / 255;
constexpr int kVertexBuffer = 34962, kIndexBuffer = 34963;

// float32 holds sixteenths of a cell exactly up to 2^24 of them; a cell less for the rounding of the origin.
constexpr std::int64_t kMaxHalfExtent = (std::int64_t{1} << 24) - kLatticePerCell;

/// Where the local frame has its origin, and what its metres are.
struct LocalFrame {
  std::int64_t column = 0;
  std::int64_t row = 0;
  double height = 0;                               // vertical units, whole
  std::array<double, 3> metres_per_unit{1, 1, 1};  // of the CRS's x, y and height
  double row_sign = 1;                             // of Z
};

/// Translation, rotation (a quaternion about Y) and scale of the node.
struct Transform {
  std::array<double, 3> translation{};
  std::array<double, 4> rotation{0, 0, 0, 1};
  std::array<double, 3> scale{1, 1, 1};
};

std::array<double, 3> to_world(const Transform& node, const Position& local) {
  const double sine = 2 * node.rotation[1] * node.rotation[3];
  const double cosine = node.rotation[3] * node.rotation[3] - node.rotation[1] * node.rotation[1];
  const double x = node.scale[0] * local[0];
  const double z = node.scale[2] * local[2];
  return {node.translation[0] + cosine * x + sine * z, node.translation[1] + node.scale[1] * local[1],
          node.translation[2] - sine * x + cosine * z};
}

std::array<double, 3> to_crs(const GridFrame& frame, const LocalFrame& local, const Position& p) {
  const auto [x, y] = frame.to_crs(static_cast<double>(local.column) + p[0],
                                   static_cast<double>(local.row) + local.row_sign * p[2]);
  return {x, y, local.height + p[1] / local.metres_per_unit[2]};
}

// ---- writing

/// The middle of the heights, as a whole number: whole heights stay whole, and small ones keep their digits.
double origin_height(double lowest, double highest) { return std::round(lowest / 2 + highest / 2); }

void require_float_holds(const std::string& path, std::int64_t extent, double metres) {
  if (extent / 2 > kMaxHalfExtent)
    throw ResourceError(
        fmt::format("{}: {} cells in a row are more than float32 places exactly; write .ply instead", path,
                    extent / kLatticePerCell));
  if (!(metres <= std::numeric_limits<float>::max()))
    throw ResourceError(fmt::format("{}: heights of {} m are beyond float32; write .ply instead", path, metres));
}

LocalFrame local_frame(const std::string& path, const TerrainExtent& extent, const GridFrame& frame) {
  const auto [west, north] = extent.low;
  const auto [east, south] = extent.high;
  const std::int64_t width = std::int64_t{east} - west;
  const std::int64_t length = std::int64_t{south} - north;
  LocalFrame local;
  local.column = (west + width / 2) / kLatticePerCell;
  local.row = (north + length / 2) / kLatticePerCell;
  local.height = origin_height(extent.lowest, extent.highest);
  const auto [x, y] = frame.metres_per_unit(static_cast<double>(local.column), static_cast<double>(local.row));
  local.metres_per_unit = {x, y, frame.metres_per_vertical_unit};
  local.row_sign = frame.is_mirrored() ? 1 : -1;
  require_float_holds(
      path, std::max(width, length),
      std::max(extent.highest - local.height, local.height - extent.lowest) * local.metres_per_unit[2]);
  return local;
}

/// The rotation about Y of this cosine and sine, by half-angle formulas that round alike on every machine.
std::array<double, 4> about_y(double cosine, double sine) {
  if (cosine >= 0) {
    const double w = std::sqrt((1 + cosine) / 2);
    return {0, sine / (2 * w), 0, w};
  }
  const double y = std::copysign(std::sqrt((1 - cosine) / 2), sine);
  return {0, y, 0, sine / (2 * y)};
}

Transform node_transform(const std::string& path, const GridFrame& frame, const LocalFrame& local) {
  const auto& g = frame.geotransform;
  const auto [mx, my, mz] = local.metres_per_unit;
  // World (X, Z) of a step along local X and along local Z; adding 0 makes -0 a plain 0 in the file.
  const std::array<double, 2> along_x{mx * g[1], -my * g[4] + 0.0};
  const std::array<double, 2> along_z{local.row_sign * mx * g[2] + 0.0, -local.row_sign * my * g[5]};
  const double scale_x = std::sqrt(along_x[0] * along_x[0] + along_x[1] * along_x[1]);
  const double scale_z = std::sqrt(along_z[0] * along_z[0] + along_z[1] * along_z[1]);
  // Off by 1e-9 of a right angle, the far end of a million cells is off by a thousandth of a cell.
  if (std::abs(along_x[0] * along_z[0] + along_x[1] * along_z[1]) > 1e-9 * scale_x * scale_z)
    throw ResourceError(path +
                        ": the rows and columns of the grid are not at right angles in metres, which a glTF node "
                        "can't say; write .ply instead");
  const auto [x, y] = frame.to_crs(static_cast<double>(local.column), static_cast<double>(local.row));
  return {{x * mx, local.height * mz, -y * my},
          about_y(along_x[0] / scale_x, -along_x[1] / scale_x + 0.0),
          {scale_x, 1, scale_z}};
}

Position local_position(const TerrainVertex& vertex, const LocalFrame& local) {
  const LatticePoint p = vertex.position;
  const auto x = static_cast<float>(p.x - local.column * kLatticePerCell) / kLatticePerCell;
  const auto z = static_cast<float>(p.y - local.row * kLatticePerCell) / kLatticePerCell;
  const double y = (vertex.height - local.height) * local.metres_per_unit[2];
  return {x, static_cast<float>(y), static_cast<float>(local.row_sign) * z + 0.0F};
}

/// Least and largest coordinates are those of the extent's corners, since no step on the way to float32 turns
/// their order over.
Json positions_accessor(const TerrainExtent& extent, const LocalFrame& local) {
  const Position one = local_position({extent.low, extent.lowest}, local);
  const Position other = local_position({extent.high, extent.highest}, local);
  std::array<double, 3> low{};
  std::array<double, 3> high{};
  for (std::size_t k = 0; k < 3; ++k) {
    low[k] = std::min(one[k], other[k]);
    high[k] = std::max(one[k], other[k]);
  }
  return {
      {"bufferView", 0}, {"componentType", kFloat}, {"count", extent.n_vertices}, {"type", "VEC3"}, {"min", low},
      {"max", high}};
}

/// What visit_glb needs to find the CRS coordinates to the last bit, and what others need to use them.
Json extras(const GridFrame& frame, const LocalFrame& local) {
  const auto [x, y] = frame.to_crs(static_cast<double>(local.column), static_cast<double>(local.row));
  return {{"crs_wkt", frame.crs_wkt},
          {"origin", std::array{x, y, local.height}},
          {"metres_per_unit", local.metres_per_unit},
          {"geotransform", frame.geotransform},
          {"origin_column", local.column},
          {"origin_row", local.row}};
}

constexpr std::size_t vertex_bytes(int n_channels) {
  return sizeof(Position) + (n_channels > 0 ? kColourBytes : 0);
}

/// Sizes of the two halves of the binary chunk. Index 65535 is not a vertex in glTF.
struct Layout {
  Layout(std::uint64_t n_vertices, std::uint64_t n_triangles, int n_channels)
      : index_bytes(n_vertices < 65536 ? 2 : 4),
        vertices(n_vertices * vertex_bytes(n_channels)),
        indices(n_triangles * 3 * index_bytes) {}
  std::uint64_t binary() const { return padded(vertices + indices); }
  std::uint64_t index_bytes;
  std::uint64_t vertices;
  std::uint64_t indices;
};

/// share_of_level, which is slow, from a table.
std::uint16_t share_of_byte(std::uint8_t level) {
  static const auto shares = [] {
    std::array<std::uint16_t, 256> all{};
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = share_of_level(static_cast<double>(i));
    return all;
  }();
  return shares[level];
}

Shares shares_of(const Levels& colour, int n_channels) {
  const auto [red, green, blue, alpha] = stored_colour(colour, n_channels);
  return {share_of_byte(red), share_of_byte(green), share_of_byte(blue),
          static_cast<std::uint16_t>(alpha * kSharesPerAlpha)};
}

/// Colours share the vertices' buffer view with the positions: vertices are gone through once.
void add_colours(Json& json, const TerrainExtent& extent) {
  json["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json["accessors"].size();
  json["accessors"].push_back({{"bufferView", 0},
                               {"byteOffset", sizeof(Position)},
                               {"componentType", kUint16},
                               {"normalized", true},
                               {"count", extent.n_vertices},
                               {"type", n_stored_channels(extent.n_channels) == 4 ? "VEC4" : "VEC3"}});
  json["bufferViews"][0]["byteStride"] = vertex_bytes(extent.n_channels);
}

std::string json_text(const Layout& layout, const TerrainExtent& extent, const GridFrame& frame,
                      const LocalFrame& local, const Transform& node) {
  Json json;
  json["asset"] = {{"version", "2.0"}, {"generator", "tinsmith"}};
  json["scene"] = 0;
  json["scenes"] = {{{"nodes", {0}}}};
  json["nodes"] = {{{"mesh", 0},
                    {"translation", node.translation},
                    {"rotation", node.rotation},
                    {"scale", node.scale},
                    {"extras", extras(frame, local)}}};
  json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"material", 0}}}}}};
  json["materials"] = {{{"pbrMetallicRoughness", {{"metallicFactor", 0}}}}};
  json["accessors"] = {positions_accessor(extent, local),
                       {{"bufferView", 1},
                        {"componentType", layout.index_bytes == 2 ? kUint16 : kUint32},
                        {"count", extent.n_triangles * 3},
                        {"type", "SCALAR"}}};
  json["bufferViews"] = {
      {{"buffer", 0}, {"byteLength", layout.vertices}, {"target", kVertexBuffer}},
      {{"buffer", 0}, {"byteOffset", layout.vertices}, {"byteLength", layout.indices}, {"target", kIndexBuffer}}};
  json["buffers"] = {{{"byteLength", layout.vertices + layout.indices}}};
  if (extent.n_channels > 0) add_colours(json, extent);
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  text.resize(padded(text.size()), ' ');
  return text;
}

template <class T>
void put_triangle(const Triangle& triangle, char* bytes) {
  const std::array narrow{static_cast<T>(triangle[0]), static_cast<T>(triangle[1]), static_cast<T>(triangle[2])};
  std::memcpy(bytes, narrow.data(), sizeof narrow);
}

// ---- reading

std::uint64_t count(const Json& json) {
  if (!json.is_number_unsigned()) throw std::invalid_argument("a count is none");
  return json.get<std::uint64_t>();
}

std::int64_t whole(const Json& json) {
  if (!json.is_number_integer()) throw std::invalid_argument("a whole number is none");
  return json.get<std::int64_t>();
}

/// What the JSON chunk says.
struct Document {
  std::uint64_t n_vertices = 0;
  std::uint64_t n_indices = 0;
  std::uint64_t index_bytes = 0;
  int n_stored = 0;  // channels of colour
  Transform node;
  GridFrame frame;
  LocalFrame local;
};

void interpret_node(const Json& node, Document& document) {
  const Json& extras = node.at("extras");
  document.node.translation = node.at("translation").get<std::array<double, 3>>();
  document.node.rotation = node.at("rotation").get<std::array<double, 4>>();
  document.node.scale = node.at("scale").get<std::array<double, 3>>();
  document.frame.crs_wkt = extras.at("crs_wkt").get<std::string>();
  document.frame.geotransform = extras.at("geotransform").get<std::array<double, 6>>();
  document.local.column = whole(extras.at("origin_column"));
  document.local.row = whole(extras.at("origin_row"));
  document.local.height = extras.at("origin").at(2).get<double>();
  document.local.metres_per_unit = extras.at("metres_per_unit").get<std::array<double, 3>>();
  document.local.row_sign = document.frame.is_mirrored() ? 1 : -1;
}

int stored_channels(const Json& json, std::uint64_t n_vertices) {
  if (!json.at("meshes").at(0).at("primitives").at(0).at("attributes").contains("COLOR_0")) return 0;
  const Json& colours = json.at("accessors").at(2);
  const bool is_ours = colours.at("componentType") == kUint16 && colours.at("byteOffset") == sizeof(Position) &&
                       (colours.at("type") == "VEC3" || colours.at("type") == "VEC4") &&
                       count(colours.at("count")) == n_vertices &&
                       json.at("bufferViews").at(0).at("byteStride") == sizeof(Position) + kColourBytes;
  if (!is_ours) throw std::invalid_argument("the colours are not as tinsmith writes them");
  return colours.at("type") == "VEC4" ? 4 : 3;
}

Levels levels_at(const char* bytes, int n_stored) {
  Shares shares;
  std::memcpy(shares.data(), bytes, sizeof shares);
  const auto [red, green, blue, alpha] = shares;
  return {level_of_share(red), level_of_share(green), level_of_share(blue),
          n_stored == 4 ? static_cast<float>(alpha) / kSharesPerAlpha : 0.0F};
}

Document interpret(const Json& json) {
  Document document;
  const Json& positions = json.at("accessors").at(0);
  const Json& indices = json.at("accessors").at(1);
  if (positions.at("componentType") != kFloat || positions.at("type") != "VEC3" || indices.at("type") != "SCALAR" ||
      (indices.at("componentType") != kUint16 && indices.at("componentType") != kUint32))
    throw std::invalid_argument("the accessors are not as tinsmith writes them");
  document.n_vertices = count(positions.at("count"));
  document.n_indices = count(indices.at("count"));
  document.index_bytes = indices.at("componentType") == kUint16 ? 2 : 4;
  document.n_stored = stored_channels(json, document.n_vertices);
  interpret_node(json.at("nodes").at(0), document);
  return document;
}

Document read_document(InputFile& file) {
  read_glb_header(file);
  const std::uint64_t size = read_chunk_header(file, kJsonChunk, "JSON");
  if (size > kMaxJsonBytes) file.fail("has more JSON than a mesh of ours can have");
  std::string text(size, ' ');
  file.read(text.data(), text.size());
  try {
    return interpret(Json::parse(text));
  } catch (const Json::exception&) {
    file.fail("is no glTF of tinsmith's: its JSON is damaged or lacks what tinsmith writes");
  } catch (const std::invalid_argument& error) {
    file.fail(fmt::format("is no glTF of tinsmith's: {}", error.what()));
  }
}

/// The mesh must stand where its node puts it: whoever shows the file follows the node, not the extras.
void require_agreement(const InputFile& file, const Document& document, const Position& local,
                       const std::array<double, 3>& crs) {
  const auto world = to_world(document.node, local);
  const auto& metres = document.local.metres_per_unit;
  const std::array<double, 3> expected{crs[0] * metres[0], crs[2] * metres[2], -crs[1] * metres[1]};
  const auto& scale = document.node.scale;
  const std::array<double, 3> slack{1e-2 * scale[0], 1e-6, 1e-2 * scale[2]};
  for (std::size_t k = 0; k < 3; ++k)
    if (!(std::abs(world[k] - expected[k]) <= slack[k] + 1e-12 * std::abs(expected[k])))
      file.fail("the node's transform and its extras put the mesh in different places");
}

template <class T>
Triangle triangle_at(const char* bytes) {
  std::array<T, 3> narrow;
  std::memcpy(narrow.data(), bytes, sizeof narrow);
  return {narrow[0], narrow[1], narrow[2]};
}

std::array<double, 3> vertex_at(const InputFile& file, const Document& document, const char* bytes) {
  Position local;
  std::memcpy(local.data(), bytes, sizeof local);
  const auto vertex = to_crs(document.frame, document.local, local);
  require_agreement(file, document, local, vertex);
  return vertex;
}

/// The file stands at the positions.
void require_size(InputFile& file, const Document& document) {
  const std::uint64_t size = read_chunk_header(file, kBinChunk, "binary");
  const std::size_t of_vertex = vertex_bytes(document.n_stored);
  if (size != file.left() || document.n_vertices > size / of_vertex ||
      document.n_indices > size / document.index_bytes || document.n_indices % 3 != 0 ||
      padded(document.n_vertices * of_vertex + document.n_indices * document.index_bytes) != size)
    file.fail("the binary chunk is not as long as the accessors say");
}

}  // namespace

double glb_height_rounding(double lowest, double highest) {
  const double origin = origin_height(lowest, highest);
  const double farthest = std::max(highest - origin, origin - lowest);
  // Half a step of float32 (2^-24 of the number at most), and two of double for the way there and back.
  return farthest * 0x1p-24 +
         2 * std::numeric_limits<double>::epsilon() * std::max(std::abs(lowest), std::abs(highest));
}

void require_glb_holds(const std::string& path, std::uint64_t n_vertices, std::uint64_t n_triangles) {
  const Layout layout(std::min(n_vertices, kMaxCount), std::min(n_triangles, kMaxCount), 0);
  glb_size(path, kJsonRoom, layout.binary());
}

void write_glb(const std::string& path, const TerrainSurface& surface, const GridFrame& frame) {
  const TerrainExtent& extent = surface.extent();
  if (extent.n_triangles == 0)
    throw ResourceError(path + ": glTF can't hold a mesh without triangles; write .ply instead");
  require_glb_holds(path, extent.n_vertices, extent.n_triangles);
  const LocalFrame local = local_frame(path, extent, frame);
  const Layout layout(extent.n_vertices, extent.n_triangles, extent.n_channels);
  const std::string json = json_text(layout, extent, frame, local, node_transform(path, frame, local));
  const std::uint32_t total = glb_size(path, json.size(), layout.binary());

  OutputFile file(path);
  write_glb_header(file, total);
  write_chunk_header(file, json.size(), kJsonChunk);
  file.write(json);
  write_chunk_header(file, layout.binary(), kBinChunk);
  const std::size_t of_vertex = vertex_bytes(extent.n_channels);
  surface.for_each_vertex_block([&](TerrainSurface::VertexBlock vertices) {
    write_records(file, vertices, of_vertex, [&](const TerrainVertex& vertex, char* bytes) {
      std::memcpy(bytes, local_position(vertex, local).data(), sizeof(Position));
      if (extent.n_channels == 0) return;
      std::memcpy(bytes + sizeof(Position), shares_of(vertex.colour, extent.n_channels).data(), kColourBytes);
    });
  });
  const auto put = layout.index_bytes == 2 ? put_triangle<std::uint16_t> : put_triangle<std::uint32_t>;
  surface.for_each_triangle_block([&](TerrainSurface::TriangleBlock triangles) {
    write_records(file, triangles, 3 * layout.index_bytes, [&](const Triangle& triangle, char* bytes) {
      put(turned(triangle, frame.is_mirrored()), bytes);
    });
  });
  file.write(std::string(layout.binary() - layout.vertices - layout.indices, '\0'));
  file.commit();
}

std::string visit_glb(const std::string& path, const MeshVisitor& visitor) {
  InputFile file(path);
  const Document document = read_document(file);
  require_size(file, document);
  if (visitor.counts) visitor.counts(document.n_vertices, document.n_indices / 3);
  if (visitor.height_unit) visitor.height_unit(document.local.metres_per_unit[2]);
  visit_vertex_records(
      file, {document.n_vertices, vertex_bytes(document.n_stored), document.n_stored, sizeof(Position), levels_at},
      [&](const char* bytes) { return vertex_at(file, document, bytes); }, visitor);
  visit_records(file, document.n_indices / 3, 3 * document.index_bytes,
                document.index_bytes == 2 ? triangle_at<std::uint16_t> : triangle_at<std::uint32_t>,
                visitor.triangles);
  return document.frame.crs_wkt;
}

}  // namespace tinsmith
