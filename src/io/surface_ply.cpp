#include "io/surface_ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "io/surface_text.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

static_assert(std::endian::native == std::endian::little, "PLY is written in the machine's byte order");

enum class Type { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

struct TypeName {
  std::string_view name;
  Type type;
};

constexpr std::array kTypeNames{
    TypeName{"char", Type::kInt8},      TypeName{"int8", Type::kInt8},       TypeName{"uchar", Type::kUint8},
    TypeName{"uint8", Type::kUint8},    TypeName{"short", Type::kInt16},     TypeName{"int16", Type::kInt16},
    TypeName{"ushort", Type::kUint16},  TypeName{"uint16", Type::kUint16},   TypeName{"int", Type::kInt32},
    TypeName{"int32", Type::kInt32},    TypeName{"uint", Type::kUint32},     TypeName{"uint32", Type::kUint32},
    TypeName{"float", Type::kFloat32},  TypeName{"float32", Type::kFloat32}, TypeName{"double", Type::kFloat64},
    TypeName{"float64", Type::kFloat64}};

constexpr std::array<std::uint64_t, 8> kTypeBytes{1, 1, 2, 2, 4, 4, 4, 8};

/// What a colour channel of the type has at full strength; other integers hold bytes too.
double full_strength(Type type) {
  if (type == Type::kFloat32 || type == Type::kFloat64) return 1;
  return type == Type::kUint16 ? 65535 : 255;
}

struct Property {
  std::string name;
  Type type = Type::kFloat32;
  std::optional<Type> count_type;  // of a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  std::optional<std::size_t> find(std::string_view wanted) const {
    for (std::size_t p = 0; p < properties.size(); ++p)
      if (properties[p].name == wanted) return p;
    return std::nullopt;
  }
};

enum class Encoding { kAscii, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kAscii;
  std::vector<Element> elements;

  const Element* find(std::string_view name) const {
    const auto found = std::find_if(elements.begin(), elements.end(), [&](auto& e) { return e.name == name; });
    return found == elements.end() ? nullptr : &*found;
  }
};

// ---- reading the header

std::string_view next_line(InputFile& file) {
  std::string_view line;
  if (!file.read_line(line)) file.fail("the PLY header ends too early");
  return line;
}

Type type_of(const InputFile& file, std::string_view name) {
  for (const TypeName& known : kTypeNames)
    if (known.name == name) return known.type;
  file.fail("the PLY header names a type that PLY has not");
}

Encoding encoding_of(const InputFile& file, std::string_view rest) {
  const std::string_view name = take_word(rest);
  if (take_word(rest) != "1.0") file.fail("the PLY header has a version other than 1.0");
  if (name == "ascii") return Encoding::kAscii;
  if (name == "binary_little_endian") return Encoding::kLittleEndian;
  if (name == "binary_big_endian") return Encoding::kBigEndian;
  file.fail("the PLY header names a format that PLY has not");
}

void add_element(const InputFile& file, std::string_view rest, Header& header) {
  Element element;
  element.name = take_word(rest);
  const std::int64_t count = whole_number_of(file, take_word(rest));
  if (count < 0) file.fail("the PLY header has a negative count");
  element.count = static_cast<std::uint64_t>(count);
  if (header.find(element.name) != nullptr) file.fail("the PLY header has an element twice");
  header.elements.push_back(std::move(element));
}

void add_property(const InputFile& file, std::string_view rest, Header& header) {
  if (header.elements.empty()) file.fail("the PLY header has a property before any element");
  Property property;
  std::string_view type = take_word(rest);
  if (type == "list") {
    property.count_type = type_of(file, take_word(rest));
    type = take_word(rest);
  }
  property.type = type_of(file, type);
  property.name = take_word(rest);
  if (property.name.empty()) file.fail("the PLY header has a property without a name");
  Element& element = header.elements.back();
  if (element.find(property.name)) file.fail("the PLY header has a property twice");
  element.properties.push_back(std::move(property));
}

