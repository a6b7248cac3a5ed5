#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "io/glb_chunks.hpp"
#include "io/input_file.hpp"
#include "io/linear_colour.hpp"
#include "io/mesh_text.hpp"
#include "io/surface_glb.hpp"

namespace tinsmith {
namespace {

using Json = nlohmann::json;
using Vector = std::array<double, 3>;

enum ComponentType { kInt8 = 5120, kUint8 = 5121, kInt16 = 5122, kUint16 = 5123, kUint32 = 5125, kFloat = 5126 };

// A scene of 100 000 nodes has half of it. Parsed, each byte may take twenty, and a hundred in arrays of arrays.
constexpr std::uint64_t kMaxJsonBytes = 1 << 25;
constexpr int kMaxJsonDepth = 64;
// Nodes may show a mesh again and again. More vertices than this (25 MB) and than the file has bytes, which is
// twelve times what it can hold, are no scene but an attack on memory.
constexpr std::uint64_t kMaxUnfolded = 1 << 20;

/// Told apart from what the JSON library throws; read_surface_glb adds the path.
[[noreturn]] void refuse(const std::string& what) { throw std::invalid_argument(what); }

// ---- the document

std::uint64_t whole(const Json& json) {
  if (!json.is_number_unsigned()) refuse("a number that counts is not whole, or negative");
  return json.get<std::uint64_t>();
}

std::uint64_t whole(const Json& object, const char* name, std::uint64_t otherwise) {
  const auto found = object.find(name);
  return found == object.end() ? otherwise : whole(*found);
}

const Json& element(const Json& json, const char* array, std::uint64_t index) {
  const Json& all = json.at(array);
  if (!all.is_array() || index >= all.size()) refuse(fmt::format("{} has no element {}", array, index));
  return all[index];
}

void require_readable(const Json& json) {
  const auto required = json.find("extensionsRequired");
  if (required == json.end()) return;
  for (const Json& name : *required) {
    const auto extension = name.get<std::string>();
    // What a surface looks like is not read anyway.
    const bool is_harmless = extension.starts_with("KHR_materials_") || extension.starts_with("KHR_texture_") ||
                             extension.starts_with("KHR_lights_") || extension == "EXT_texture_webp";
    if (!is_harmless)
      refuse(fmt::format("it needs the extension {}, which is not read; write it without", extension));
  }
}

/// A glTF and its bytes; who made it holds them.
struct Document {
  const Json& json;
  const std::vector<char>& binary;
};

Json parsed(const std::string& text) {
  return Json::parse(text, [](int depth, Json::parse_event_t, Json&) {
    if (depth > kMaxJsonDepth) refuse("its JSON is nested more deeply than any scene");
    return true;
  });
}

Json read_json(InputFile& file) {
  read_glb_header(file);
  const std::uint64_t size = read_chunk_header(file, kJsonChunk, "JSON");
  if (size > kMaxJsonBytes) file.fail("has more JSON than is read: 32 MiB");
  std::string text(size, ' ');
  file.read(text.data(), text.size());
  Json json = parsed(text);
  require_readable(json);
  return json;
}

/// Empty when there is none. What follows it is of extensions.
std::vector<char> read_binary(InputFile& file) {
  if (file.left() == 0) return {};
  std::vector<char> binary(read_chunk_header(file, kBinChunk, "binary"));
  file.read(binary.data(), binary.size());
  return binary;
}

// ---- accessors

std::uint64_t component_bytes(std::uint64_t type) {
  switch (type) {
    case kInt8:
    case kUint8:
      return 1;
    case kInt16:
    case kUint16:
      return 2;
    case kUint32:
    case kFloat:
      return 4;
    default:
      refuse(fmt::format("an accessor has the component type {}, which glTF has not", type));
  }
}

/// Some of the bytes, as elements of one type.
struct Accessor {
  const char* data = nullptr;
  std::uint64_t count = 0;
  std::uint64_t stride = 0;
  std::uint64_t component_type = 0;
  std::string type;  // "SCALAR", "VEC3", ...
  bool is_normalized = false;

