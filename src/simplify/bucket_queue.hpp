#pragma once
// A priority queue of vertices for costs, as coarse as it can be: one class of costs for each factor of four, so
// that no two costs are ever compared, and within a class one block of neighbouring vertices after the other, which
// keeps memory accesses together. Within a block vertices come in their own order (they lie along a space-filling
// curve), then those added while it is the first, first in first out.
//
// On the sample terrain at 10 m, 512 x 512 windows: classes of a factor of two without blocks 205 259 triangles in
// 3.15 s, of four 205 080 in 2.98 s, of sixteen 204 544 in 2.89 s; RMSE 4.23, 4.24 and 4.28 m. Blocks of 4096
// vertices take another 5 % off the time. Finer classes (16 for a factor of two) changed the number by less than
// 0.3 %.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tinsmith {

class BucketQueue {
 public:
  /// For vertices 0 to n_vertices - 1.
  explicit BucketQueue(std::size_t n_vertices)
      : n_blocks_((n_vertices >> kBlockBits) + 1), buckets_(kClasses * n_blocks_), first_(buckets_.size()) {}

  /// Costs below zero are zero.
  static std::size_t class_of(float cost) { return std::bit_cast<std::uint32_t>(cost < 0 ? 0.0F : cost) >> kShift; }

  void push(std::size_t cost_class, std::int32_t vertex) {
    const std::size_t bucket = cost_class * n_blocks_ + (static_cast<std::size_t>(vertex) >> kBlockBits);
    buckets_[bucket].vertices.push_back(vertex);
    first_ = std::min(first_, bucket);
  }

  /// The first vertex of the lowest class, and that class; false when the queue is empty.
  bool pop(std::int32_t& vertex, std::size_t& cost_class) {
    for (; first_ < buckets_.size(); ++first_) {
      Bucket& b = buckets_[first_];
      if (b.head < b.vertices.size()) {
        if (b.head == 0) std::sort(b.vertices.begin(), b.vertices.end());
        vertex = b.vertices[b.head++];
        cost_class = first_ / n_blocks_;
        return true;
      }
      b.vertices.clear();
      b.head = 0;
    }
    return false;
  }

 private:
  static constexpr unsigned kShift = 24;  // leaves the exponent without its last bit
  static constexpr std::size_t kClasses = std::size_t{1} << (31 - kShift);
  static constexpr unsigned kBlockBits = 12;

  struct Bucket {
    std::vector<std::int32_t> vertices;
    std::size_t head = 0;
  };
  std::size_t n_blocks_;
  std::vector<Bucket> buckets_;  // by class, then by block
  std::size_t first_;            // no bucket before it has vertices
};

}  // namespace tinsmith
