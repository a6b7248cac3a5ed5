#include "io/mesh_text.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <span>
#include <vector>

#include "geodesy/crs.hpp"
#include "io/mesh_file.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::string_view kCountsComment = "# tinsmith mesh; vertices, triangles:";
constexpr std::string_view kHeightUnitComment = "# metres per unit of height:";

template <class T>
void append(std::string& line, T value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  line += ' ';
  line.append(digits.data(), end);
}

bool is_blank(char c) { return c == ' ' || c == '\t'; }

std::string prj_path(const std::string& mesh_path) {
  return std::filesystem::path(mesh_path).replace_extension(".prj").string();
}

std::string prj_text(const std::string& crs_wkt) {
  OGRSpatialReference crs;
  CPLPushErrorHandler(CPLQuietErrorHandler);
  char* esri = nullptr;
  const char* const options[] = {"FORMAT=WKT1_ESRI", nullptr};
  const bool is_exported =
      crs.importFromWkt(crs_wkt.c_str()) == OGRERR_NONE && crs.exportToWkt(&esri, options) == OGRERR_NONE;
  std::string text = is_exported && esri != nullptr && *esri != '\0' ? esri : crs_wkt;
  CPLFree(esri);
  CPLPopErrorHandler();
  return text;
}

/// Hands single elements on in blocks.
template <class T>
class Blocks {
 public:
  explicit Blocks(const std::function<void(std::span<const T>)>& visit) : visit_(visit) {}
  void add(const T& element) {
    block_.push_back(element);
    if (block_.size() == kBlock) hand_on();
  }
  void hand_on() {
    if (!block_.empty()) visit_(block_);
    block_.clear();
  }

 private:
  static constexpr std::size_t kBlock = 4096;
  const std::function<void(std::span<const T>)>& visit_;
  std::vector<T> block_;
};

/// Hands vertices on in blocks, with their colours when all have one.
class VertexBlocks {
 public:
  VertexBlocks(const InputFile& file, const MeshVisitor& visitor)
      : file_(file),
        visit_([this, &visitor](std::span<const ColouredVertex> vertices) {
          visit_coloured(vertices, has_colour_ ? kChannels : 0, visitor);
        }),
        blocks_(visit_) {}
  void add(const TextVertex& vertex) {
    if (n_++ == 0) has_colour_ = vertex.has_colour;
    if (vertex.has_colour != has_colour_) file_.fail("only some of the vertices have a colour");
    blocks_.add(vertex);
  }
  void hand_on() { blocks_.hand_on(); }
  std::uint64_t count() const { return n_; }

 private:
  static constexpr int kChannels = 3;
  const InputFile& file_;
  bool has_colour_ = false;
  std::uint64_t n_ = 0;
  std::function<void(std::span<const ColouredVertex>)> visit_;
  Blocks<ColouredVertex> blocks_;
};

/// The one value that the numbers of a line make.
template <class T>
T value_of(const InputFile& file, std::string_view rest, T (*read)(LineNumbers&, std::uint64_t),
           std::uint64_t n_before) {
  LineNumbers numbers(file, rest);
  const T value = read(numbers, n_before);
  numbers.end();
  return value;
}

/// The lines of triangles that the search for vertices came by.
struct FoundTriangles {
  std::uint64_t count = 0;
  std::uint64_t begin = 0;  // byte
};

/// Reads the comment, when it comes next, and hands the counts on when the file is long enough for them.
TextCounts counts_at_head(InputFile& file, const MeshVisitor& visitor) {
  constexpr std::uint64_t kShortestLine = 8;  // "v 0 0 0\n"
  TextCounts counts;
  const std::uint64_t begin = file.position();
  std::string_view line;
  if (!file.read_line(line) || !counts.read_comment(file, line)) file.seek(begin);
  const std::uint64_t most = file.size() / kShortestLine;
  if (!counts.promised() || !visitor.counts) return counts;
  const auto& [n_vertices, n_triangles] = *counts.promised();
  if (n_vertices <= most && n_triangles <= most) visitor.counts(n_vertices, n_triangles);
  return counts;
}

FoundTriangles visit_vertices(InputFile& file, const TextLines& lines, const MeshVisitor& visitor) {
  VertexBlocks vertices(file, visitor);
  FoundTriangles triangles;
  TextCounts counts = counts_at_head(file, visitor);
  std::uint64_t begin = file.position();
  for (std::string_view line; file.read_line(line); begin = file.position()) {
    if (line.starts_with(lines.vertex)) {
      vertices.add(value_of(file, line.substr(lines.vertex.size()), lines.vertex_of, vertices.count()));
    } else if (line.starts_with(lines.triangle)) {
      if (triangles.count++ == 0) triangles.begin = begin;
    } else if (line.starts_with(kHeightUnitComment)) {
      const double metres = LineNumbers(file, line.substr(kHeightUnitComment.size())).only();
      if (visitor.height_unit) visitor.height_unit(metres);
    } else if (!counts.read_comment(file, line) && !lines.is_ignored(line)) {
      file.fail("a line is neither a vertex nor a triangle");
    }
  }
  if (!counts.promised() && triangles.count == 0) file.fail("has no triangles");
  counts.require_whole(file, vertices.count(), triangles.count);
  vertices.hand_on();
  return triangles;
}

