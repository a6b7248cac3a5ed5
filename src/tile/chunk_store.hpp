#pragma once
// What finished window tasks left: in memory while there is room, and in a folder, from which a run that was
// stopped goes on.
//
// In the folder: a file of parts for each row of windows of each round, removed when all its readers are done, and
// `index`, to which every task appends an entry of its own when its parts are written. Entries and parts carry
// checksums (XXH3, 64 bits); what is torn or damaged counts as not there, and its task runs again.

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <vector>

#include "tile/chunk.hpp"
#include "tile/window_graph.hpp"

namespace tinsmith {

/// What is counted of a window.
struct WindowCounts {
  std::uint64_t samples = 0;          // round 0: valid ones; its right and lower border are its neighbours'
  std::uint64_t valid_cells = 0;      // round 0
  std::uint64_t start_triangles = 0;  // round 0: before simplification
  std::uint64_t triangles = 0;        // of the result

  WindowCounts& operator+=(const WindowCounts& more);
};

/// The parts of this task were damaged on the disk. It was noted as not done: make the store again and go on.
class DamagedChunk : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ChunkStoreOptions {
  std::string folder;              // empty: everything stays in memory
  std::uint64_t memory = 1 << 26;  // bytes of chunks to keep in memory when there is a folder
};

/// All members may be called by several threads.
class ChunkStore {
 public:
  /// Takes what an earlier run left in the folder. The graph must outlive the store. Throws OutputError.
  ChunkStore(const WindowGraph& graph, const ChunkStoreOptions& options);

  /// What an earlier run had finished and is not whole any more, a line each.
  const std::vector<std::string>& losses() const { return losses_; }

  bool is_done(WindowName task) const;
  WindowCounts counts(int round) const;  // of the tasks that are done

  /// Keeps what a task gave for each of its readers; in the last round the chunk itself is the only part, under
  /// the window's own number. What the task itself had from the round before is dropped. Throws OutputError.
  void put(WindowName task, std::vector<ChunkPart>&& parts, const WindowCounts& counts);

  /// A task that gave nothing and is as quickly done again: leaves no trace in the folder.
  void put_empty(WindowName task);

  /// Whether any task of the round before has a part for this one.
  bool has_parts_for(WindowName task) const;

  /// Those parts in the order of the windows. Throws DamagedChunk.
  std::vector<std::shared_ptr<const Chunk>> parts_for(WindowName task);

  /// The chunk of a window of the last round; null when it is empty. Throws DamagedChunk.
  std::shared_ptr<const Chunk> result(std::int64_t window);

  std::uint64_t bytes_in_memory() const;

 private:
  struct Part {
    std::int64_t window = 0;
    std::uint64_t offset = 0;
    std::uint64_t bytes = 0;
    std::uint64_t checksum = 0;
    std::uint64_t memory = 0;
    std::shared_ptr<const Chunk> chunk;  // null: on disk only
  };
  struct Round {
    std::vector<std::uint8_t> is_done;
    std::unordered_map<std::int64_t, std::vector<Part>> parts;  // by the window that made them
    std::vector<std::uint64_t> unread;                          // parts, by row of windows
    std::vector<std::uint32_t> n_done;                          // windows, by row
    WindowCounts counts;
  };
  struct Entry;

  Round& round(int r) { return rounds_[static_cast<std::size_t>(r)]; }
  const Round& round(int r) const { return rounds_[static_cast<std::size_t>(r)]; }
  std::int64_t row_of(WindowName task) const { return task.window / graph_.windows(task.round).columns; }
  std::string row_file(WindowName task) const;
  std::string index_file() const;
  bool is_read(WindowName task, std::int64_t reader) const;

  void load();
  bool is_whole(const Entry& entry) const;
  void settle_loaded(const std::vector<std::map<std::int64_t, Entry>>& entries);
  void write(WindowName task, std::vector<Part>& parts, const WindowCounts& counts,
             const std::vector<ChunkPart>& chunks);
  void note_done(WindowName task, std::vector<Part>&& parts, const WindowCounts& counts);
  void drop_parts_for(WindowName task);
  void drop_row_when_read(WindowName task);
  std::shared_ptr<const Chunk> fetch(WindowName maker, const Part& part);

  const WindowGraph& graph_;
  ChunkStoreOptions options_;
  mutable std::mutex mutex_;
  std::mutex disk_;  // one appends at a time
  std::vector<std::string> losses_;
  std::array<Round, kRounds> rounds_;
  std::uint64_t in_memory_ = 0;
};

}  // namespace tinsmith
