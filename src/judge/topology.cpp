#include "judge/topology.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <span>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

/// Union-find; the smallest member stands for its set.
class Sets {
 public:
  explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0U); }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t i, std::uint32_t j) {
    const auto [low, high] = std::minmax({find(i), find(j)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

std::uint32_t next_corner(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }

std::uint32_t vertex_at(const PlanMesh& mesh, std::uint32_t corner) {
  return mesh.triangles[corner / 3][corner % 3];
}

/// A triangle's use of an edge, from the corner to the next one, kept with the edge's lower vertex.
struct EdgeUse {
  std::uint32_t high_vertex;
  std::uint32_t corner;

  friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
    return a.high_vertex != b.high_vertex ? a.high_vertex < b.high_vertex : a.corner < b.corner;
  }
};

/// All uses of edges, those of one lower vertex together and sorted.
struct EdgeUses {
  std::vector<std::size_t> start;  // of each lower vertex, and the end
  std::vector<EdgeUse> uses;
};

template <class Visit>
void for_each_use(const PlanMesh& mesh, Visit visit) {
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    const std::uint32_t from = vertex_at(mesh, corner);
    const std::uint32_t to = vertex_at(mesh, next_corner(corner));
    if (from != to) visit(std::min(from, to), EdgeUse{std::max(from, to), corner});
  }
}

EdgeUses sort_uses(const PlanMesh& mesh) {
  EdgeUses sorted;
  sorted.start.assign(mesh.position.size() + 2, 0);
  for_each_use(mesh, [&](std::uint32_t low, EdgeUse) { ++sorted.start[low + 2]; });
  std::partial_sum(sorted.start.begin(), sorted.start.end(), sorted.start.begin());
  sorted.uses.resize(sorted.start.back());
  // The start of `low` moves from place low + 1 up to where that of low + 1 belongs.
  for_each_use(mesh, [&](std::uint32_t low, EdgeUse use) { sorted.uses[sorted.start[low + 1]++] = use; });
  for (std::size_t low = 0; low < mesh.position.size(); ++low)
    std::sort(sorted.uses.begin() + static_cast<std::ptrdiff_t>(sorted.start[low]),
              sorted.uses.begin() + static_cast<std::ptrdiff_t>(sorted.start[low + 1]));
  return sorted;
}

/// What the edges, taken one by one, say about the whole.
struct Connections {
  explicit Connections(const PlanMesh& mesh)
      : triangles(mesh.triangles.size()), corners(3 * mesh.triangles.size()) {}
  Sets triangles;  // connected by edges
  Sets corners;    // of one vertex, connected by edges: the fans
  BorderEdges border;
  std::uint64_t n_non_manifold = 0;
};

void connect(const PlanMesh& mesh, std::span<const EdgeUse> edge, Connections& connections) {
  const auto runs_up = [&](EdgeUse use) { return vertex_at(mesh, use.corner) != use.high_vertex; };
  const auto low_corner = [&](EdgeUse use) { return runs_up(use) ? use.corner : next_corner(use.corner); };
  const auto high_corner = [&](EdgeUse use) { return runs_up(use) ? next_corner(use.corner) : use.corner; };
  if (edge.size() == 1) connections.border.push_back(edge[0].corner);
  if (edge.size() > 2 || (edge.size() == 2 && runs_up(edge[0]) == runs_up(edge[1]))) ++connections.n_non_manifold;
  for (const EdgeUse& use : edge.subspan(1)) {
    connections.triangles.unite(edge[0].corner / 3, use.corner / 3);
    connections.corners.unite(low_corner(edge[0]), low_corner(use));
    connections.corners.unite(high_corner(edge[0]), high_corner(use));
  }
}

void connect_all(const PlanMesh& mesh, Connections& connections) {
  const EdgeUses sorted = sort_uses(mesh);
  for (std::size_t low = 0; low < mesh.position.size(); ++low) {
    const std::size_t end = sorted.start[low + 1];
    for (std::size_t i = sorted.start[low]; i < end;) {
      std::size_t j = i + 1;
      while (j < end && sorted.uses[j].high_vertex == sorted.uses[i].high_vertex) ++j;
      connect(mesh, {&sorted.uses[i], j - i}, connections);
      i = j;
    }
  }
}

std::uint64_t count_vertices_of_several_fans(const PlanMesh& mesh, Sets& corners) {
  std::vector<std::uint8_t> n_fans(mesh.position.size(), 0);
  std::uint64_t n_vertices = 0;
  for (std::uint32_t corner = 0; corner < 3 * mesh.triangles.size(); ++corner) {
    std::uint8_t& n = n_fans[vertex_at(mesh, corner)];
    if (corners.find(corner) != corner || n == 2) continue;
    if (++n == 2) ++n_vertices;
  }
  return n_vertices;
}

}  // namespace

BorderEdges measure_topology(const PlanMesh& mesh, Certificate& certificate) {
  if (mesh.triangles.size() > std::numeric_limits<std::uint32_t>::max() / 3)
    throw ResourceError(
        "a mesh of more than 1431655765 triangles can't be verified in one piece; verify its tiles");
  Connections connections(mesh);
  connect_all(mesh, connections);
  certificate.non_manifold_edges = connections.n_non_manifold;
  certificate.non_manifold_vertices = count_vertices_of_several_fans(mesh, connections.corners);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (connections.triangles.find(t) == t) ++certificate.components;
  return std::move(connections.border);
}

}  // namespace tinsmith
