#include "io/mesh_text.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

namespace tinsmith {
namespace {

constexpr std::string_view kCountsComment = "# tinsmith mesh; vertices, triangles:";

template <class T>
void append(std::string& line, T value) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  line += ' ';
  line.append(digits.data(), end);
}

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

}  // namespace

std::array<double, 3> vertex_in_crs(const TerrainMesh& mesh, std::size_t vertex, const GridFrame& frame) {
  const LatticePoint p = mesh.position[vertex];
  const auto [x, y] =
      frame.to_crs(static_cast<double>(p.x) / kLatticePerCell, static_cast<double>(p.y) / kLatticePerCell);
  return {x, y, mesh.height[vertex]};
}

std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> triangle, bool is_mirrored) {
  if (is_mirrored) std::swap(triangle[1], triangle[2]);
  return triangle;
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

std::string counts_comment(const TerrainMesh& mesh) {
  return counts_comment(mesh.position.size(), mesh.triangles.size());
}

std::string counts_comment(std::size_t n_vertices, std::size_t n_triangles) {
  return fmt::format("{} {} {}\n", kCountsComment, n_vertices, n_triangles);
}

template <class T>
T LineNumbers::next() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size()));
  T value{};
  const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
  const auto length = static_cast<std::size_t>(end - rest_.data());
  if (error != std::errc() || (length < rest_.size() && rest_[length] != ' ' && rest_[length] != '\t'))
    file_.fail("a line has no valid number where one belongs");
  rest_.remove_prefix(length);
  return value;
}

double LineNumbers::coordinate() { return next<double>(); }

std::uint32_t LineNumbers::index() {
  const auto number = next<std::uint64_t>();
  if (number < 1 || number > std::uint64_t{1} << 32) file_.fail("a line numbers a vertex that can't be there");
  return static_cast<std::uint32_t>(number - 1);
}

void LineNumbers::end() {
  if (rest_.find_first_not_of(" \t") != std::string_view::npos) file_.fail("a line has more than belongs there");
}

bool TextCounts::read_comment(const InputFile& file, std::string_view line) {
  if (!line.starts_with(kCountsComment)) return false;
  LineNumbers numbers(file, line.substr(kCountsComment.size()));
  counts_ = std::array{numbers.count(), numbers.count()};
  numbers.end();
  return true;
}

void TextCounts::require_whole(const InputFile& file, const Tin& tin) const {
  if (!counts_ && tin.triangles.empty()) file.fail("has no triangles");
  require_whole(file, tin.vertices.size(), tin.triangles.size());
}

void TextCounts::require_whole(const InputFile& file, std::size_t n_vertices, std::size_t n_triangles) const {
  if (counts_ && *counts_ != std::array<std::uint64_t, 2>{n_vertices, n_triangles})
    file.fail(fmt::format("has {} vertices and {} triangles where its head promises {} and {}", n_vertices,
                          n_triangles, (*counts_)[0], (*counts_)[1]));
}

std::string read_prj(const std::string& mesh_path) {
  std::ifstream file(prj_path(mesh_path), std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

FileWithPrj::FileWithPrj(const std::string& path, const std::string& crs_wkt)
    : prj_path_(prj_path(path)), mesh_(path) {
  if (crs_wkt.empty()) return;
  prj_.emplace(prj_path_);
  prj_->write(prj_text(crs_wkt));
}

void FileWithPrj::commit() {
  mesh_.finish();
  if (prj_) prj_->commit();
  mesh_.commit();
  std::error_code ignored;
  if (!prj_) std::filesystem::remove(prj_path_, ignored);
}

}  // namespace tinsmith