void visit_triangles(InputFile& file, const TextLines& lines, const FoundTriangles& found,
                     const MeshVisitor& visitor) {
  Blocks triangles(visitor.triangles);
  std::uint64_t n_triangles = 0;
  file.seek(found.begin);
  for (std::string_view line; n_triangles < found.count && file.read_line(line);)
    if (line.starts_with(lines.triangle))
      triangles.add(value_of(file, line.substr(lines.triangle.size()), lines.triangle_of, n_triangles++));
  if (n_triangles < found.count) file.fail("has changed while it was read");
  triangles.hand_on();
}

}  // namespace

std::array<double, 3> vertex_in_crs(const TerrainVertex& vertex, const GridFrame& frame) {
  const LatticePoint p = vertex.position;
  const auto [x, y] =
      frame.to_crs(static_cast<double>(p.x) / kLatticePerCell, static_cast<double>(p.y) / kLatticePerCell);
  return {x, y, vertex.height};
}

std::string one_line(const std::string& wkt) {
  std::string line = wkt;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return line;
}

void append_number(std::string& line, double value) { append(line, value); }
void append_number(std::string& line, float value) { append(line, value); }
void append_number(std::string& line, std::uint64_t value) { append(line, value); }

std::string counts_comment(std::uint64_t n_vertices, std::uint64_t n_triangles) {
  return fmt::format("{} {} {}\n", kCountsComment, n_vertices, n_triangles);
}

std::string height_unit_comment(double metres_per_unit) {
  return fmt::format("{} {}\n", kHeightUnitComment, metres_per_unit);
}

void LineNumbers::skip_blanks() {
  std::size_t n = 0;
  while (n < rest_.size() && is_blank(rest_[n])) ++n;
  rest_.remove_prefix(n);
}

template <class T>
T LineNumbers::next() {
  skip_blanks();
  T value{};
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  const auto length = static_cast<std::size_t>(end - rest_.data());
  if (error != std::errc() || (length < rest_.size() && !is_blank(rest_[length])))
    file_.fail("a line has no valid number where one belongs");
  rest_.remove_prefix(length);
  return value;
}

std::array<double, 3> LineNumbers::coordinates() {
  return {next<double>(), next<double>(), next<double>()};  // braces: from left to right
}

std::array<std::uint64_t, 3> LineNumbers::corners() {
  std::array<std::uint64_t, 3> corners{count(), count(), count()};
  for (std::uint64_t& corner : corners)
    if (corner-- == 0) file_.fail("a line numbers a vertex that can't be there");
  return corners;
}

std::uint64_t LineNumbers::count() { return next<std::uint64_t>(); }

double LineNumbers::only() {
  const auto value = next<double>();
  end();
  return value;
}

bool LineNumbers::is_end() {
  skip_blanks();
  return rest_.empty();
}

void LineNumbers::end() {
  if (!is_end()) file_.fail("a line has more than belongs there");
}

bool TextCounts::read_comment(const InputFile& file, std::string_view line) {
  if (!line.starts_with(kCountsComment)) return false;
  LineNumbers numbers(file, line.substr(kCountsComment.size()));
  counts_ = std::array{numbers.count(), numbers.count()};
  numbers.end();
  return true;
}

void TextCounts::require_whole(const InputFile& file, std::uint64_t n_vertices, std::uint64_t n_triangles) const {
  if (counts_ && *counts_ != std::array<std::uint64_t, 2>{n_vertices, n_triangles})
    file.fail(fmt::format("has {} vertices and {} triangles where its head promises {} and {}", n_vertices,
                          n_triangles, (*counts_)[0], (*counts_)[1]));
}

void visit_text(InputFile& file, const TextLines& lines, const MeshVisitor& visitor) {
  const FoundTriangles triangles = visit_vertices(file, lines, visitor);
  if (triangles.count > 0) visit_triangles(file, lines, triangles, visitor);
}

std::string read_prj(const std::string& mesh_path) {
  std::ifstream file(prj_path(mesh_path), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void require_free_prj(const std::string& mesh_path, const std::string& crs_wkt) {
  const std::string path = prj_path(mesh_path);
  if (!std::filesystem::exists(path)) return;
  const std::string there = read_prj(mesh_path);
  const std::string wanted = crs_wkt.empty() ? "" : prj_text(crs_wkt);
  if (there == wanted || is_same_crs(there, wanted)) return;
  throw OutputError(
      fmt::format("{}: is there and would say {} of {}; choose another name for that, or move the .prj away", path,
                  wanted.empty() ? "a CRS, which is unknown," : "another CRS", mesh_path));
}

FileWithPrj::FileWithPrj(const std::string& path, const std::string& crs_wkt) : mesh_(path) {
  require_free_prj(path, crs_wkt);
  if (crs_wkt.empty() || std::filesystem::exists(prj_path(path))) return;
  prj_.emplace(prj_path(path));
  prj_->write(prj_text(crs_wkt));
}

void FileWithPrj::commit() {
  mesh_.finish();
  if (prj_) prj_->commit();
  mesh_.commit();
}

}  // namespace tinsmith
