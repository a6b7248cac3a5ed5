#pragma once
// Elements sorted into blocks, within a budget of memory: what is more goes to a scratch file.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/scratch_file.hpp"
#include "judge/block_grid.hpp"

namespace tinsmith {

/// T is plain data. Filled by one thread; then several threads may take different blocks.
template <class T>
class BlockBins {
 public:
  /// Keeps about `memory` bytes; the scratch file is made in the folder when it is needed.
  BlockBins(std::uint64_t memory, std::string folder) : memory_(memory), folder_(std::move(folder)) {}

  void put(BlockNumber block, const T& element) {
    Bin& bin = bin_of(block);
    ++bin.n;
    if (bin.in_memory.size() == bin.in_memory.capacity()) {
      const std::size_t grown = std::max<std::size_t>(4, bin.in_memory.size() / 2);
      if (bytes_ + grown * sizeof(T) > memory_) spill();
      bin.in_memory.reserve(bin.in_memory.size() + grown);
      bytes_ += grown * sizeof(T);
    }
    bin.in_memory.push_back(element);
  }

  /// After the last element: when some are in the file all are, so that what is held while blocks are taken does
  /// not depend on how many elements there were.
  void finish() {
    if (scratch_) spill();
  }

  /// The memory that elements take, in bytes, before the first are taken.
  std::uint64_t held() const { return bytes_; }

  /// The blocks with elements, in their order.
  std::vector<BlockNumber> blocks() const {
    std::vector<BlockNumber> blocks;
    blocks.reserve(bins_.size());
    for (const auto& [block, bin] : bins_) blocks.push_back(block);
    return blocks;
  }

  std::size_t count(BlockNumber block) const {
    const auto found = bins_.find(block);
    return found == bins_.end() ? 0 : found->second.n;
  }

  /// The elements of a block in the order in which they were put; they are forgotten here.
  std::vector<T> take(BlockNumber block) {
    const auto found = bins_.find(block);
    if (found == bins_.end()) return {};
    Bin& bin = found->second;
    if (bin.in_file.empty()) return std::exchange(bin.in_memory, {});
    std::vector<T> elements(bin.n);
    T* next = elements.data();
    for (const Piece& piece : bin.in_file) {
      scratch_->read(piece.place, next, piece.n * sizeof(T));
      next += piece.n;
    }
    std::copy(bin.in_memory.begin(), bin.in_memory.end(), next);
    bin = {};
    return elements;
  }

 private:
  struct Piece {
    std::uint64_t place;
    std::size_t n;
  };
  struct Bin {
    std::vector<Piece> in_file;
    std::vector<T> in_memory;
    std::size_t n = 0;
  };

  Bin& bin_of(BlockNumber block) {
    if (last_ == bins_.end() || last_->first != block) last_ = bins_.try_emplace(block).first;
    return last_->second;
  }

  void spill() {
    for (auto& [block, bin] : bins_) {
      if (bin.in_memory.empty()) continue;
      if (!scratch_) scratch_.emplace(folder_);
      const std::uint64_t place = scratch_->append(bin.in_memory.data(), bin.in_memory.size() * sizeof(T));
      bin.in_file.push_back({place, bin.in_memory.size()});
      std::vector<T>().swap(bin.in_memory);
    }
    bytes_ = 0;
  }

  std::uint64_t memory_;
  std::string folder_;
  std::map<BlockNumber, Bin> bins_;
  typename std::map<BlockNumber, Bin>::iterator last_ = bins_.end();  // elements come in neighbourhoods
  std::uint64_t bytes_ = 0;                                           // in memory
  std::optional<ScratchFile> scratch_;
};

}  // namespace tinsmith