  template <class T>
  T component(std::uint64_t i, std::uint64_t k) const {
    T value;
    std::memcpy(&value, data + i * stride + k * sizeof(T), sizeof value);
    return value;
  }
};

/// The bytes of a buffer view.
std::string_view view_of(const Document& document, std::uint64_t index) {
  const Json& view = element(document.json, "bufferViews", index);
  if (view.contains("extensions")) refuse("a bufferView is compressed, which is not read; write it plain");
  const std::uint64_t buffer = whole(view.at("buffer"));
  if (buffer != 0 || element(document.json, "buffers", buffer).contains("uri"))
    refuse("a buffer is outside the .glb, which is not read; pack it in");
  const std::uint64_t offset = whole(view, "byteOffset", 0);
  const std::uint64_t length = whole(view.at("byteLength"));
  if (offset > document.binary.size() || length > document.binary.size() - offset)
    refuse(fmt::format("bufferView {} goes beyond the binary chunk", index));
  return {document.binary.data() + offset, length};
}

std::uint64_t n_components(const std::string& type) {
  if (type == "SCALAR") return 1;
  if (type == "VEC3") return 3;
  if (type == "VEC4") return 4;
  refuse("an accessor is of a type that does not belong there");
}

Accessor accessor_of(const Document& document, const Json& number) {
  const std::uint64_t index = whole(number);
  const Json& json = element(document.json, "accessors", index);
  if (json.contains("sparse"))
    refuse(fmt::format("accessor {} is sparse, which is not read; write it plain", index));
  if (!json.contains("bufferView")) refuse(fmt::format("accessor {} has no bufferView", index));
  Accessor accessor;
  accessor.count = whole(json.at("count"));
  accessor.component_type = whole(json.at("componentType"));
  accessor.type = json.at("type").get<std::string>();
  accessor.is_normalized = json.value("normalized", false);
  const std::uint64_t size = n_components(accessor.type) * component_bytes(accessor.component_type);
  const std::uint64_t view_index = whole(json.at("bufferView"));
  const std::string_view view = view_of(document, view_index);
  accessor.stride = whole(element(document.json, "bufferViews", view_index), "byteStride", size);
  const std::uint64_t offset = whole(json, "byteOffset", 0);
  if (accessor.stride < size || accessor.stride > view.size() + size || accessor.count == 0 ||
      offset > view.size() || size > view.size() - offset ||
      accessor.count - 1 > (view.size() - offset - size) / accessor.stride)
    refuse(fmt::format("accessor {} goes beyond its bufferView", index));
  accessor.data = view.data() + offset;
  return accessor;
}

Accessor float_vectors(const Document& document, const Json& attributes, const char* name) {
  Accessor accessor = accessor_of(document, attributes.at(name));
  if (accessor.component_type != kFloat || accessor.type != "VEC3")
    refuse(fmt::format("{} is not three floats, and nothing else is read", name));
  return accessor;
}

Vector vector_at(const Accessor& accessor, std::uint64_t i) {
  return {accessor.component<float>(i, 0), accessor.component<float>(i, 1), accessor.component<float>(i, 2)};
}

void require_colours(const Accessor& accessor) {
  const bool is_whole = accessor.component_type == kUint8 || accessor.component_type == kUint16;
  if (accessor.type == "SCALAR" || !(accessor.component_type == kFloat || (is_whole && accessor.is_normalized)))
    refuse("COLOR_0 is neither of floats nor of normalized unsigned bytes or shorts");
}

constexpr int kSharesPerByte = 65535 / 255;

double level_at(const Accessor& accessor, std::uint64_t i, std::uint64_t k) {
  switch (accessor.component_type) {
    case kUint8:
      return level_of_share(static_cast<std::uint16_t>(accessor.component<std::uint8_t>(i, k) * kSharesPerByte));
    case kUint16:
      return level_of_share(accessor.component<std::uint16_t>(i, k));
    default: {
      const double light = accessor.component<float>(i, k);
      return std::isfinite(light) ? level_of_light(std::clamp(light, 0.0, 1.0)) : light;  // clamped: so glTF says
    }
  }
}

void require_indices(const Accessor& accessor) {
  const bool is_whole =
      accessor.component_type == kUint8 || accessor.component_type == kUint16 || accessor.component_type == kUint32;
  if (accessor.type != "SCALAR" || !is_whole) refuse("indices are not unsigned bytes, shorts or ints");
}

std::uint64_t index_at(const Accessor& accessor, std::uint64_t i) {
  switch (accessor.component_type) {
    case kUint8:
      return accessor.component<std::uint8_t>(i, 0);
    case kUint16:
      return accessor.component<std::uint16_t>(i, 0);
    default:
      return accessor.component<std::uint32_t>(i, 0);
  }
}

// ---- transforms

/// p -> linear p + translation; the rows of the linear part.
struct Transform {
  std::array<Vector, 3> linear{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Vector translation{};
};

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double determinant(const Transform& transform) {
  return dot(transform.linear[0], cross(transform.linear[1], transform.linear[2]));
}

Vector multiply(const std::array<Vector, 3>& rows, const Vector& v) {
  return {dot(rows[0], v), dot(rows[1], v), dot(rows[2], v)};
}

Vector moved_by(const Transform& transform, const Vector& place) {
  Vector moved = multiply(transform.linear, place);
  for (std::size_t k = 0; k < 3; ++k) moved[k] += transform.translation[k];
  return moved;
}

/// First inner, then outer.
Transform combined(const Transform& outer, const Transform& inner) {
  Transform both;
  both.translation = moved_by(outer, inner.translation);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) {
      both.linear[row][column] = 0;
      for (std::size_t k = 0; k < 3; ++k)
        both.linear[row][column] += outer.linear[row][k] * inner.linear[k][column];
    }
  return both;
}

Transform of_matrix(const std::array<double, 16>& columns) {
  Transform transform;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) transform.linear[row][column] = columns[4 * column + row];
    transform.translation[row] = columns[12 + row];
  }
  return transform;
}

