#include "tile/chunk_store.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/check.hpp"
#include "base/disk.hpp"
#include "tile/chunk_bytes.hpp"

namespace tinsmith {

namespace {

constexpr std::uint64_t kMagic = 0x316B'6E75'6863'7374;  // "tschunk1"
constexpr std::uint64_t kDamaged = ~std::uint64_t{0};    // in place of the number of parts: not done after all
constexpr std::size_t kMostParts = 1 << 10;

std::size_t at(std::int64_t i) { return static_cast<std::size_t>(i); }

std::uint64_t checksum_of(std::string_view bytes) { return XXH3_64bits(bytes.data(), bytes.size()); }

void append_word(std::string& bytes, std::uint64_t word) {
  bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
}

// Words of an entry, one after the other; none left: the entry is torn.
class Words {
 public:
  explicit Words(std::string_view bytes) : bytes_(bytes) {}
  std::optional<std::uint64_t> next() {
    std::uint64_t word = 0;
    if (bytes_.size() - used_ < sizeof word) return std::nullopt;
    std::memcpy(&word, bytes_.data() + used_, sizeof word);
    used_ += sizeof word;
    return word;
  }
  std::size_t used() const { return used_; }

 private:
  std::string_view bytes_;
  std::size_t used_ = 0;
};

}  // namespace

WindowCounts& WindowCounts::operator+=(const WindowCounts& more) {
  samples += more.samples;
  valid_cells += more.valid_cells;
  start_triangles += more.start_triangles;
  triangles += more.triangles;
  return *this;
}

// ---- the index: an entry of 64-bit words for each task: kMagic, round, window, four counts, number of parts; for
// each part its reader, offset, bytes and checksum; the checksum of all that.

struct ChunkStore::Entry {
  WindowName task;
  WindowCounts counts;
  bool is_damaged = false;
  std::vector<Part> parts;

  std::string bytes() const {
    std::string bytes;
    for (const std::uint64_t word :
         {kMagic, static_cast<std::uint64_t>(task.round), static_cast<std::uint64_t>(task.window), counts.samples,
          counts.valid_cells, counts.start_triangles, counts.triangles, is_damaged ? kDamaged : parts.size()})
      append_word(bytes, word);
    for (const Part& part : parts) {
      for (const std::uint64_t word :
           {static_cast<std::uint64_t>(part.window), part.offset, part.bytes, part.checksum})
        append_word(bytes, word);
    }
    append_word(bytes, checksum_of(bytes));
    return bytes;
  }

