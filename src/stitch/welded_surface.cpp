#include "stitch/welded_surface.hpp"

#include <algorithm>
#include <utility>

#include "base/check.hpp"

namespace tinsmith {

namespace {

constexpr std::size_t kBlock = 4096;

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// splitmix64: neighbouring numbers to numbers that have nothing to do with each other.
std::uint64_t mix(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

// Which vertices lie on the border of a chunk: those whose triangles do not close around them. Each triangle adds
// the neighbour after and takes away the neighbour before: in a closed fan nothing is left.
std::vector<std::uint8_t> border_of(const Chunk& chunk) {
  std::vector<std::uint64_t> name(chunk.position.size());
  for (std::size_t v = 0; v < name.size(); ++v) name[v] = mix(v);
  std::vector<std::uint64_t> sum(chunk.position.size(), 0);
  for (const auto& [a, b, c] : chunk.triangles) {
    sum[at(a)] += name[at(b)] - name[at(c)];
    sum[at(b)] += name[at(c)] - name[at(a)];
    sum[at(c)] += name[at(a)] - name[at(b)];
  }
  std::vector<std::uint8_t> is_border(sum.size());
  std::transform(sum.begin(), sum.end(), is_border.begin(), [](std::uint64_t s) { return s != 0 ? 1 : 0; });
  return is_border;
}

using Edge = std::pair<std::int32_t, std::int32_t>;

// The edges of one triangle only, in the direction in which it has them.
std::vector<Edge> border_edges(const Chunk& chunk, const std::vector<std::uint8_t>& is_border) {
  std::vector<Edge> edges;
  for (const auto& triangle : chunk.triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge edge{triangle[k], triangle[(k + 1) % 3]};
      if (is_border[at(edge.first)] && is_border[at(edge.second)]) edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> border;
  for (const Edge& edge : edges) {
    if (!std::binary_search(edges.begin(), edges.end(), Edge{edge.second, edge.first})) border.push_back(edge);
  }
  return border;
}

}  // namespace

std::size_t WeldedSurface::PlaceHash::operator()(LatticePoint p) const {
  return mix(static_cast<std::uint64_t>(static_cast<std::uint32_t>(p.x)) << 32 | static_cast<std::uint32_t>(p.y));
}

WeldedSurface::WeldedSurface(const WindowGraph& graph, ChunkOf chunk_of, int n_channels)
    : graph_(graph), chunk_of_(std::move(chunk_of)) {
  extent_.n_channels = n_channels;
}

void WeldedSurface::add_next() {
  const WindowGrid& windows = graph_.windows(graph_.last_round());
  const std::int64_t window = n_added_++;
  if (const auto chunk = chunk_of_(window)) {
    const std::vector<std::uint8_t> is_border = border_of(*chunk);
    std::map<std::int32_t, Fan> fans;
    for (const auto& [from, to] : border_edges(*chunk, is_border)) {
      fans[from].first = chunk->position[at(to)];
      fans[to].last = chunk->position[at(from)];
    }
    for (auto& [vertex, fan] : fans) {
      fan.window = window;
      fan.vertex = vertex;
      open_[chunk->position[at(vertex)]].push_back(fan);
    }
    if (extent_.n_triangles == 0) {
      extent_.low = extent_.high = chunk->position.front();
      extent_.lowest = extent_.highest = chunk->height.front();
    }
    extent_.n_triangles += chunk->triangles.size();
    extent_.n_vertices += chunk->position.size() - fans.size();  // those on the border count when they close
    for (std::size_t v = 0; v < chunk->position.size(); ++v) {
      const LatticePoint p = chunk->position[v];
      extent_.low = {std::min(extent_.low.x, p.x), std::min(extent_.low.y, p.y)};
      extent_.high = {std::max(extent_.high.x, p.x), std::max(extent_.high.y, p.y)};
      extent_.lowest = std::min(extent_.lowest, chunk->height[v]);
      extent_.highest = std::max(extent_.highest, chunk->height[v]);
    }
  }
  if (n_added_ % windows.columns == 0) close_places_before(n_added_ / windows.columns);
}

void WeldedSurface::close_places_before(std::int64_t window_row) {
  const bool is_end = window_row == graph_.windows(graph_.last_round()).rows;
  const std::int64_t first = is_end ? 0 : graph_.first_row_reached(window_row) * kLatticePerCell;
  std::erase_if(open_, [&](const auto& open) {
    if (!is_end && open.first.y >= first) return false;
    close(open.second);
    return true;
  });
}

// All fans at a place are known. Those that share an edge are one.
void WeldedSurface::close(const std::vector<Fan>& fans) {
  ++extent_.n_vertices;
  std::vector<std::int32_t> group(fans.size(), -1);
  std::int32_t n_groups = 0;
  for (std::size_t start = 0; start < fans.size(); ++start) {
    if (group[start] >= 0) continue;
    std::vector<std::size_t> reached{start};
    group[start] = n_groups;
    while (!reached.empty()) {
      const Fan fan = fans[reached.back()];
      reached.pop_back();
      for (std::size_t i = 0; i < fans.size(); ++i) {
        if (group[i] >= 0 || (fans[i].first != fan.last && fans[i].last != fan.first)) continue;
        group[i] = n_groups;
        reached.push_back(i);
      }
    }
    ++n_groups;
  }
  extent_.n_vertices += static_cast<std::uint64_t>(n_groups - 1);
  for (std::size_t i = 0; i < fans.size(); ++i) {
    if (group[i] > 0) pinches_[{fans[i].window, fans[i].vertex}] = group[i];
  }
}

// Calls visit(chunk, numbers of its vertices, which of them are new) for every chunk in its turn.
template <class Visit>
void WeldedSurface::for_each_numbered(Visit visit) const {
  const WindowGrid& windows = graph_.windows(graph_.last_round());
  TINSMITH_ASSERT(n_added_ == windows.count());
  std::unordered_map<LatticePoint, std::map<std::int32_t, std::uint64_t>, PlaceHash> open;
  std::vector<std::uint64_t> numbers;
  std::vector<std::uint8_t> is_new;
  std::uint64_t next = 0;
  for (std::int64_t window = 0; window < windows.count(); ++window) {
    if (window % windows.columns == 0) {
      const std::int64_t first = graph_.first_row_reached(window / windows.columns) * kLatticePerCell;
      std::erase_if(open, [&](const auto& place) { return place.first.y < first; });
    }
    const auto chunk = chunk_of_(window);
    if (!chunk) continue;
    const std::vector<std::uint8_t> is_border = border_of(*chunk);
    numbers.assign(is_border.size(), 0);
    is_new.assign(is_border.size(), 1);
    for (std::size_t v = 0; v < is_border.size(); ++v) {
      if (is_border[v]) {
        const auto pinch = pinches_.find({window, static_cast<std::int32_t>(v)});
        const auto [known, is_first] =
            open[chunk->position[v]].try_emplace(pinch == pinches_.end() ? 0 : pinch->second, next);
        numbers[v] = known->second;
        is_new[v] = is_first ? 1 : 0;
      } else {
        numbers[v] = next;
      }
      next += is_new[v];
    }
    visit(*chunk, numbers, is_new);
  }
}

void WeldedSurface::for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const {
  std::vector<TerrainVertex> block;
  for_each_numbered([&](const Chunk& chunk, const auto&, const std::vector<std::uint8_t>& is_new) {
    for (std::size_t v = 0; v < is_new.size(); ++v) {
      if (!is_new[v]) continue;
      block.push_back({chunk.position[v], chunk.height[v], chunk.colour.empty() ? Levels{} : chunk.colour[v]});
    }
    if (block.size() < kBlock) return;
    visit(block);
    block.clear();
  });
  if (!block.empty()) visit(block);
}

void WeldedSurface::for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const {
  std::vector<std::array<std::uint64_t, 3>> block;
  for_each_numbered([&](const Chunk& chunk, const std::vector<std::uint64_t>& numbers, const auto&) {
    for (const auto& [a, b, c] : chunk.triangles) block.push_back({numbers[at(a)], numbers[at(b)], numbers[at(c)]});
    if (block.size() < kBlock) return;
    visit(block);
    block.clear();
  });
  if (!block.empty()) visit(block);
}

TerrainMesh mesh_of(const TerrainSurface& surface) {
  TerrainMesh mesh;
  mesh.n_channels = surface.extent().n_channels;
  mesh.position.reserve(surface.extent().n_vertices);
  mesh.height.reserve(surface.extent().n_vertices);
  mesh.triangles.reserve(surface.extent().n_triangles);
  surface.for_each_vertex_block([&](TerrainSurface::VertexBlock block) {
    for (const TerrainVertex& vertex : block) {
      mesh.position.push_back(vertex.position);
      mesh.height.push_back(vertex.height);
      if (mesh.n_channels > 0) mesh.colour.push_back(vertex.colour);
    }
  });
  surface.for_each_triangle_block([&](TerrainSurface::TriangleBlock block) {
    for (const auto& [a, b, c] : block)
      mesh.triangles.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  });
  return mesh;
}

}  // namespace tinsmith
