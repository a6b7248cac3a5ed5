#include "mesh/terrain_mesh.hpp"

#include <algorithm>

namespace tinsmith {

namespace {

constexpr std::size_t kBlock = 4096;

// Calls make(i) for each i below n and visits the results in blocks.
template <class T, class Make, class Visit>
void visit_blocks(std::size_t n, Make make, const Visit& visit) {
  std::vector<T> block;
  for (std::size_t start = 0; start < n; start += kBlock) {
    block.clear();
    for (std::size_t i = start; i < std::min(n, start + kBlock); ++i) block.push_back(make(i));
    visit(block);
  }
}

}  // namespace

MeshSurface::MeshSurface(const TerrainMesh& mesh) : mesh_(mesh) {
  extent_.n_vertices = mesh.position.size();
  extent_.n_triangles = mesh.triangles.size();
  extent_.n_channels = mesh.n_channels;
  if (mesh.position.empty()) return;
  extent_.low = extent_.high = mesh.position.front();
  for (const LatticePoint p : mesh.position) {
    extent_.low = {std::min(extent_.low.x, p.x), std::min(extent_.low.y, p.y)};
    extent_.high = {std::max(extent_.high.x, p.x), std::max(extent_.high.y, p.y)};
  }
  const auto [lowest, highest] = std::minmax_element(mesh.height.begin(), mesh.height.end());
  extent_.lowest = *lowest;
  extent_.highest = *highest;
}

void MeshSurface::for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const {
  visit_blocks<TerrainVertex>(
      mesh_.position.size(),
      [&](std::size_t v) {
        return TerrainVertex{mesh_.position[v], mesh_.height[v], mesh_.n_channels > 0 ? mesh_.colour[v] : Levels{}};
      },
      visit);
}

void MeshSurface::for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const {
  visit_blocks<std::array<std::uint64_t, 3>>(
      mesh_.triangles.size(),
      [&](std::size_t t) {
        const auto& [a, b, c] = mesh_.triangles[t];
        return std::array<std::uint64_t, 3>{a, b, c};
      },
      visit);
}

}  // namespace tinsmith
