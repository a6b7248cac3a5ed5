#include "pipeline/measure_blocks.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <vector>

#include "base/machine_memory.hpp"

namespace tinsmith {
namespace {

/// Lets blocks begin as long as there is memory for them, and one always.
class MemoryGate {
 public:
  explicit MemoryGate(std::uint64_t memory) : memory_(memory) {}
  void enter(std::uint64_t bytes) {
    std::unique_lock lock(mutex_);
    left_.wait(lock, [&] { return in_use_ == 0 || in_use_ + bytes <= memory_; });
    in_use_ += bytes;
  }
  void leave(std::uint64_t bytes) {
    const std::lock_guard lock(mutex_);
    in_use_ -= bytes;
    left_.notify_all();
  }

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  std::uint64_t memory_;
  std::uint64_t in_use_ = 0;
};

/// A block's share of the memory, given back however its measurement ends.
class Admission {
 public:
  Admission(MemoryGate& gate, std::uint64_t bytes) : gate_(gate), bytes_(bytes) { gate_.enter(bytes_); }
  Admission(const Admission&) = delete;
  Admission& operator=(const Admission&) = delete;
  ~Admission() { gate_.leave(bytes_); }

 private:
  MemoryGate& gate_;
  std::uint64_t bytes_;
};

// Blocks of all sizes come and go: over thousands of them what the allocator keeps grows by a twelfth of all
// memory.
constexpr std::size_t kBlocksBetweenTrims = 4;

class BlockQueue {
 public:
  BlockQueue(BlockedMesh& mesh, const Samples& samples, std::uint64_t memory)
      : mesh_(mesh), samples_(samples), gate_(memory), blocks_(blocks_to_measure(mesh, samples.field)) {}

  /// What one thread does: blocks in their order, so that threads read the raster side by side.
  void work() {
    Findings own;
    for (std::size_t i = next_++; i < blocks_.size() && !tbb::is_current_task_group_canceling(); i = next_++) {
      const Admission admission(gate_, memory_of(mesh_, blocks_[i], samples_));
      measure_block(mesh_, blocks_[i], samples_, own);
      block_done();
    }
    const std::lock_guard lock(mutex_);
    findings_.add(own);
  }

  Findings& findings() { return findings_; }

 private:
  void block_done() {
    std::unique_lock lock(mutex_);
    const std::size_t n_done = ++n_done_;
    report_progress(samples_, static_cast<double>(n_done) / static_cast<double>(blocks_.size()));
    lock.unlock();
    if (n_done % kBlocksBetweenTrims == 0) return_free_memory();
  }

  BlockedMesh& mesh_;
  const Samples& samples_;
  MemoryGate gate_;
  std::vector<BlockNumber> blocks_;
  std::atomic<std::size_t> next_ = 0;
  std::mutex mutex_;
  std::size_t n_done_ = 0;
  Findings findings_;
};

}  // namespace

Certificate measure_blocks(BlockedMesh& mesh, const Samples& samples, int threads, std::uint64_t memory) {
  report_progress(samples, 0);
  BlockQueue queue(mesh, samples, memory);
  tbb::parallel_for(
      0, std::max(1, threads), [&](int) { queue.work(); }, tbb::simple_partitioner());
  report_progress(samples, 1);  // with nothing to measure, too
  return conclude(mesh, std::move(queue.findings()), samples.frame);
}

}  // namespace tinsmith