Header read_header(InputFile& file) {
  if (next_line(file) != "ply") file.fail("is no PLY: the first line is not 'ply'");
  Header header;
  bool has_format = false;
  while (true) {
    std::string_view rest = next_line(file);
    const std::string_view word = take_word(rest);
    if (word == "end_header") break;
    if (word == "format") {
      header.encoding = encoding_of(file, rest);
      has_format = true;
    } else if (word == "element") {
      add_element(file, rest, header);
    } else if (word == "property") {
      add_property(file, rest, header);
    } else if (word != "comment" && word != "obj_info" && !word.empty()) {
      file.fail("the PLY header has a line that is none of PLY's");
    }
  }
  if (!has_format) file.fail("the PLY header names no format");
  return header;
}

// ---- reading what comes after it

/// The numbers after the header, one after the other, whatever their type and encoding.
class Numbers {
 public:
  Numbers(InputFile& file, Encoding encoding) : file_(file), encoding_(encoding) {}

  double next(Type type) {
    if (encoding_ == Encoding::kAscii) return number_of(file_, next_word());
    switch (type) {
      case Type::kInt8:
        return binary<std::int8_t>();
      case Type::kUint8:
        return binary<std::uint8_t>();
      case Type::kInt16:
        return binary<std::int16_t>();
      case Type::kUint16:
        return binary<std::uint16_t>();
      case Type::kInt32:
        return binary<std::int32_t>();
      case Type::kUint32:
        return binary<std::uint32_t>();
      case Type::kFloat32:
        return binary<float>();
      default:
        return binary<double>();
    }
  }

  /// The length of a list.
  std::uint64_t next_length(Type type) {
    const double length = next(type);
    if (!(length >= 0) || length > 0xFFFFFFFFU || length != std::floor(length))
      file_.fail("a list has a length that is none");
    return static_cast<std::uint64_t>(length);
  }

  void skip(const Property& property) {
    const std::uint64_t n = property.count_type ? next_length(*property.count_type) : 1;
    for (std::uint64_t k = 0; k < n; ++k) next(property.type);
  }

  /// Complains when the file can't hold so many of the element: before memory is asked for.
  void require_room(const Element& element) const {
    std::uint64_t least = 0;
    for (const Property& property : element.properties)
      least += encoding_ == Encoding::kAscii
                   ? 2  // a digit and a blank, that may be missing at the end of the file
                   : kTypeBytes[static_cast<std::size_t>(property.count_type.value_or(property.type))];
    if (least > 0 && element.count > (file_.left() + 1) / least)
      file_.fail(fmt::format("{} bytes are too few for the {} '{}' that the header promises", file_.left(),
                             element.count, element.name));
  }

  void require_end() {
    const bool is_at_end = encoding_ == Encoding::kAscii ? !has_word() : file_.left() == 0;
    if (!is_at_end) file_.fail("has more than the PLY header promises");
  }

 private:
  template <class T>
  double binary() {
    auto bytes = file_.read<std::array<std::uint8_t, sizeof(T)>>();
    if (encoding_ == Encoding::kBigEndian) std::reverse(bytes.begin(), bytes.end());
    return static_cast<double>(std::bit_cast<T>(bytes));
  }

  bool has_word() {
    word_ = take_word(line_);
    while (word_.empty() && file_.read_line(line_, LastLine::kMayLackEnd)) word_ = take_word(line_);
    return !word_.empty();
  }

  std::string_view next_word() {
    if (!has_word()) file_.fail("ends too early");
    return word_;
  }

  InputFile& file_;
  Encoding encoding_;
  std::string_view line_;  // what is left of it
  std::string_view word_;
};

/// An attribute and the properties that it is read from.
struct AttributeSource {
  AttributeKind kind = AttributeKind::kScalar;
  std::vector<std::size_t> properties;
  double unit = 1;  // what a property has where the attribute is 1
};

/// The places of three properties, when all are there and none is a list.
std::optional<std::vector<std::size_t>> find_three(const Element& element,
                                                   const std::array<const char*, 3>& names) {
  std::vector<std::size_t> places;
  for (const char* name : names) {
    const auto place = element.find(name);
    if (!place || element.properties[*place].count_type) return std::nullopt;
    places.push_back(*place);
  }
  return places;
}

constexpr std::array<std::array<const char*, 3>, 3> kColourNames{
    {{"red", "green", "blue"}, {"r", "g", "b"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}}};

