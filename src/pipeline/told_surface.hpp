#pragma once
// A surface that tells how far it has been gone through.

#include "mesh/terrain_mesh.hpp"
#include "tinsmith/progress.hpp"

namespace tinsmith {

/// The same surface. Once through the vertices and once through the triangles is the whole of the stage "write".
/// Throws Interrupted when progress says so. What it is given must outlive it.
class ToldSurface : public TerrainSurface {
 public:
  ToldSurface(const TerrainSurface& surface, const Progress& progress) : surface_(surface), progress_(progress) {}

  const TerrainExtent& extent() const override { return surface_.extent(); }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const override;
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const override;

 private:
  void tell(std::uint64_t n_done) const;

  const TerrainSurface& surface_;
  const Progress& progress_;
};

}  // namespace tinsmith
