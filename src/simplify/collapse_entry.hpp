#pragma once
// What waits in the queue of collapses.

#include <bit>
#include <cstdint>

namespace tinsmith {

/// A cost, not negative, and a halfedge in one number: ordered by cost, ties by halfedge, and comparing needs no
/// jump.
class CollapseEntry {
 public:
  CollapseEntry(float cost, std::int32_t halfedge)
      : bits_(std::uint64_t{std::bit_cast<std::uint32_t>(cost)} << 32U | static_cast<std::uint32_t>(halfedge)) {}

  float cost() const { return std::bit_cast<float>(static_cast<std::uint32_t>(bits_ >> 32U)); }
  std::int32_t halfedge() const { return static_cast<std::int32_t>(bits_ & 0xFFFFFFFFU); }

  friend bool operator>(const CollapseEntry& a, const CollapseEntry& b) { return a.bits_ > b.bits_; }

 private:
  std::uint64_t bits_;
};

}  // namespace tinsmith