/// Colour and normal when they are there, then all other numbers as scalars.
std::vector<AttributeSource> attribute_sources(const Element& element, std::span<const std::size_t> axes) {
  std::vector<AttributeSource> sources;
  std::vector<bool> is_used(element.properties.size(), false);
  const auto use = [&](AttributeKind kind, const std::vector<std::size_t>& places, double unit) {
    for (const std::size_t place : places) is_used[place] = true;
    sources.push_back({kind, places, unit});
  };
  for (const std::size_t axis : axes) is_used[axis] = true;
  for (const auto& names : kColourNames) {
    const auto places = find_three(element, names);
    if (!places) continue;
    use(AttributeKind::kColour, *places, full_strength(element.properties[(*places)[0]].type));
    break;
  }
  if (const auto places = find_three(element, {"nx", "ny", "nz"})) use(AttributeKind::kNormal, *places, 1);
  for (std::size_t p = 0; p < element.properties.size(); ++p)
    if (!is_used[p] && !element.properties[p].count_type) use(AttributeKind::kScalar, {p}, 1);
  return sources;
}

void read_vertices(InputFile& file, Numbers& numbers, const Element& element, Surface& surface) {
  const auto axes = find_three(element, {"x", "y", "z"});
  if (!axes) file.fail("the PLY vertices have no x, y and z");
  const std::vector<AttributeSource> sources = attribute_sources(element, *axes);
  for (const AttributeSource& source : sources) {
    SurfaceAttribute attribute;
    attribute.kind = source.kind;
    if (source.kind == AttributeKind::kScalar) attribute.name = element.properties[source.properties[0]].name;
    attribute.values.reserve(element.count * source.properties.size());
    surface.attributes.push_back(std::move(attribute));
  }
  surface.position.reserve(element.count);
  std::vector<double> values(element.properties.size());
  for (std::uint64_t v = 0; v < element.count; ++v) {
    for (std::size_t p = 0; p < values.size(); ++p) {
      const Property& property = element.properties[p];
      if (property.count_type) {
        numbers.skip(property);
      } else {
        values[p] = numbers.next(property.type);
      }
    }
    surface.position.push_back({values[(*axes)[0]], values[(*axes)[1]], values[(*axes)[2]]});
    for (std::size_t a = 0; a < sources.size(); ++a)
      for (const std::size_t p : sources[a].properties)
        surface.attributes[a].values.push_back(static_cast<float>(values[p] / sources[a].unit));
  }
}

/// Reads a polygon's corners and cuts it into a fan.
class FaceReader {
 public:
  FaceReader(InputFile& file, Numbers& numbers, std::uint64_t n_vertices)
      : file_(file), numbers_(numbers), n_vertices_(static_cast<double>(n_vertices)) {}

  void read(const Property& list, std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const std::uint64_t n = numbers_.next_length(*list.count_type);
    if (n < 3) file_.fail("a face has fewer than three corners");
    const std::uint32_t first = next_corner(list.type);
    std::uint32_t before = next_corner(list.type);
    for (std::uint64_t k = 2; k < n; ++k) {
      const std::uint32_t corner = next_corner(list.type);
      triangles.push_back({first, before, corner});
      before = corner;
    }
  }

 private:
  std::uint32_t next_corner(Type type) {
    const double index = numbers_.next(type);
    if (!(index >= 0) || index >= n_vertices_ || index != std::floor(index))
      file_.fail("a face names a vertex that is not there");
    return static_cast<std::uint32_t>(index);
  }

  InputFile& file_;
  Numbers& numbers_;
  double n_vertices_;
};

void read_faces(InputFile& file, Numbers& numbers, const Header& header, Surface& surface) {
  const Element& element = *header.find("face");
  auto corners = element.find("vertex_indices");
  if (!corners) corners = element.find("vertex_index");
  if (!corners || !element.properties[*corners].count_type) file.fail("the PLY faces have no vertex_indices");
  FaceReader reader(file, numbers, header.find("vertex")->count);
  surface.triangles.reserve(element.count);
  for (std::uint64_t f = 0; f < element.count; ++f)
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      if (p == *corners) {
        reader.read(element.properties[p], surface.triangles);
      } else {
        numbers.skip(element.properties[p]);
      }
    }
}

