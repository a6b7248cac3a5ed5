#include "io/surface_obj.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "io/input_file.hpp"
#include "io/mesh_text.hpp"
#include "io/output_file.hpp"
#include "io/surface_text.hpp"

namespace tinsmith {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// A corner of a triangle: which v, and which vn or kNone.
struct Corner {
  std::uint32_t position = 0;
  std::uint32_t normal = kNone;
};

/// The statements of the file that matter here.
struct Statements {
  std::vector<std::array<double, 3>> position;
  std::vector<float> colour;  // empty, or three for each position
  std::vector<std::array<float, 3>> normal;
  std::vector<std::array<Corner, 3>> triangles;
};

// ---- reading

void read_position(const InputFile& file, std::string_view rest, Statements& out) {
  // x y z, x y z w, x y z r g b or x y z r g b a
  std::array<double, 7> numbers{};
  std::size_t n = 0;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
    if (n == numbers.size()) file.fail("a 'v' has more numbers than a place and a colour");
    numbers[n++] = number_of(file, word);
  }
  if (n < 3 || n == 5) file.fail("a 'v' is neither a place nor a place with a colour");
  const bool has_colour = n >= 6;
  if (!out.position.empty() && has_colour != !out.colour.empty())
    file.fail("only some of the 'v' have a colour: give all one, or none");
  out.position.push_back({numbers[0], numbers[1], numbers[2]});
  for (std::size_t k = 3; has_colour && k < 6; ++k) out.colour.push_back(static_cast<float>(numbers[k]));
}

void read_normal(const InputFile& file, std::string_view rest, Statements& out) {
  std::array<float, 3> normal{};
  for (float& coordinate : normal) coordinate = static_cast<float>(number_of(file, take_word(rest)));
  out.normal.push_back(normal);
}

/// Numbers count from 1, negative ones back from the latest. Whether it is there is known at the end only.
std::uint32_t index_of(const InputFile& file, std::string_view word, std::size_t n_so_far) {
  const std::int64_t number = whole_number_of(file, word);
  const std::int64_t index = number < 0 ? static_cast<std::int64_t>(n_so_far) + number : number - 1;
  if (number == 0 || index < 0 || index >= std::int64_t{kNone}) file.fail("an 'f' numbers what can't be there");
  return static_cast<std::uint32_t>(index);
}

/// a, a/b, a//c or a/b/c; b is of a texture.
Corner corner_of(const InputFile& file, std::string_view word, const Statements& so_far) {
  Corner corner;
  const std::size_t first = word.find('/');
  corner.position = index_of(file, word.substr(0, first), so_far.position.size());
  if (first == std::string_view::npos) return corner;
  const std::size_t second = word.find('/', first + 1);
  if (second == std::string_view::npos || second + 1 == word.size()) return corner;
  corner.normal = index_of(file, word.substr(second + 1), so_far.normal.size());
  return corner;
}

void read_face(const InputFile& file, std::string_view rest, Statements& out) {
  Corner first;
  Corner before;
  std::size_t n = 0;
  for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest), ++n) {
    const Corner corner = corner_of(file, word, out);
    if (n == 0) first = corner;
    if (n >= 2) out.triangles.push_back({first, before, corner});
    before = corner;
  }
  if (n < 3) file.fail("an 'f' has fewer than three corners");
}

/// The next line, with those that a backslash at its end appends.
bool read_statement(InputFile& file, std::string& statement) {
  std::string_view line;
  if (!file.read_line(line, LastLine::kMayLackEnd)) return false;
  statement = line;
  while (statement.ends_with('\\')) {
    statement.back() = ' ';
    if (file.read_line(line, LastLine::kMayLackEnd)) statement += line;
  }
  return true;
}

Statements read_statements(InputFile& file) {
  Statements out;
  TextCounts counts;
  for (std::string statement; read_statement(file, statement);) {
    std::string_view rest = statement;
    const std::string_view word = take_word(rest);
    if (word == "v") {
      read_position(file, rest, out);
    } else if (word == "vn") {
      read_normal(file, rest, out);
    } else if (word == "f") {
      read_face(file, rest, out);
    } else if (word.starts_with('#')) {
      counts.read_comment(file, statement);
    }
  }
  counts.require_whole(file, out.position.size(), out.triangles.size());
  return out;
}

/// Gives every pair of a place and a normal a vertex of its own: the first normal of a place the vertex of that
/// place, the others new ones at the end, that the place leads to in a chain.
class VertexSplitter {
 public:
  VertexSplitter(const InputFile& file, const Statements& statements, Surface& surface)
      : file_(file),
        statements_(statements),
        surface_(surface),
        normal_(statements.position.size(), kNone),
        is_used_(statements.position.size(), false),
        next_(statements.position.size(), kNone) {}

