#pragma once
// Progressive meshes (Hoppe 1996): a base mesh and the vertex splits that undo a simplification, one by one.

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tinsmith/simplify.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {

/// What undoes one collapse. Vertices and triangles are numbered in the order in which they come in, those of the
/// base first.
struct VertexSplit {
  struct Vertex {
    std::uint32_t parent = 0;    // the vertex that stood for it
    std::uint32_t original = 0;  // its number in the surface that was simplified
    std::array<double, 3> position{};
    std::vector<float> values;             // of all attributes, one after the other
    std::vector<std::uint32_t> triangles;  // that have it as a corner from now on, where they had the parent
  };
  struct Triangle {
    std::uint32_t original = 0;
    std::array<std::uint32_t, 3> corners{};
  };
  std::vector<Vertex> vertices;     // mostly one; two where a seam of the attributes passes
  std::vector<Triangle> triangles;  // one or two
};

struct ProgressiveSurface {
  Surface base;
  std::vector<std::uint32_t>
      original_vertex;  // of the base's vertices: their numbers in the surface that was simplified
  std::vector<std::uint32_t> original_triangle;  // of the base's triangles
  std::vector<VertexSplit> splits;
};

/// Simplifies with subset placement, whatever the options say, and keeps how. Throws as simplify_surface.
ProgressiveSurface make_progressive(const Surface& surface, SimplifySurfaceOptions options,
                                    SimplifySurfaceReport& report);

/// The surface with at most max_triangles triangles, but at least the base's; vertices and triangles are in the
/// order of the original. With all splits it is the original to the bit, but for what the report counted as
/// defects. Takes time in proportion to the result's size (n log n for the order).
Surface restore(const ProgressiveSurface& progressive,
                double max_triangles = std::numeric_limits<double>::infinity());

/// Writes a .tspm file (documented in src/io/progressive_file.cpp), aside and renamed when whole. Throws
/// OutputError.
void write_progressive(const std::string& path, const ProgressiveSurface& progressive);

/// Reads as many splits as max_triangles takes, and no more of the file. Throws InputError, with the place, for
/// anything that is not such a file or damaged so far as it is read.
ProgressiveSurface read_progressive(const std::string& path,
                                    double max_triangles = std::numeric_limits<double>::infinity());

}  // namespace tinsmith
