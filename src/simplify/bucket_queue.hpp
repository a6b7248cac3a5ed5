#pragma once
// A priority queue for costs: buckets by the exponent and the upper mantissa bits, first in first out within
// a bucket. The order inside a bucket is off by one part in 16 at most, which the result does not feel
// (DESIGN section 4), and no comparison of two costs is ever needed.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tinsmith {

template <class Entry>
class BucketQueue {
 public:
  static std::size_t bucket_of(float cost) {
    return std::bit_cast<std::uint32_t>(cost < 0 ? 0.0F : cost) >> kShift;
  }

  void push(std::size_t bucket, const Entry& entry) {
    buckets_[bucket].entries.push_back(entry);
    if (bucket < lowest_) lowest_ = bucket;
  }

  /// The entry of the lowest bucket that came first; false when the queue is empty.
  bool pop(Entry& entry, std::size_t& bucket) {
    for (; lowest_ < kBuckets; ++lowest_) {
      Bucket& b = buckets_[lowest_];
      if (b.head < b.entries.size()) {
        entry = b.entries[b.head++];
        bucket = lowest_;
        return true;
      }
      b.entries.clear();
      b.head = 0;
    }
    return false;
  }

 private:
  static constexpr unsigned kShift = 19;  // 8 exponent bits and 4 of the mantissa
  static constexpr std::size_t kBuckets = std::size_t{1} << (31 - kShift);

  struct Bucket {
    std::vector<Entry> entries;
    std::size_t head = 0;
  };
  std::vector<Bucket> buckets_ = std::vector<Bucket>(kBuckets);
  std::size_t lowest_ = kBuckets;
};

}  // namespace tinsmith
