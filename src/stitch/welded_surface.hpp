#pragma once
// The chunks of the last round as one surface, without ever holding all of them.

#include <functional>
#include <map>
#include <memory>
#include <unordered_map>
#include <vector>

#include "mesh/terrain_mesh.hpp"
#include "tile/chunk.hpp"
#include "tile/window_graph.hpp"

namespace tinsmith {

/// Vertices are numbered window by window, in the order of their first use; those at one place are one vertex,
/// unless the triangles around the place form several fans: then one a fan. Only the borders of chunks that later
/// windows may still touch are remembered.
class WeldedSurface : public TerrainSurface {
 public:
  /// The chunk of a window of the last round; null when it is empty. May be asked for again and again.
  using ChunkOf = std::function<std::shared_ptr<const Chunk>(std::int64_t window)>;

  /// The graph must outlive the surface. `n_channels` of the chunks' colours; 0: they have none.
  WeldedSurface(const WindowGraph& graph, ChunkOf chunk_of, int n_channels = 0);

  /// Takes account of the next window of the last round: each once, in their order, before anything else.
  void add_next();
  std::int64_t n_added() const { return n_added_; }

  const TerrainExtent& extent() const override { return extent_; }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const override;
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const override;

 private:
  struct PlaceHash {
    std::size_t operator()(LatticePoint p) const;
  };
  // A vertex of a chunk on the chunk's border, with the vertices at the open ends of its fan.
  struct Fan {
    std::int64_t window = 0;
    std::int32_t vertex = 0;
    LatticePoint first;
    LatticePoint last;
  };
  using OpenPlaces = std::unordered_map<LatticePoint, std::vector<Fan>, PlaceHash>;

  void close(const std::vector<Fan>& fans);
  void close_places_before(std::int64_t window_row);
  template <class Visit>
  void for_each_numbered(Visit visit) const;

  const WindowGraph& graph_;
  ChunkOf chunk_of_;
  TerrainExtent extent_;
  std::int64_t n_added_ = 0;
  OpenPlaces open_;
  // By window and vertex: which of several vertices at one place it belongs to, if not the first.
  std::map<std::pair<std::int64_t, std::int32_t>, std::int32_t> pinches_;
};

/// A surface that fits in memory.
TerrainMesh mesh_of(const TerrainSurface& surface);

}  // namespace tinsmith