void skip_element(Numbers& numbers, const Element& element) {
  if (element.properties.empty()) return;
  for (std::uint64_t k = 0; k < element.count; ++k)
    for (const Property& property : element.properties) numbers.skip(property);
}

void require_vertices_and_faces(const InputFile& file, const Header& header) {
  if (header.find("vertex") == nullptr) file.fail("the PLY header has no vertices");
  if (header.find("face") == nullptr) file.fail("has no triangles: the PLY header has no faces");
  if (header.find("vertex")->count > 0xFFFFFFFFU) file.fail("the PLY header has 2^32 vertices or more");
}

// ---- writing

/// The next free byte of a record.
template <class T>
void put(char*& to, T value) {
  std::memcpy(to, &value, sizeof value);
  to += sizeof value;
}

void require_name(const std::string& path, const Surface& surface, std::size_t a) {
  constexpr std::array kTaken{"x", "y", "z", "nx", "ny", "nz", "red", "green", "blue"};
  const std::string& name = surface.attributes[a].name;
  const bool is_word = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) { return c > ' '; });
  bool is_taken = std::find(kTaken.begin(), kTaken.end(), name) != kTaken.end();
  for (std::size_t b = 0; b < a; ++b) is_taken = is_taken || surface.attributes[b].name == name;
  if (!is_word || is_taken)
    throw ResourceError(
        fmt::format("{}: PLY can't name a vertex property '{}' here; give the scalar another name", path, name));
}

std::string header_text(const std::string& path, const Surface& surface) {
  std::string text = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\n"
      "property double x\nproperty double y\nproperty double z\n",
      surface.position.size());
  for (std::size_t a = 0; a < surface.attributes.size(); ++a) {
    switch (surface.attributes[a].kind) {
      case AttributeKind::kColour:
        text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
        break;
      case AttributeKind::kNormal:
        text += "property float nx\nproperty float ny\nproperty float nz\n";
        break;
      case AttributeKind::kScalar:
        require_name(path, surface, a);
        text += fmt::format("property float {}\n", surface.attributes[a].name);
    }
  }
  // Readers that only know int take these indices too, as long as they fit.
  const bool fits_int = surface.position.size() <= std::uint64_t{1} << 31;
  return text + fmt::format("element face {}\nproperty list uchar {} vertex_indices\nend_header\n",
                            surface.triangles.size(), fits_int ? "int" : "uint");
}

std::uint8_t to_byte(float strength) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(strength, 0.0F, 1.0F) * 255));
}

void write_vertex(OutputFile& file, const Surface& surface, std::size_t v, std::vector<char>& record) {
  char* to = record.data();
  for (const double coordinate : surface.position[v]) put(to, coordinate);
  for (const SurfaceAttribute& attribute : surface.attributes) {
    const auto n = static_cast<std::size_t>(attribute.components());
    for (std::size_t k = n * v; k < n * v + n; ++k) {
      if (attribute.kind == AttributeKind::kColour) {
        put(to, to_byte(attribute.values[k]));
      } else {
        put(to, attribute.values[k]);
      }
    }
  }
  file.write(record.data(), static_cast<std::size_t>(to - record.data()));
}

}  // namespace

Surface read_surface_ply(const std::string& path) {
  InputFile file(path);
  const Header header = read_header(file);
  require_vertices_and_faces(file, header);
  Numbers numbers(file, header.encoding);
  Surface surface;
  for (const Element& element : header.elements) {
    numbers.require_room(element);
    if (element.name == "vertex") {
      read_vertices(file, numbers, element, surface);
    } else if (element.name == "face") {
      read_faces(file, numbers, header, surface);
    } else {
      skip_element(numbers, element);
    }
  }
  numbers.require_end();
  return surface;
}

void write_surface_ply(const std::string& path, const Surface& surface) {
  const std::string header = header_text(path, surface);
  OutputFile file(path);
  file.write(header);
  std::vector<char> record(3 * sizeof(double) + 3 * sizeof(float) * surface.attributes.size());
  for (std::size_t v = 0; v < surface.position.size(); ++v) write_vertex(file, surface, v, record);
  for (const auto& triangle : surface.triangles) {
    const std::uint8_t n_corners = 3;
    file.write(&n_corners, 1);
    file.write(triangle.data(), sizeof triangle);
  }
  file.commit();
}

}  // namespace tinsmith