  // The entry at the start of the bytes and its size; none when it is torn or damaged.
  static std::optional<std::pair<Entry, std::size_t>> from(std::string_view bytes) {
    Words words(bytes);
    std::array<std::uint64_t, 8> head{};
    for (std::uint64_t& word : head) {
      const auto next = words.next();
      if (!next) return std::nullopt;
      word = *next;
    }
    if (head[0] != kMagic || (head[7] != kDamaged && head[7] > kMostParts)) return std::nullopt;
    Entry entry{{static_cast<int>(head[1]), static_cast<std::int64_t>(head[2])},
                {head[3], head[4], head[5], head[6]},
                head[7] == kDamaged,
                {}};
    for (std::uint64_t i = 0; !entry.is_damaged && i < head[7]; ++i) {
      const auto window = words.next(), offset = words.next(), size = words.next(), checksum = words.next();
      if (!checksum) return std::nullopt;
      entry.parts.push_back({static_cast<std::int64_t>(*window), *offset, *size, *checksum, 0, nullptr});
    }
    const std::uint64_t expected = checksum_of(bytes.substr(0, words.used()));
    if (words.next() != expected) return std::nullopt;
    return std::pair(std::move(entry), words.used());
  }
};

ChunkStore::ChunkStore(const WindowGraph& graph, const ChunkStoreOptions& options)
    : graph_(graph), options_(options) {
  for (int r = 0; r < graph.n_rounds(); ++r) {
    const WindowGrid& windows = graph.windows(r);
    round(r).is_done.assign(at(windows.count()), 0);
    round(r).unread.assign(at(windows.rows), 0);
    round(r).n_done.assign(at(windows.rows), 0);
  }
  if (!options_.folder.empty()) load();
}

std::string ChunkStore::index_file() const { return options_.folder + "/index"; }

std::string ChunkStore::row_file(WindowName task) const {
  return options_.folder + "/round-" + std::to_string(task.round) + "-row-" + std::to_string(row_of(task));
}

void ChunkStore::load() {
  const std::string path = index_file();
  const std::string index = read_from_file(path, 0, file_size_or_zero(path));
  std::string magic;
  append_word(magic, kMagic);
  std::vector<std::map<std::int64_t, Entry>> entries(at(graph_.n_rounds()));
  std::size_t i = 0;
  std::size_t n_whole = 0;  // bytes
  while ((i = index.find(magic, i)) != std::string::npos) {
    auto found = Entry::from(std::string_view(index).substr(i));
    if (!found) {
      ++i;
      continue;
    }
    auto& [entry, size] = *found;
    i += size;
    n_whole += size;
    const WindowName task = entry.task;
    if (task.round < 0 || task.round >= graph_.n_rounds() || task.window < 0 ||
        task.window >= graph_.windows(task.round).count())
      continue;
    auto& of_round = entries[at(task.round)];
    of_round.erase(task.window);
    if (!entry.is_damaged) of_round.emplace(task.window, std::move(entry));
  }
  if (index.empty() && !std::filesystem::is_empty(options_.folder)) losses_.push_back(path + ": is missing");
  if (n_whole < index.size())
    losses_.push_back(path + ": " + std::to_string(index.size() - n_whole) + " bytes are damaged");
  settle_loaded(entries);
}

bool ChunkStore::is_whole(const Entry& entry) const {
  const std::uint64_t size = file_size_or_zero(row_file(entry.task));
  return std::all_of(entry.parts.begin(), entry.parts.end(), [&](const Part& part) {
    return part.offset + part.bytes <= size || is_read(entry.task, part.window);
  });
}

// A task counts as done when the parts that are still to be read are there. From the last round to the first: what
// turns out to be missing makes the tasks before it needed again.
void ChunkStore::settle_loaded(const std::vector<std::map<std::int64_t, Entry>>& entries) {
  std::map<std::string, int> n_lost;  // windows, by file
  for (int r = graph_.last_round(); r >= 0; --r) {
    for (const auto& [window, entry] : entries[at(r)]) {
      if (is_whole(entry))
        round(r).is_done[at(window)] = 1;
      else
        ++n_lost[row_file(entry.task)];
    }
  }
  for (const auto& [file, n] : n_lost)
    losses_.push_back(file + ": the results of " + std::to_string(n) + " windows are missing");
  for (int r = 0; r < graph_.n_rounds(); ++r) {
    for (const auto& [window, entry] : entries[at(r)]) {
      if (!round(r).is_done[at(window)]) continue;
      auto parts = entry.parts;
      note_done(entry.task, std::move(parts), entry.counts);
    }
  }
}

bool ChunkStore::is_read(WindowName task, std::int64_t reader) const {
  return task.round < graph_.last_round() && round(task.round + 1).is_done[at(reader)] != 0;
}

bool ChunkStore::is_done(WindowName task) const {
  const std::lock_guard lock(mutex_);
  return round(task.round).is_done[at(task.window)] != 0;
}

WindowCounts ChunkStore::counts(int r) const {
  const std::lock_guard lock(mutex_);
  return round(r).counts;
}

std::uint64_t ChunkStore::bytes_in_memory() const {
  const std::lock_guard lock(mutex_);
  return in_memory_;
}

// ---- keeping

void ChunkStore::put(WindowName task, std::vector<ChunkPart>&& chunks, const WindowCounts& counts) {
  std::vector<Part> parts;
  parts.reserve(chunks.size());
  for (const ChunkPart& chunk : chunks) parts.push_back({chunk.window, 0, 0, 0, bytes_held(chunk.chunk), nullptr});
  if (!options_.folder.empty()) write(task, parts, counts, chunks);
  const std::lock_guard lock(mutex_);
  // Results wait for the end, and there are the more of them the larger the raster is: they wait in the folder.
  const bool is_result = task.round == graph_.last_round();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const bool has_room = !is_result && in_memory_ + parts[i].memory <= options_.memory;
    if (!options_.folder.empty() && !has_room) continue;
    in_memory_ += parts[i].memory;
    parts[i].chunk = std::make_shared<const Chunk>(std::move(chunks[i].chunk));
  }
  note_done(task, std::move(parts), counts);
  drop_parts_for(task);
}

void ChunkStore::put_empty(WindowName task) {
  const std::lock_guard lock(mutex_);
  note_done(task, {}, {});
  drop_parts_for(task);
}

