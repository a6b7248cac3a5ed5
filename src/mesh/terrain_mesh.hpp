#pragma once
// The finished surface of a grid: triangles on the lattice, whole in memory or gone through block by block.

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "geometry/colour.hpp"
#include "geometry/lattice.hpp"

namespace tinsmith {

/// Triangles are counter-clockwise in the grid frame (see lattice.hpp); heights are in the vertical unit of
/// the input. Vertices that pinch the surface (two fans at one place) are there once for each fan.
struct TerrainMesh {
  std::vector<LatticePoint> position;
  std::vector<double> height;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Levels> colour = {};  // by vertex; empty without channels
  int n_channels = 0;               // of the colours; 0: there are none
};

struct TerrainVertex {
  LatticePoint position;
  double height = 0;  // vertical unit of the input
  Levels colour = {};
};

/// What a writer must know before the first vertex. All of it is exact: .glb declares it, and finds its origin by
/// it.
struct TerrainExtent {
  std::uint64_t n_vertices = 0;
  std::uint64_t n_triangles = 0;
  LatticePoint low;  // over all vertices; without meaning when there are none
  LatticePoint high;
  double lowest = 0;
  double highest = 0;
  int n_channels = 0;  // of the vertices' colours; 0: they have none
};

/// A finished surface that need not be in memory: it can be gone through any number of times, in blocks of some
/// thousand, in the same order each time. Triangles name vertices by their number in that order.
class TerrainSurface {
 public:
  using VertexBlock = std::span<const TerrainVertex>;
  using TriangleBlock = std::span<const std::array<std::uint64_t, 3>>;

  TerrainSurface() = default;
  TerrainSurface(const TerrainSurface&) = delete;
  TerrainSurface& operator=(const TerrainSurface&) = delete;
  virtual ~TerrainSurface() = default;

  virtual const TerrainExtent& extent() const = 0;
  virtual void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const = 0;
  virtual void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const = 0;
};

/// A mesh in memory, which must outlive it, as a surface.
class MeshSurface : public TerrainSurface {
 public:
  explicit MeshSurface(const TerrainMesh& mesh);

  const TerrainExtent& extent() const override { return extent_; }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const override;
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const override;

 private:
  const TerrainMesh& mesh_;
  TerrainExtent extent_;
};

}  // namespace tinsmith
