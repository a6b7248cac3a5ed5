#include "judge/vertex_store.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::size_t kFewestPages = 3;  // one for each corner of a triangle

}  // namespace

VertexStore::VertexStore(std::uint64_t memory, std::string folder)
    : most_loaded_(std::max<std::size_t>(kFewestPages, memory / (kPageSize * sizeof(PlanVertex)))),
      folder_(std::move(folder)) {}

void VertexStore::append(const PlanVertex& vertex) {
  if (size_ >= std::numeric_limits<std::uint32_t>::max())
    throw ResourceError("a mesh of more than 4294967295 vertices can't be verified in one piece; verify its tiles");
  if (size_ % kPageSize == 0) {
    make_room();
    loaded_.push_back(pages_.size());
    pages_.push_back({std::make_unique<PlanVertex[]>(kPageSize), {}});
  }
  pages_.back().vertices[size_++ % kPageSize] = vertex;
}

void VertexStore::clear() {
  std::vector<Page>().swap(pages_);
  loaded_.clear();
  scratch_.reset();
}

void VertexStore::make_room() {
  if (loaded_.size() < most_loaded_) return;
  Page& oldest = pages_[loaded_.front()];
  loaded_.pop_front();
  if (!oldest.place) {
    if (!scratch_) scratch_.emplace(folder_);
    oldest.place = scratch_->append(oldest.vertices.get(), kPageSize * sizeof(PlanVertex));
  }
  oldest.vertices.reset();
}

const PlanVertex* VertexStore::load(std::size_t page) {
  make_room();
  Page& wanted = pages_[page];
  wanted.vertices = std::make_unique_for_overwrite<PlanVertex[]>(kPageSize);
  scratch_->read(*wanted.place, wanted.vertices.get(), kPageSize * sizeof(PlanVertex));
  loaded_.push_back(page);
  return wanted.vertices.get();
}

}  // namespace tinsmith
