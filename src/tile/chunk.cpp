#include "tile/chunk.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// The vertices that some triangles of a chunk use, renumbered in the order of their first use.
class Extract {
 public:
  explicit Extract(const Chunk& from) : from_(from), name_(from.position.size(), kNone) {}

  Chunk operator()(const std::vector<std::int32_t>& triangles) {
    Chunk part;
    part.triangles.reserve(triangles.size());
    for (const std::int32_t t : triangles) {
      std::array<std::int32_t, 3> renamed{};
      for (std::size_t k = 0; k < 3; ++k) renamed[k] = name(part, from_.triangles[at(t)][k]);
      part.triangles.push_back(renamed);
    }
    for (const std::int32_t t : triangles) {
      for (const std::int32_t v : from_.triangles[at(t)]) name_[at(v)] = kNone;
    }
    return part;
  }

 private:
  std::int32_t name(Chunk& part, std::int32_t v) {
    if (name_[at(v)] == kNone) {
      name_[at(v)] = static_cast<std::int32_t>(part.position.size());
      part.position.push_back(from_.position[at(v)]);
      part.height.push_back(from_.height[at(v)]);
      part.is_settled.push_back(from_.is_settled[at(v)]);
      if (!from_.colour.empty()) part.colour.push_back(from_.colour[at(v)]);
    }
    return name_[at(v)];
  }

  const Chunk& from_;
  std::vector<std::int32_t> name_;
};

// Settled is from now on what is free and has free neighbours only.
void settle(std::vector<std::uint8_t>& is_settled, const WindowMesh& mesh) {
  std::vector<std::uint8_t> is_near_locked(mesh.position.size(), 0);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[at(h)] == kNone || mesh.kind[at(mesh.origin[at(h)])] != VertexKind::kLocked) continue;
    is_near_locked[at(mesh.origin[at(h)])] = 1;
    is_near_locked[at(mesh.destination(h))] = 1;
    is_near_locked[at(mesh.origin[at(WindowMesh::previous(h))])] = 1;
  }
  for (std::size_t v = 0; v < is_settled.size(); ++v) {
    if (!is_near_locked[v]) is_settled[v] = 1;
  }
}

}  // namespace

WindowMesh mesh_of(Chunk&& chunk) {
  WindowMesh mesh;
  mesh.position = std::move(chunk.position);
  mesh.height = std::move(chunk.height);
  mesh.is_settled = std::move(chunk.is_settled);
  mesh.colour = std::move(chunk.colour);
  connect(mesh, chunk.triangles);
  return mesh;
}

Chunk chunk_of(const WindowMesh& mesh) {
  Chunk all{mesh.position, mesh.height, mesh.is_settled, {}, mesh.colour};
  settle(all.is_settled, mesh);
  std::vector<std::int32_t> live;
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    if (mesh.origin[at(h)] == kNone) continue;
    live.push_back(static_cast<std::int32_t>(all.triangles.size()));
    all.triangles.push_back({mesh.origin[at(h)], mesh.origin[at(h + 1)], mesh.origin[at(h + 2)]});
  }
  return Extract(all)(live);
}

std::vector<ChunkPart> split(const Chunk& chunk, const WindowGrid& windows) {
  std::vector<std::pair<std::int64_t, std::int32_t>> owner;
  owner.reserve(chunk.triangles.size());
  for (std::size_t t = 0; t < chunk.triangles.size(); ++t) {
    const auto& [a, b, c] = chunk.triangles[t];
    owner.emplace_back(windows.window_of(chunk.position[at(a)], chunk.position[at(b)], chunk.position[at(c)]),
                       static_cast<std::int32_t>(t));
  }
  std::sort(owner.begin(), owner.end());
  std::vector<ChunkPart> parts;
  Extract extract(chunk);
  for (std::size_t i = 0; i < owner.size();) {
    const std::int64_t window = owner[i].first;
    std::vector<std::int32_t> triangles;
    for (; i < owner.size() && owner[i].first == window; ++i) triangles.push_back(owner[i].second);
    parts.push_back({window, extract(triangles)});
  }
  return parts;
}

Chunk weld(const std::vector<const Chunk*>& parts) {
  struct Entry {
    LatticePoint position;
    std::int32_t part;
    std::int32_t vertex;
  };
  std::vector<Entry> entries;
  std::size_t n_triangles = 0;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (std::size_t v = 0; v < parts[p]->position.size(); ++v)
      entries.push_back({parts[p]->position[v], static_cast<std::int32_t>(p), static_cast<std::int32_t>(v)});
    n_triangles += parts[p]->triangles.size();
  }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.position != b.position ? a.position < b.position
                                    : std::pair(a.part, a.vertex) < std::pair(b.part, b.vertex);
  });
  Chunk whole;
  std::vector<std::vector<std::int32_t>> name(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) name[p].resize(parts[p]->position.size());
  for (const Entry& e : entries) {
    const Chunk& part = *parts[at(e.part)];
    if (whole.position.empty() || whole.position.back() != e.position) {
      whole.position.push_back(e.position);
      whole.height.push_back(part.height[at(e.vertex)]);
      whole.is_settled.push_back(part.is_settled[at(e.vertex)]);
      if (!part.colour.empty()) whole.colour.push_back(part.colour[at(e.vertex)]);
    }
    name[at(e.part)][at(e.vertex)] = static_cast<std::int32_t>(whole.position.size()) - 1;
  }
  whole.triangles.reserve(n_triangles);
  for (std::size_t p = 0; p < parts.size(); ++p) {
    for (const auto& [a, b, c] : parts[p]->triangles)
      whole.triangles.push_back({name[p][at(a)], name[p][at(b)], name[p][at(c)]});
  }
  return whole;
}

}  // namespace tinsmith
