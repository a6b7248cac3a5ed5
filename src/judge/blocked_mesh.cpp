#include "judge/blocked_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tinsmith/error.hpp"

namespace tinsmith {

BlockedMesh::BlockedMesh(const BlockGrid& grid, const GridFrame& frame, const Budget& budget)
    : grid_(grid), frame_(frame), budget_(budget), vertices_(budget.vertices, budget.folder) {}

void BlockedMesh::add_vertices(std::span<const std::array<double, 3>> vertices) {
  for (const auto& [x, y, z] : vertices) {
    vertices_.append({plan_point(frame_, x, y), z});
    largest_height_ = std::max(largest_height_, std::abs(z));
  }
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
    put(facet, bin_of(grid_.block_of(facet.position[0])));
    return;
  }
  grid_.find_blocks(facet, touched_);
  for (const BlockNumber block : touched_) put(facet, bin_of(block));
}

BlockedMesh::Bin& BlockedMesh::bin_of(BlockNumber block) {
  if (last_ == bins_.end() || last_->first != block) last_ = bins_.try_emplace(block).first;
  return last_->second;
}

void BlockedMesh::put(const Facet& facet, Bin& bin) {
  ++bin.n_facets;
  if (bin.in_memory.size() == bin.in_memory.capacity()) {
    const std::size_t grown = std::max<std::size_t>(4, bin.in_memory.size() / 2);
    if (bytes_ + grown * sizeof(Facet) > budget_.facets) spill();
    bin.in_memory.reserve(bin.in_memory.size() + grown);
    bytes_ += grown * sizeof(Facet);
  }
  bin.in_memory.push_back(facet);
}

void BlockedMesh::spill() {
  for (auto& [block, bin] : bins_) {
    if (bin.in_memory.empty()) continue;
    if (!scratch_) scratch_.emplace(budget_.folder);
    const std::uint64_t place = scratch_->append(bin.in_memory.data(), bin.in_memory.size() * sizeof(Facet));
    bin.in_file.push_back({place, bin.in_memory.size()});
    std::vector<Facet>().swap(bin.in_memory);
  }
  bytes_ = 0;
}

void BlockedMesh::close() { vertices_.clear(); }

std::vector<BlockNumber> BlockedMesh::blocks() const {
  std::vector<BlockNumber> blocks;
  blocks.reserve(bins_.size());
  for (const auto& [block, bin] : bins_) blocks.push_back(block);
  return blocks;
}

std::size_t BlockedMesh::n_facets(BlockNumber block) const {
  const auto found = bins_.find(block);
  return found == bins_.end() ? 0 : found->second.n_facets;
}

std::vector<Facet> BlockedMesh::take(BlockNumber block) {
  const auto found = bins_.find(block);
  if (found == bins_.end()) return {};
  Bin& bin = found->second;
  if (bin.in_file.empty()) return std::exchange(bin.in_memory, {});
  std::vector<Facet> facets(bin.n_facets);
  Facet* next = facets.data();
  for (const Piece& piece : bin.in_file) {
    scratch_->read(piece.place, next, piece.n_facets * sizeof(Facet));
    next += piece.n_facets;
  }
  std::copy(bin.in_memory.begin(), bin.in_memory.end(), next);
  bin = {};
  return facets;
}

}  // namespace tinsmith