template <std::size_t N>
std::array<double, N> numbers(const Json& object, const char* name, const std::array<double, N>& otherwise) {
  const auto found = object.find(name);
  if (found == object.end()) return otherwise;
  if (!found->is_array() || found->size() != N) refuse(fmt::format("{} has not {} numbers", name, N));
  return found->get<std::array<double, N>>();
}

/// Scaled, turned by the unit quaternion x y z w, moved.
Transform of_node(const Json& node) {
  if (node.contains("matrix")) return of_matrix(numbers<16>(node, "matrix", {}));
  const auto [x, y, z, w] = numbers<4>(node, "rotation", {0, 0, 0, 1});
  const auto scale = numbers<3>(node, "scale", {1, 1, 1});
  Transform transform;
  transform.translation = numbers<3>(node, "translation", {0, 0, 0});
  transform.linear = {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
                       {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
                       {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
  for (Vector& row : transform.linear)
    for (std::size_t k = 0; k < 3; ++k) row[k] *= scale[k];
  return transform;
}

// ---- the surface

/// Puts one mesh after the other into one surface.
class SurfaceBuilder {
 public:
  SurfaceBuilder(const Document& document, std::uint64_t max_vertices)
      : document_(document), max_vertices_(max_vertices) {
    colour_.kind = AttributeKind::kColour;
    normal_.kind = AttributeKind::kNormal;
  }

  void add_mesh(const Json& mesh, const Transform& world) {
    for (const Json& primitive : mesh.at("primitives")) {
      const std::uint64_t mode = whole(primitive, "mode", kTriangles);
      if (mode < kTriangles) continue;  // points and lines
      if (mode > kTriangles) refuse("it has triangle strips or fans, which are not read; write plain triangles");
      if (primitive.contains("extensions") && primitive["extensions"].contains("KHR_draco_mesh_compression"))
        refuse("a mesh is compressed by Draco, which is not read; write it plain");
      add_primitive(primitive, world);
    }
  }

  Surface finish() {
    for (SurfaceAttribute* attribute : {&colour_, &normal_}) {
      if (attribute->values.empty()) continue;
      fill(*attribute, surface_.position.size());
      surface_.attributes.push_back(std::move(*attribute));
    }
    return std::move(surface_);
  }

 private:
  static constexpr std::uint64_t kTriangles = 4;  // the mode

  void add_primitive(const Json& primitive, const Transform& world) {
    const Json& attributes = primitive.at("attributes");
    const Accessor places = float_vectors(document_, attributes, "POSITION");
    first_ = surface_.position.size();
    if (places.count > max_vertices_ - first_) refuse("its nodes show more vertices than one surface may have");
    for (std::uint64_t v = 0; v < places.count; ++v)
      surface_.position.push_back(moved_by(world, vector_at(places, v)));
    if (attributes.contains("NORMAL")) add_normals(float_vectors(document_, attributes, "NORMAL"), world);
    if (attributes.contains("COLOR_0")) add_colours(accessor_of(document_, attributes["COLOR_0"]));
    // A mirrored mesh is turned over: so glTF says.
    add_triangles(primitive, determinant(world) < 0);
  }

  /// Gives vertices before `n_vertices` that have none yet white, or no normal.
  static void fill(SurfaceAttribute& attribute, std::size_t n_vertices) {
    attribute.values.resize(3 * n_vertices, attribute.kind == AttributeKind::kColour ? 1.0F : 0.0F);
  }

  void require_one_for_each(const Accessor& accessor) const {
    if (accessor.count != surface_.position.size() - first_) refuse("the attributes of a mesh differ in number");
  }

  /// By the inverse transpose; times the determinant, that is the cross products of the rows.
  void add_normals(const Accessor& normals, const Transform& world) {
    require_one_for_each(normals);
    fill(normal_, first_);
    const auto& [a, b, c] = world.linear;
    const std::array<Vector, 3> cofactors{cross(b, c), cross(c, a), cross(a, b)};
    const double sign = determinant(world) < 0 ? -1 : 1;
    for (std::uint64_t v = 0; v < normals.count; ++v) {
      const Vector turned = multiply(cofactors, vector_at(normals, v));
      const double length = std::sqrt(dot(turned, turned));
      // What has this length already keeps its digits.
      const double unit = length == 0 || std::abs(length - 1) < 1e-6 ? sign : sign / length;
      for (const double coordinate : turned) normal_.values.push_back(static_cast<float>(unit * coordinate));
    }
  }

  void add_colours(const Accessor& colours) {
    require_colours(colours);
    require_one_for_each(colours);
    fill(colour_, first_);
    for (std::uint64_t v = 0; v < colours.count; ++v)
      for (std::uint64_t k = 0; k < 3; ++k)
        colour_.values.push_back(static_cast<float>(level_at(colours, v, k) / 255));
  }

  void add_triangles(const Json& primitive, bool is_mirrored) {
    const std::uint64_t n_vertices = surface_.position.size() - first_;
    std::optional<Accessor> indices;
    if (primitive.contains("indices")) indices = accessor_of(document_, primitive["indices"]);
    if (indices) require_indices(*indices);
    const std::uint64_t n_corners = indices ? indices->count : n_vertices;
    if (n_corners % 3 != 0) refuse("the corners of a mesh are not three for each triangle");
    if (n_corners / 3 > 2 * max_vertices_ - surface_.triangles.size())
      refuse("its nodes show more triangles than one surface may have");
    for (std::uint64_t i = 0; i < n_corners; i += 3) {
      std::array<std::uint32_t, 3> triangle;
      for (std::uint64_t k = 0; k < 3; ++k) {
        const std::uint64_t index = indices ? index_at(*indices, i + k) : i + k;
        if (index >= n_vertices) refuse(fmt::format("an index names vertex {} of {}", index, n_vertices));
        triangle[k] = static_cast<std::uint32_t>(first_ + index);
      }
      surface_.triangles.push_back(turned(triangle, is_mirrored));
    }
  }

  const Document& document_;
  std::uint64_t max_vertices_;
  std::size_t first_ = 0;  // vertex of the mesh that is being added
  Surface surface_;
  SurfaceAttribute colour_;
  SurfaceAttribute normal_;
};

/// The nodes at the top of the scene that a viewer shows.
std::vector<std::uint64_t> scene_nodes(const Json& json) {
  const Json& scene = element(json, "scenes", whole(json, "scene", 0));
  std::vector<std::uint64_t> nodes;
  for (const Json& node : scene.value("nodes", Json::array())) nodes.push_back(whole(node));
  return nodes;
}

/// All meshes of the scene, parents before children, in the order of the file.
Surface surface_of(const Document& document, std::uint64_t max_vertices) {
  struct Visit {
    std::uint64_t node;
    Transform parent;
  };
  std::vector<Visit> visits;
  const auto add_visits = [&](const std::vector<std::uint64_t>& nodes, const Transform& parent) {
    for (auto node = nodes.rbegin(); node != nodes.rend(); ++node) visits.push_back({*node, parent});
  };
  SurfaceBuilder builder(document, max_vertices);
  add_visits(scene_nodes(document.json), {});
  std::vector<bool> is_visited(document.json.value("nodes", Json::array()).size(), false);
  while (!visits.empty()) {
    const Visit visit = visits.back();
    visits.pop_back();
    const Json& node = element(document.json, "nodes", visit.node);
    if (is_visited[visit.node]) refuse(fmt::format("node {} has two parents, or is its own", visit.node));
    is_visited[visit.node] = true;
    const Transform world = combined(visit.parent, of_node(node));
    if (node.contains("mesh")) builder.add_mesh(element(document.json, "meshes", whole(node["mesh"])), world);
    std::vector<std::uint64_t> children;
    for (const Json& child : node.value("children", Json::array())) children.push_back(whole(child));
    add_visits(children, world);
  }
  return builder.finish();
}

}  // namespace

Surface read_surface_glb(const std::string& path) {
  InputFile file(path);
  try {
    const Json json = read_json(file);
    const std::vector<char> binary = read_binary(file);
    return surface_of({json, binary}, std::min<std::uint64_t>(std::max(kMaxUnfolded, file.size()),
                                                              std::numeric_limits<std::uint32_t>::max()));
  } catch (const Json::exception&) {
    file.fail("is no valid glTF: its JSON is damaged, or lacks what a mesh needs");
  } catch (const std::invalid_argument& error) {
    file.fail(fmt::format("can't be used: {}", error.what()));
  }
}

}  // namespace tinsmith