// First the parts, then the entry: what has an entry is there.
void ChunkStore::write(WindowName task, std::vector<Part>& parts, const WindowCounts& counts,
                       const std::vector<ChunkPart>& chunks) {
  std::string bytes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    parts[i].offset = bytes.size();
    append_chunk(bytes, chunks[i].chunk);
    parts[i].bytes = bytes.size() - parts[i].offset;
    parts[i].checksum = checksum_of(std::string_view(bytes).substr(parts[i].offset));
  }
  const std::lock_guard lock(disk_);
  const std::uint64_t start = parts.empty() ? 0 : append_to_file(row_file(task), bytes);
  for (Part& part : parts) part.offset += start;
  append_to_file(index_file(), Entry{task, counts, false, parts}.bytes());
}

void ChunkStore::note_done(WindowName task, std::vector<Part>&& parts, const WindowCounts& counts) {
  Round& of = round(task.round);
  of.is_done[at(task.window)] = 1;
  of.counts += counts;
  ++of.n_done[at(row_of(task))];
  std::erase_if(parts, [&](const Part& part) {
    const bool read = is_read(task, part.window);
    if (read && part.chunk) in_memory_ -= part.memory;
    return read;
  });
  of.unread[at(row_of(task))] += parts.size();
  if (!parts.empty()) of.parts[task.window] = std::move(parts);
  drop_row_when_read(task);
}

void ChunkStore::drop_parts_for(WindowName task) {
  graph_.inputs(task).for_each([&](std::int64_t maker) {
    Round& before = round(task.round - 1);
    const auto found = before.parts.find(maker);
    if (found == before.parts.end()) return;
    auto& parts = found->second;
    const auto part = std::find_if(parts.begin(), parts.end(), [&](auto& p) { return p.window == task.window; });
    if (part == parts.end()) return;
    if (part->chunk) in_memory_ -= part->memory;
    parts.erase(part);
    if (parts.empty()) before.parts.erase(found);
    const WindowName name{task.round - 1, maker};
    --before.unread[at(row_of(name))];
    drop_row_when_read(name);
  });
}

void ChunkStore::drop_row_when_read(WindowName task) {
  const Round& of = round(task.round);
  const std::size_t row = at(row_of(task));
  if (options_.folder.empty() || task.round == graph_.last_round() || of.unread[row] > 0) return;
  if (of.n_done[row] == static_cast<std::uint32_t>(graph_.windows(task.round).columns))
    std::remove(row_file(task).c_str());
}

// ---- giving

bool ChunkStore::has_parts_for(WindowName task) const {
  const std::lock_guard lock(mutex_);
  bool has = false;
  graph_.inputs(task).for_each([&](std::int64_t maker) {
    const auto found = round(task.round - 1).parts.find(maker);
    if (has || found == round(task.round - 1).parts.end()) return;
    has = std::any_of(found->second.begin(), found->second.end(),
                      [&](const Part& part) { return part.window == task.window; });
  });
  return has;
}

std::vector<std::shared_ptr<const Chunk>> ChunkStore::parts_for(WindowName task) {
  std::vector<std::pair<WindowName, Part>> wanted;
  {
    const std::lock_guard lock(mutex_);
    graph_.inputs(task).for_each([&](std::int64_t maker) {
      const auto found = round(task.round - 1).parts.find(maker);
      if (found == round(task.round - 1).parts.end()) return;
      for (const Part& part : found->second) {
        if (part.window == task.window) wanted.emplace_back(WindowName{task.round - 1, maker}, part);
      }
    });
  }
  std::vector<std::shared_ptr<const Chunk>> chunks;
  chunks.reserve(wanted.size());
  for (const auto& [maker, part] : wanted) chunks.push_back(fetch(maker, part));
  return chunks;
}

std::shared_ptr<const Chunk> ChunkStore::result(std::int64_t window) {
  const WindowName task{graph_.last_round(), window};
  Part part;
  {
    const std::lock_guard lock(mutex_);
    const auto found = round(task.round).parts.find(window);
    if (found == round(task.round).parts.end()) return nullptr;
    part = found->second.front();
  }
  return fetch(task, part);
}

std::shared_ptr<const Chunk> ChunkStore::fetch(WindowName maker, const Part& part) {
  if (part.chunk) return part.chunk;
  const std::string bytes = read_from_file(row_file(maker), part.offset, part.bytes);
  if (bytes.size() == part.bytes && checksum_of(bytes) == part.checksum)
    return std::make_shared<const Chunk>(chunk_from(bytes));
  const std::lock_guard lock(disk_);
  append_to_file(index_file(), Entry{maker, {}, true, {}}.bytes());
  throw DamagedChunk(row_file(maker) + ": " + std::to_string(part.bytes) + " bytes from " +
                     std::to_string(part.offset) + " are damaged");
}

}  // namespace tinsmith
