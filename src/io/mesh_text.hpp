#pragma once
// What the mesh formats have in common: corners in CRS coordinates, and the parts of the text formats.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "geodesy/grid_frame.hpp"
#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// A vertex in CRS coordinates.
std::array<double, 3> vertex_in_crs(const TerrainMesh& mesh, std::size_t vertex, const GridFrame& frame);

/// A triangle, counter-clockwise seen from above: turned over about its first corner in a mirrored frame.
std::array<std::uint32_t, 3> turned(std::array<std::uint32_t, 3> triangle, bool is_mirrored);

/// WKT without line breaks.
std::string one_line(const std::string& wkt);

/// Appends a blank and the shortest decimals that read back as the same double or float; or an index.
void append_number(std::string& line, double value);
void append_number(std::string& line, float value);
void append_number(std::string& line, std::uint64_t value);

/// The comment by which a reader of a text format knows that nothing is missing.
std::string counts_comment(const TerrainMesh& mesh);
std::string counts_comment(std::size_t n_vertices, std::size_t n_triangles);

/// Numbers of a line of text, one after the other. Complains through the file.
class LineNumbers {
 public:
  LineNumbers(const InputFile& file, std::string_view rest) : file_(file), rest_(rest) {}
  double coordinate();
  /// A number from 1, as an index from 0.
  std::uint32_t index();
  std::uint64_t count() { return next<std::uint64_t>(); }
  /// Complains unless the line ends here.
  void end();

 private:
  template <class T>
  T next();
  const InputFile& file_;
  std::string_view rest_;
};

/// Holds the counts of counts_comment, when one was met, against what was read.
class TextCounts {
 public:
  /// Returns whether the line was the comment.
  bool read_comment(const InputFile& file, std::string_view line);
  void require_whole(const InputFile& file, const Tin& tin) const;
  /// The same where nothing is missing without the comment.
  void require_whole(const InputFile& file, std::size_t n_vertices, std::size_t n_triangles) const;

 private:
  std::optional<std::array<std::uint64_t, 2>> counts_;
};

/// What stands in the .prj beside a mesh; empty when there is none.
std::string read_prj(const std::string& mesh_path);

/// A text mesh and the .prj beside it (ESRI's WKT, else the CRS's own), put in place together. A .prj of an
/// earlier mesh of this name goes when the new one has no CRS.
class FileWithPrj {
 public:
  FileWithPrj(const std::string& path, const std::string& crs_wkt);
  OutputFile& mesh() { return mesh_; }
  void commit();

 private:
  std::string prj_path_;
  OutputFile mesh_;
  std::optional<OutputFile> prj_;
};

}  // namespace tinsmith
