#pragma once
// Connected parts of the mesh that several blocks see, counted without remembering more than the facets between
// blocks that are measured and blocks that are not.

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <unordered_map>
#include <vector>

#include "judge/block_grid.hpp"
#include "judge/plan.hpp"
#include "judge/sets.hpp"

namespace tinsmith {

/// The order in which blocks tell does not matter. Members may be called by several threads.
class SharedParts {
 public:
  /// A facet that several blocks see, by its place in this one, and a number that it has in common with those that
  /// it is connected with in this one.
  struct Member {
    std::uint32_t facet;
    std::uint32_t part;
  };

  /// What one block sees, once for each block.
  void add(const BlockGrid& grid, std::span<const Facet> facets, std::span<const Member> members);

  /// Once all blocks have told.
  std::uint64_t count() const;

  /// Facets that wait for other blocks.
  std::size_t n_waiting() const;

 private:
  struct Waiting {
    std::uint32_t set;
    std::size_t n_blocks;  // that have not told
  };
  void add(const BlockGrid& grid, const Facet& facet, std::uint32_t set);

  mutable std::mutex mutex_;
  Sets sets_{0};                                        // one for each part of each block
  std::unordered_map<std::uint32_t, Waiting> waiting_;  // by the facet's number
  std::vector<BlockNumber> touched_;
};

}  // namespace tinsmith
