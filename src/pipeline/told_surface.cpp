#include "pipeline/told_surface.hpp"

#include "tinsmith/error.hpp"

namespace tinsmith {

void ToldSurface::for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const {
  std::uint64_t n_done = 0;
  surface_.for_each_vertex_block([&](VertexBlock block) {
    visit(block);
    tell(n_done += block.size());
  });
}

void ToldSurface::for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const {
  std::uint64_t n_done = surface_.extent().n_vertices;
  surface_.for_each_triangle_block([&](TriangleBlock block) {
    visit(block);
    tell(n_done += block.size());
  });
}

void ToldSurface::tell(std::uint64_t n_done) const {
  const std::uint64_t n_all = surface_.extent().n_vertices + surface_.extent().n_triangles;
  if (progress_ && !progress_(static_cast<double>(n_done) / static_cast<double>(n_all), "write"))
    throw Interrupted("interrupted; the same command goes on from here");
}

}  // namespace tinsmith
