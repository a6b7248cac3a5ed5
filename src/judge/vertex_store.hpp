#pragma once
// What a mesh has by vertex, in memory as far as it goes and in a scratch file beyond.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/scratch_file.hpp"
#include "judge/plan.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

struct PlanVertex {
  PlanPoint position;
  double height = 0;  // vertical units
};

/// Plain data T, appended once, then looked up in any order: fast where numbers close to each other come together.
/// For one thread.
template <class T>
class VertexStore {
 public:
  /// Keeps about `memory` bytes of vertices; the rest is in a scratch file in the folder, made when needed.
  VertexStore(std::uint64_t memory, std::string folder)
      : most_loaded_(std::max<std::size_t>(kFewestPages, memory / (kPageSize * sizeof(T)))),
        folder_(std::move(folder)) {}

  /// Throws OutputError or ResourceError when the scratch file fails; ResourceError beyond 2^32 - 1 vertices.
  void append(const T& vertex) {
    if (size_ >= std::numeric_limits<std::uint32_t>::max())
      throw ResourceError(
          "a mesh of more than 4294967295 vertices can't be verified in one piece; verify its tiles");
    if (size_ % kPageSize == 0) {
      make_room();
      loaded_.push_back(pages_.size());
      pages_.emplace_back().vertices = std::make_unique<T[]>(kPageSize);
    }
    pages_.back().vertices[size_++ % kPageSize] = vertex;
  }

  std::uint64_t size() const { return size_; }

  /// Frees the memory and the file; the size stays.
  void clear() {
    std::vector<Page>().swap(pages_);
    loaded_.clear();
    scratch_.reset();
  }

  /// For i < size(). May throw ResourceError.
  const T& at(std::uint32_t i) {
    const Page& page = pages_[i / kPageSize];
    return page.vertices ? page.vertices[i % kPageSize] : load(i / kPageSize)[i % kPageSize];
  }

 private:
  static constexpr std::size_t kPageSize = 2048;  // vertices
  static constexpr std::size_t kFewestPages = 3;  // one for each corner of a triangle
  struct Page {
    std::unique_ptr<T[]> vertices;       // null: in the file only
    std::optional<std::uint64_t> place;  // in the file
  };

  void make_room() {
    if (loaded_.size() < most_loaded_) return;
    Page& oldest = pages_[loaded_.front()];
    loaded_.pop_front();
    if (!oldest.place) {
      if (!scratch_) scratch_.emplace(folder_);
      oldest.place = scratch_->append(oldest.vertices.get(), kPageSize * sizeof(T));
    }
    oldest.vertices.reset();
  }

  const T* load(std::size_t page) {
    make_room();
    Page& wanted = pages_[page];
    wanted.vertices = std::make_unique_for_overwrite<T[]>(kPageSize);
    scratch_->read(*wanted.place, wanted.vertices.get(), kPageSize * sizeof(T));
    loaded_.push_back(page);
    return wanted.vertices.get();
  }

  std::uint64_t size_ = 0;
  std::size_t most_loaded_;
  std::string folder_;
  std::vector<Page> pages_;
  std::deque<std::size_t> loaded_;  // pages, the oldest first
  std::optional<ScratchFile> scratch_;
};

}  // namespace tinsmith
