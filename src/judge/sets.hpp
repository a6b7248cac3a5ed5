#pragma once
// Union-find.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace tinsmith {

/// Sets of the numbers below n, at first one of each; the smallest member stands for its set.
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
  /// One more number, in a set of its own.
  std::uint32_t add() {
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
    return parent_.back();
  }
  std::uint64_t count() const {
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < parent_.size(); ++i) n += parent_[i] == i;
    return n;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace tinsmith
