#include "judge/topology.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "judge/sets.hpp"

namespace tinsmith {
namespace {

std::uint32_t next_corner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::uint32_t vertex_at(const Block& block, std::uint32_t corner) {
  return block.facets[corner / 3].vertices[corner % 3];
}

const PlanPoint& place_at(const Block& block, std::uint32_t corner) {
  return block.facets[corner / 3].position[corner % 3];
}

std::uint32_t n_corners(const Block& block) { return static_cast<std::uint32_t>(3 * block.facets.size()); }

/// A facet's use of an edge, from the corner to the next one.
struct EdgeUse {
  std::uint32_t low_vertex;
  std::uint32_t high_vertex;
  std::uint32_t corner;

  std::uint64_t edge() const { return std::uint64_t{low_vertex} << 32U | high_vertex; }
  friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
    return a.edge() != b.edge() ? a.edge() < b.edge() : a.corner < b.corner;
  }
};

/// All uses of edges, in bins by the lower vertex; sorted within a bin, so that those of one edge are together.
struct EdgeUses {
  std::vector<std::uint32_t> start;  // of each bin, and the end
  std::vector<EdgeUse> uses;
};

template <class Visit>
void for_each_use(const Block& block, Visit visit) {
  for (std::uint32_t corner = 0; corner < n_corners(block); ++corner) {
    const std::uint32_t from = vertex_at(block, corner);
    const std::uint32_t to = vertex_at(block, next_corner(corner));
    if (from != to) visit(EdgeUse{std::min(from, to), std::max(from, to), corner});
  }
}

/// A block holds few of a mesh's vertices, with numbers from everywhere: about one bin for each of them.
EdgeUses sort_uses(const Block& block) {
  const std::size_t mask = std::bit_ceil(block.facets.size() + 1) - 1;
  EdgeUses sorted;
  sorted.start.assign(mask + 3, 0);
  for_each_use(block, [&](const EdgeUse& use) { ++sorted.start[(use.low_vertex & mask) + 2]; });
  std::partial_sum(sorted.start.begin(), sorted.start.end(), sorted.start.begin());
  sorted.uses.resize(sorted.start.back());
  // The start of `bin` moves from place bin + 1 up to where that of bin + 1 belongs.
  for_each_use(block, [&](const EdgeUse& use) { sorted.uses[sorted.start[(use.low_vertex & mask) + 1]++] = use; });
  for (std::size_t bin = 0; bin <= mask; ++bin)
    std::sort(sorted.uses.begin() + sorted.start[bin], sorted.uses.begin() + sorted.start[bin + 1]);
  return sorted;
}

/// What the edges, taken one by one, say about the whole.
struct Connections {
  explicit Connections(const Block& block) : facets(block.facets.size()), corners(n_corners(block)) {}
  Sets facets;   // connected by edges
  Sets corners;  // of one vertex, connected by edges: the fans
  BorderEdges border;
  std::uint64_t n_non_manifold = 0;
};

void connect(const Block& block, std::span<const EdgeUse> edge, Connections& connections) {
  const auto runs_up = [&](const EdgeUse& use) { return vertex_at(block, use.corner) == use.low_vertex; };
  const auto low_corner = [&](const EdgeUse& use) { return runs_up(use) ? use.corner : next_corner(use.corner); };
  const auto high_corner = [&](const EdgeUse& use) { return runs_up(use) ? next_corner(use.corner) : use.corner; };
  if (edge.size() == 1) connections.border.push_back(edge[0].corner);
  if (edge.size() > 2 || (edge.size() == 2 && runs_up(edge[0]) == runs_up(edge[1])))
    connections.n_non_manifold += block.owns(place_at(block, low_corner(edge[0])));
  for (const EdgeUse& use : edge.subspan(1)) {
    connections.facets.unite(edge[0].corner / 3, use.corner / 3);
    connections.corners.unite(low_corner(edge[0]), low_corner(use));
    connections.corners.unite(high_corner(edge[0]), high_corner(use));
  }
}

void connect_all(const Block& block, Connections& connections) {
  const std::vector<EdgeUse> uses = std::move(sort_uses(block).uses);
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].edge() == uses[i].edge()) ++j;
    connect(block, {&uses[i], j - i}, connections);
    i = j;
  }
}

/// Of those that the block owns.
std::uint64_t count_vertices_of_several_fans(const Block& block, Sets& corners) {
  std::vector<std::uint32_t> fans;  // one entry for each fan: its vertex
  for (std::uint32_t corner = 0; corner < n_corners(block); ++corner)
    if (corners.find(corner) == corner && block.owns(place_at(block, corner)))
      fans.push_back(vertex_at(block, corner));
  std::sort(fans.begin(), fans.end());
  std::uint64_t n = 0;
  for (std::size_t i = 1; i < fans.size(); ++i)
    n += fans[i] == fans[i - 1] && (i == 1 || fans[i - 1] != fans[i - 2]);
  return n;
}

void add_components(const Block& block, Sets& parts, SharedParts& shared, Findings& findings) {
  std::vector<SharedParts::Member> members;
  std::vector<std::uint8_t> is_shared(block.facets.size(), 0);  // by what stands for the part
  for (std::uint32_t f = 0; f < block.facets.size(); ++f) {
    if (block.grid.is_in_one_block(block.facets[f])) continue;
    members.push_back({f, parts.find(f)});
    is_shared[members.back().part] = 1;
  }
  shared.add(block.grid, block.facets, members);
  for (std::uint32_t f = 0; f < block.facets.size(); ++f)
    if (parts.find(f) == f && !is_shared[f]) ++findings.counts.components;
}

}  // namespace

BorderEdges measure_topology(const Block& block, SharedParts& shared, Findings& findings) {
  Connections connections(block);
  connect_all(block, connections);
  findings.counts.non_manifold_edges += connections.n_non_manifold;
  findings.counts.non_manifold_vertices += count_vertices_of_several_fans(block, connections.corners);
  add_components(block, connections.facets, shared, findings);
  return std::move(connections.border);
}

}  // namespace tinsmith
