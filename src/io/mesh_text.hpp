#pragma once
// What the mesh formats have in common: corners in CRS coordinates, and the parts of the text formats.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "geodesy/grid_frame.hpp"
#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "io/vertex_colour.hpp"
#include "mesh/terrain_mesh.hpp"

namespace tinsmith {

struct MeshVisitor;

/// A vertex of a line of text.
struct TextVertex : ColouredVertex {
  bool has_colour = false;
};

/// A vertex in CRS coordinates.
std::array<double, 3> vertex_in_crs(const TerrainVertex& vertex, const GridFrame& frame);

/// A triangle, counter-clockwise seen from above: turned over about its first corner in a mirrored frame.
template <class Index>
std::array<Index, 3> turned(std::array<Index, 3> triangle, bool is_mirrored) {
  if (is_mirrored) std::swap(triangle[1], triangle[2]);
  return triangle;
}

/// WKT without line breaks.
std::string one_line(const std::string& wkt);

/// Appends a blank and the shortest decimals that read back as the same double or float; or an index.
void append_number(std::string& line, double value);
void append_number(std::string& line, float value);
void append_number(std::string& line, std::uint64_t value);

/// The comment by which a reader of a text format knows that nothing is missing.
std::string counts_comment(std::uint64_t n_vertices, std::uint64_t n_triangles);

/// The comment by which a reader of a text format knows what heights are in.
std::string height_unit_comment(double metres_per_unit);

/// Numbers of a line of text, one after the other. Complains through the file.
class LineNumbers {
 public:
  LineNumbers(const InputFile& file, std::string_view rest) : file_(file), rest_(rest) {}
  std::array<double, 3> coordinates();
  /// Three numbers from 1, as indices from 0.
  std::array<std::uint64_t, 3> corners();
  std::uint64_t count();
  bool is_end();
  /// The number of a line that has no other.
  double only();
  /// Complains unless the line ends here.
  void end();
  [[noreturn]] void fail(const char* what) const { file_.fail(what); }

 private:
  template <class T>
  T next();
  void skip_blanks();
  const InputFile& file_;
  std::string_view rest_;
};

/// Holds the counts of counts_comment, when one was met, against what was read.
class TextCounts {
 public:
  /// Returns whether the line was the comment.
  bool read_comment(const InputFile& file, std::string_view line);
  void require_whole(const InputFile& file, std::uint64_t n_vertices, std::uint64_t n_triangles) const;
  /// Of vertices and triangles; nothing before the comment was met.
  const std::optional<std::array<std::uint64_t, 2>>& promised() const { return counts_; }

 private:
  std::optional<std::array<std::uint64_t, 2>> counts_;
};

/// How the lines of a text format look. The functions take a line's numbers after its beginning, and how many
/// vertices or triangles came before it.
struct TextLines {
  std::string_view vertex;  // what the line begins with
  std::string_view triangle;
  TextVertex (*vertex_of)(LineNumbers& numbers, std::uint64_t n_before);
  std::array<std::uint64_t, 3> (*triangle_of)(LineNumbers& numbers, std::uint64_t n_before);
  bool (*is_ignored)(std::string_view line);  // of lines that are neither
};

/// Visits the mesh in the rest of a file of lines: reads the vertices and counts the triangles, in any order, then
/// goes back to the first triangle.
void visit_text(InputFile& file, const TextLines& lines, const MeshVisitor& visitor);

/// What stands in the .prj beside a mesh; empty when there is none.
std::string read_prj(const std::string& mesh_path);

/// Throws OutputError when a .prj of another CRS is beside the mesh to be: it may belong to any other file of that
/// name, so it is neither replaced nor removed, nor may it speak for the mesh.
void require_free_prj(const std::string& mesh_path, const std::string& crs_wkt);

/// A text mesh and the .prj beside it (ESRI's WKT, else the CRS's own), put in place together. A .prj that is there
/// is left as it is: see require_free_prj.
class FileWithPrj {
 public:
  FileWithPrj(const std::string& path, const std::string& crs_wkt);
  OutputFile& mesh() { return mesh_; }
  void commit();

 private:
  OutputFile mesh_;
  std::optional<OutputFile> prj_;
};

}  // namespace tinsmith
