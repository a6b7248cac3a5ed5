#include "tile/chunk.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <utility>

namespace tinsmith {

namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// Some triangles of a chunk or mesh, with the vertices that they use, renumbered in the order of their first use.
template <class Vertices>
class Extract {
 public:
  explicit Extract(const Vertices& from) : from_(from), name_(from.position.size(), kNone) {}

  void reserve(std::size_t n_triangles) { part_.triangles.reserve(n_triangles); }

  void add(const std::array<std::int32_t, 3>& triangle) {
    part_.triangles.push_back({name(triangle[0]), name(triangle[1]), name(triangle[2])});
  }

  Chunk take() {
    for (const std::int32_t v : used_) name_[at(v)] = kNone;
    used_.clear();
    return std::exchange(part_, {});
  }

 private:
  std::int32_t name(std::int32_t v) {
    if (name_[at(v)] == kNone) {
      name_[at(v)] = static_cast<std::int32_t>(used_.size());
      used_.push_back(v);
      part_.position.push_back(from_.position[at(v)]);
      part_.height.push_back(from_.height[at(v)]);
      part_.is_settled.push_back(from_.is_settled[at(v)]);
      if (!from_.colour.empty()) part_.colour.push_back(from_.colour[at(v)]);
    }
    return name_[at(v)];
  }

  const Vertices& from_;
  std::vector<std::int32_t> name_;  // by vertex
  std::vector<std::int32_t> used_;
  Chunk part_;
};

// Settled is from now on what is free and has free neighbours only.
void settle(WindowMesh& mesh) {
  std::vector<std::uint8_t> is_near_locked(mesh.position.size(), 0);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); ++h) {
    if (mesh.origin[at(h)] == kNone || mesh.kind[at(mesh.origin[at(h)])] != VertexKind::kLocked) continue;
    is_near_locked[at(mesh.origin[at(h)])] = 1;
    is_near_locked[at(mesh.destination(h))] = 1;
    is_near_locked[at(mesh.origin[at(WindowMesh::previous(h))])] = 1;
  }
  for (std::size_t v = 0; v < is_near_locked.size(); ++v) {
    if (!is_near_locked[v]) mesh.is_settled[v] = 1;
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

Chunk chunk_of(WindowMesh&& mesh) {
  settle(mesh);
  Extract extract(mesh);
  const auto n_removed = std::count(mesh.origin.begin(), mesh.origin.end(), kNone);
  extract.reserve((mesh.origin.size() - static_cast<std::size_t>(n_removed)) / 3);
  for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
    if (mesh.origin[at(h)] != kNone)
      extract.add({mesh.origin[at(h)], mesh.origin[at(h + 1)], mesh.origin[at(h + 2)]});
  }
  return extract.take();
}

std::vector<ChunkPart> split(const Chunk& chunk, const WindowGrid& windows) {
  std::map<std::int64_t, std::vector<std::int32_t>> triangles_of;
  for (std::size_t t = 0; t < chunk.triangles.size(); ++t) {
    const auto& [a, b, c] = chunk.triangles[t];
    triangles_of[windows.window_of(chunk.position[at(a)], chunk.position[at(b)], chunk.position[at(c)])].push_back(
        static_cast<std::int32_t>(t));
  }
  std::vector<ChunkPart> parts;
  Extract extract(chunk);
  for (const auto& [window, triangles] : triangles_of) {
    for (const std::int32_t t : triangles) extract.add(chunk.triangles[at(t)]);
    parts.push_back({window, extract.take()});
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
