#pragma once
// A mesh sorted into the blocks of a raster, within a budget of memory: each triangle, whole, in every block
// that it touches.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/scratch_file.hpp"
#include "geodesy/grid_frame.hpp"
#include "judge/block_grid.hpp"
#include "judge/vertex_store.hpp"

namespace tinsmith {

/// Bytes that a mesh may keep in memory; what is more goes to scratch files in the folder, made when needed.
struct Budget {
  std::uint64_t vertices = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t facets = std::numeric_limits<std::uint64_t>::max();
  std::string folder;
};

class BlockedMesh {
 public:
  BlockedMesh(const BlockGrid& grid, const GridFrame& frame, const Budget& budget);

  /// All vertices (x, y in the CRS of the frame, z) come before all triangles, whose vertices are counted from 0
  /// and are in range. Throws InputError when a vertex is beyond all measure away, ResourceError when there are
  /// more than 2^32 - 1 or a scratch file is full.
  void add_vertices(std::span<const std::array<double, 3>> vertices);
  void add_triangle(const std::array<std::uint64_t, 3>& triangle);
  /// Frees what only adding needs.
  void close();

  std::uint64_t n_vertices() const { return vertices_.size(); }
  std::uint64_t n_triangles() const { return n_triangles_; }
  double largest_height() const { return largest_height_; }  // of the vertices, as a size
  const BlockGrid& grid() const { return grid_; }

  /// The blocks that a triangle may touch, in their order.
  std::vector<BlockNumber> blocks() const;
  std::size_t n_facets(BlockNumber block) const;
  /// The facets of a block by their numbers; the mesh forgets them. Several threads may take different blocks.
  std::vector<Facet> take(BlockNumber block);

 private:
  struct Piece {
    std::uint64_t place;
    std::size_t n_facets;
  };
  struct Bin {
    std::vector<Piece> in_file;
    std::vector<Facet> in_memory;
    std::size_t n_facets = 0;
  };
  Bin& bin_of(BlockNumber block);
  void put(const Facet& facet, Bin& bin);
  void spill();

  const BlockGrid& grid_;
  const GridFrame& frame_;
  Budget budget_;
  VertexStore vertices_;
  std::uint64_t n_triangles_ = 0;
  double largest_height_ = 0;
  std::map<BlockNumber, Bin> bins_;
  std::map<BlockNumber, Bin>::iterator last_ = bins_.end();  // triangles come in neighbourhoods
  std::vector<BlockNumber> touched_;                         // by the triangle at hand
  std::uint64_t bytes_ = 0;                                  // of facets in memory
  std::optional<ScratchFile> scratch_;
};

}  // namespace tinsmith
