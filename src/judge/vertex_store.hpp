#pragma once
// The vertices of a mesh, in memory as far as it goes and in a scratch file beyond.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/scratch_file.hpp"
#include "judge/plan.hpp"

namespace tinsmith {

struct PlanVertex {
  PlanPoint position;
  double height = 0;  // vertical units
};

/// Appended once, then looked up in any order: fast where numbers close to each other come together. For one
/// thread.
class VertexStore {
 public:
  /// Keeps about `memory` bytes of vertices; the rest is in a scratch file in the folder, made when needed.
  VertexStore(std::uint64_t memory, std::string folder);

  /// Throws OutputError or ResourceError when the scratch file fails; ResourceError beyond 2^32 - 1 vertices.
  void append(const PlanVertex& vertex);
  std::uint64_t size() const { return size_; }
  /// Frees the memory and the file; the size stays.
  void clear();

  /// For i < size(). May throw ResourceError.
  const PlanVertex& at(std::uint32_t i) {
    const Page& page = pages_[i / kPageSize];
    return page.vertices ? page.vertices[i % kPageSize] : load(i / kPageSize)[i % kPageSize];
  }

 private:
  static constexpr std::size_t kPageSize = 2048;  // vertices
  struct Page {
    std::unique_ptr<PlanVertex[]> vertices;  // null: in the file only
    std::optional<std::uint64_t> place;      // in the file
  };
  void make_room();
  const PlanVertex* load(std::size_t page);

  std::uint64_t size_ = 0;
  std::size_t most_loaded_;
  std::string folder_;
  std::vector<Page> pages_;
  std::deque<std::size_t> loaded_;  // pages, the oldest first
  std::optional<ScratchFile> scratch_;
};

}  // namespace tinsmith
