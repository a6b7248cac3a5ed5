#pragma once
// What the peers in C++ share: the heights that all peers read, and the PLY that the judge reads.

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace bench {

/// A raster as dump writes it. A grid file is one line of JSON (the fields below but the heights), padded with
/// spaces to a multiple of 8 bytes, then width * height float32 row by row with NaN for voids.
struct Grid {
  std::int32_t width = 0;                // samples
  std::int32_t height = 0;               // samples
  std::array<double, 2> step{1, 1};      // metres between columns and rows, in the middle of the raster
  double unit = 1;                       // metres per unit of height
  std::array<double, 6> geotransform{};  // GDAL's
  std::string crs;                       // WKT
  bool has_voids = false;
  std::vector<float> z;  // units of height, NaN for voids
};

/// Vertices are (column, row, height in the unit of the grid); triangles are counter-clockwise or all clockwise.
struct Mesh {
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Throws std::runtime_error when the file can't be read.
Grid read_grid(const std::string& path);

/// All valid samples of a grid file, two triangles for each valid cell.
Mesh full_mesh(const Grid& grid);

/// Drops the vertices that no triangle uses.
void compact(Mesh& mesh);

/// The same mesh in metres, and back to the grid.
void to_metres(Mesh& mesh, const Grid& grid);
void to_grid(Mesh& mesh, const Grid& grid);

/// PLY in the CRS of the grid, as `tinsmith verify` reads it. All triangles are turned over when most of the
/// area is clockwise in plan; folded ones stay folded. Throws std::runtime_error.
void write_ply(const std::string& path, const Grid& grid, const Mesh& mesh);

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// What a peer prints on stdout: its own seconds, reading and writing of files not included, and its triangles.
void print_result(double seconds, const Mesh& mesh);

}  // namespace bench