  std::uint32_t vertex_of(const Corner& corner) {
    if (corner.position >= statements_.position.size()) file_.fail("an 'f' names a 'v' that is not there");
    if (corner.normal != kNone && corner.normal >= statements_.normal.size())
      file_.fail("an 'f' names a 'vn' that is not there");
    std::uint32_t vertex = corner.position;
    if (!is_used_[vertex]) {
      is_used_[vertex] = true;
      normal_[vertex] = corner.normal;
    }
    while (!is_same_normal(normal_[vertex], corner.normal)) {
      if (next_[vertex] == kNone) next_[vertex] = append_copy(corner);
      vertex = next_[vertex];
    }
    return vertex;
  }

  /// The normals of all vertices; 0 0 0 of those without.
  std::vector<float> normals() const {
    std::vector<float> values;
    values.reserve(3 * normal_.size());
    for (const std::uint32_t normal : normal_)
      for (std::size_t k = 0; k < 3; ++k) values.push_back(normal == kNone ? 0 : statements_.normal[normal][k]);
    return values;
  }

 private:
  bool is_same_normal(std::uint32_t a, std::uint32_t b) const {
    return a == b || (a != kNone && b != kNone && statements_.normal[a] == statements_.normal[b]);
  }

  std::uint32_t append_copy(const Corner& corner) {
    const std::size_t vertex = surface_.position.size();
    if (vertex >= kNone) file_.fail("has 2^32 vertices or more, counting one for each normal");
    surface_.position.push_back(statements_.position[corner.position]);
    for (std::size_t k = 0; k < 3 && !statements_.colour.empty(); ++k)
      surface_.attributes[0].values.push_back(statements_.colour[3 * corner.position + k]);
    normal_.push_back(corner.normal);
    next_.push_back(kNone);
    return static_cast<std::uint32_t>(vertex);
  }

  const InputFile& file_;
  const Statements& statements_;
  Surface& surface_;
  std::vector<std::uint32_t> normal_;
  std::vector<bool> is_used_;        // by v: named by a corner
  std::vector<std::uint32_t> next_;  // the next vertex at the same place
};

// ---- writing

void write_vertices(OutputFile& file, const Surface& surface) {
  const SurfaceAttribute* colour = surface.find(AttributeKind::kColour);
  std::string line;
  for (std::size_t v = 0; v < surface.position.size(); ++v) {
    line = std::string_view("v");
    for (const double coordinate : surface.position[v]) append_number(line, coordinate);
    for (std::size_t k = 0; colour != nullptr && k < 3; ++k) append_number(line, colour->values[3 * v + k]);
    file.write(line += '\n');
  }
}

void write_normals(OutputFile& file, const SurfaceAttribute& normal) {
  std::string line;
  for (std::size_t v = 0; v < normal.values.size(); v += 3) {
    line = std::string_view("vn");
    for (std::size_t k = v; k < v + 3; ++k) append_number(line, normal.values[k]);
    file.write(line += '\n');
  }
}

}  // namespace

Surface read_surface_obj(const std::string& path) {
  InputFile file(path);
  const Statements statements = read_statements(file);
  Surface surface;
  surface.position = statements.position;
  if (!statements.colour.empty()) surface.attributes.push_back({AttributeKind::kColour, {}, statements.colour});
  VertexSplitter splitter(file, statements, surface);
  bool has_normals = false;
  surface.triangles.reserve(statements.triangles.size());
  for (const auto& [a, b, c] : statements.triangles) {
    surface.triangles.push_back({splitter.vertex_of(a), splitter.vertex_of(b), splitter.vertex_of(c)});
    for (const Corner& corner : {a, b, c}) has_normals = has_normals || corner.normal != kNone;
  }
  if (has_normals) surface.attributes.push_back({AttributeKind::kNormal, {}, splitter.normals()});
  return surface;
}

void write_surface_obj(const std::string& path, const Surface& surface) {
  OutputFile file(path);
  file.write(counts_comment(surface.position.size(), surface.triangles.size()));
  write_vertices(file, surface);
  const SurfaceAttribute* normal = surface.find(AttributeKind::kNormal);
  if (normal != nullptr) write_normals(file, *normal);
  std::string line;
  for (const auto& triangle : surface.triangles) {
    line = std::string_view("f");
    for (const std::uint64_t corner : triangle) {
      append_number(line, corner + 1);
      // Vertex and normal have the same number: "7//7".
      if (normal != nullptr) line += fmt::format("//{}", corner + 1);
    }
    file.write(line += '\n');
  }
  file.commit();
}

}  // namespace tinsmith
