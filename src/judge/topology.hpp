#pragma once
// How the triangles of a block hang together, by their indices alone and then in plan. A block sees all triangles
// that touch it: everything about its vertices, and about edges that touch it, can be told here.

#include <cstdint>
#include <span>
#include <vector>

#include "judge/block_grid.hpp"
#include "judge/findings.hpp"
#include "judge/plan.hpp"
#include "judge/shared_parts.hpp"

namespace tinsmith {

struct Block {
  const BlockGrid& grid;
  BlockExtent extent;
  std::span<const Facet> facets;

  /// Places, vertices and edges belong to one block each.
  bool owns(const PlanPoint& p) const { return extent.holds(p); }
};

/// Runs from corner `corner % 3` of facet `corner / 3` of the block to the next corner.
using BorderEdges = std::vector<std::uint32_t>;

/// Adds non_manifold_edges (an edge is its lower vertex's block's), non_manifold_vertices, the components that lie
/// in this block only, and the others to `shared`. Gives the edges of one facet only, right for those that touch
/// the block.
BorderEdges measure_topology(const Block& block, SharedParts& shared, Findings& findings);

/// Adds t_junctions and unwelded_edges.
void measure_border(const Block& block, const BorderEdges& border, Findings& findings);

}  // namespace tinsmith
