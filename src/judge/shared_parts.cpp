#include "judge/shared_parts.hpp"

namespace tinsmith {

void SharedParts::add(const BlockGrid& grid, std::span<const Facet> facets, std::span<const Member> members) {
  const std::lock_guard lock(mutex_);
  std::unordered_map<std::uint32_t, std::uint32_t> set_of;  // by part
  for (const auto& [facet, part] : members) {
    const auto [known, is_new] = set_of.try_emplace(part, 0);
    if (is_new) known->second = sets_.add();
    add(grid, facets[facet], known->second);
  }
}

void SharedParts::add(const BlockGrid& grid, const Facet& facet, std::uint32_t set) {
  const auto [found, is_new] = waiting_.try_emplace(facet.number, Waiting{set, 0});
  Waiting& waiting = found->second;
  if (is_new) {
    grid.find_blocks(facet, touched_);
    waiting.n_blocks = touched_.size();
  }
  sets_.unite(waiting.set, set);
  if (--waiting.n_blocks == 0) waiting_.erase(found);
}

std::uint64_t SharedParts::count() const {
  const std::lock_guard lock(mutex_);
  return sets_.count();
}

std::size_t SharedParts::n_waiting() const {
  const std::lock_guard lock(mutex_);
  return waiting_.size();
}

}  // namespace tinsmith
