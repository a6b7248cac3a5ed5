#pragma once
// A mesh sorted into the blocks of a raster, within a budget of memory: each triangle, whole, in every block
// that it touches.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "judge/block_bins.hpp"
#include "judge/block_grid.hpp"
#include "judge/shared_parts.hpp"
#include "judge/vertex_store.hpp"

namespace tinsmith {

/// Bytes that a mesh may keep in memory; what is more goes to scratch files in the folder, made when needed.
struct Budget {
  std::uint64_t vertices = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t facets = std::numeric_limits<std::uint64_t>::max();
  std::string folder;
};

/// Levels of 0 to 255: red, green, blue, alpha, as far as the mesh has them.
using VertexColour = std::array<float, 4>;

/// The colours of a facet's corners.
using FacetColours = std::array<VertexColour, 3>;

class BlockedMesh {
 public:
  BlockedMesh(const BlockGrid& grid, const GridFrame& frame, const Budget& budget);

  /// All vertices (x, y in the CRS of the frame, z) come before all triangles, whose vertices are counted from 0
  /// and are in range. Throws InputError when a vertex is beyond all measure away, ResourceError when there are
  /// more than 2^32 - 1 or a scratch file is full.
  void add_vertices(std::span<const std::array<double, 3>> vertices);
  /// The colours of all vertices, before the triangles, or of none.
  void add_colours(std::span<const VertexColour> colours);
  void add_triangle(const std::array<std::uint64_t, 3>& triangle);
  /// Frees what only adding needs.
  void close();

  std::uint64_t n_vertices() const { return vertices_.size(); }
  std::uint64_t n_triangles() const { return n_triangles_; }
  bool has_colours() const { return colours_.size() > 0; }
  double largest_height() const { return largest_height_; }  // of the vertices, as a size
  const BlockGrid& grid() const { return grid_; }

  /// The blocks that a triangle may touch, in their order.
  std::vector<BlockNumber> blocks() const { return facets_.blocks(); }
  std::size_t n_facets(BlockNumber block) const { return facets_.count(block); }
  /// The facets of a block by their numbers; the mesh forgets them. Several threads may take different blocks.
  std::vector<Facet> take(BlockNumber block) { return facets_.take(block); }
  /// To which every block adds its own.
  SharedParts& shared_parts() { return shared_parts_; }
  const SharedParts& shared_parts() const { return shared_parts_; }
  /// Their colours, in the same order; empty without.
  std::vector<FacetColours> take_colours(BlockNumber block) { return facet_colours_.take(block); }

 private:
  const BlockGrid& grid_;
  const GridFrame& frame_;
  VertexStore<PlanVertex> vertices_;
  VertexStore<VertexColour> colours_;
  std::uint64_t n_triangles_ = 0;
  double largest_height_ = 0;
  BlockBins<Facet> facets_;
  BlockBins<FacetColours> facet_colours_;
  SharedParts shared_parts_;
  std::vector<BlockNumber> touched_;  // by the triangle at hand
};

}  // namespace tinsmith
