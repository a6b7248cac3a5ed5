#include "judge/blocked_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "tinsmith/error.hpp"

namespace tinsmith {

// Colours have budgets of their own, smaller than those of places as they are smaller themselves.
BlockedMesh::BlockedMesh(const BlockGrid& grid, const GridFrame& frame, const Budget& budget)
    : grid_(grid),
      frame_(frame),
      vertices_(budget.vertices, budget.folder),
      colours_(budget.vertices / sizeof(PlanVertex) * sizeof(VertexColour), budget.folder),
      facets_(budget.facets, budget.folder),
      facet_colours_(budget.facets / sizeof(Facet) * sizeof(FacetColours), budget.folder) {}

void BlockedMesh::add_vertices(std::span<const std::array<double, 3>> vertices) {
  for (const auto& [x, y, z] : vertices) {
    vertices_.append({plan_point(frame_, x, y), z});
    largest_height_ = std::max(largest_height_, std::abs(z));
  }
}

void BlockedMesh::add_colours(std::span<const VertexColour> colours) {
  for (const VertexColour& colour : colours) colours_.append(colour);
}

void BlockedMesh::add_triangle(const std::array<std::uint64_t, 3>& triangle) {
  if (n_triangles_ >= std::numeric_limits<std::uint32_t>::max())
    throw ResourceError(
        "a mesh of more than 4294967295 triangles can't be verified in one piece; verify its tiles");
  Facet facet;
  facet.number = static_cast<std::uint32_t>(n_triangles_++);
  for (std::size_t k = 0; k < 3; ++k) {
    facet.vertices[k] = static_cast<std::uint32_t>(triangle[k]);
    const PlanVertex& vertex = vertices_.at(facet.vertices[k]);
    facet.position[k] = vertex.position;
    facet.height[k] = vertex.height;
  }
  if (grid_.is_in_one_block(facet)) {
    touched_.assign(1, grid_.block_of(facet.position[0]));
  } else {
    grid_.find_blocks(facet, touched_);
  }
  for (const BlockNumber block : touched_) facets_.put(block, facet);
  if (!has_colours()) return;
  FacetColours colours;
  for (std::size_t k = 0; k < 3; ++k) colours[k] = colours_.at(facet.vertices[k]);
  for (const BlockNumber block : touched_) facet_colours_.put(block, colours);
}

void BlockedMesh::close() {
  vertices_.clear();
  colours_.clear();
  facets_.finish();
  facet_colours_.finish();
}

}  // namespace tinsmith
