// What was kept comes back, from memory or disk, from this store or the next.

#include "tile/chunk_store.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>

#include "tile/chunk_bytes.hpp"

namespace tinsmith {
namespace {

namespace fs = std::filesystem;

class ChunkStoreTest : public testing::Test {
 protected:
  ChunkStoreTest() : folder_(fs::temp_directory_path() / ("tinsmith-store-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  ~ChunkStoreTest() override { fs::remove_all(folder_); }

  fs::path folder_;
};

Chunk random_chunk(std::mt19937& random) {
  Chunk chunk;
  const auto n = static_cast<std::int32_t>(3 + random() % 50);
  for (std::int32_t v = 0; v < n; ++v) {
    chunk.position.push_back({static_cast<std::int32_t>(random()), static_cast<std::int32_t>(random())});
    chunk.height.push_back(static_cast<double>(random()) / 7);
    chunk.is_settled.push_back(random() % 2);
    chunk.colour.push_back({static_cast<float>(random() % 256), 0, 7, 0});
    chunk.triangles.push_back({v, (v + 1) % n, (v + 2) % n});
  }
  return chunk;
}

std::string bytes_of(const Chunk& chunk) {
  std::string bytes;
  append_chunk(bytes, chunk);
  return bytes;
}

TEST(ChunkBytes, ReadBackAsTheyWere) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const Chunk chunk = random_chunk(random);
    EXPECT_EQ(bytes_of(chunk_from(bytes_of(chunk))), bytes_of(chunk));
  }
  EXPECT_TRUE(chunk_from(bytes_of(Chunk{})).is_empty());
}

TEST_F(ChunkStoreTest, GivesEveryPartToItsReaderInTheOrderOfTheWindows) {
  const WindowGraph graph(40, 40, 16);
  for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{4000}, std::uint64_t{1} << 30}) {
    for (const std::string& folder : {std::string(), folder_.string()}) {
      if (folder.empty() && memory == 0) continue;
      std::mt19937 random(5);
      std::map<std::int64_t, std::vector<std::string>> expected;  // by reader
      {
        ChunkStore store(graph, {folder, memory});
        for (std::int64_t w = 0; w < graph.windows(0).count(); ++w) {
          std::vector<ChunkPart> parts;
          graph.readers({0, w}).for_each([&](std::int64_t reader) {
            if (random() % 4 == 0) return;
            parts.push_back({reader, random_chunk(random)});
            expected[reader].push_back(bytes_of(parts.back().chunk));
          });
          EXPECT_FALSE(store.is_done({0, w}));
          store.put({0, w}, std::move(parts), {1, 2, 3, 4});
          EXPECT_TRUE(store.is_done({0, w}));
        }
        if (!folder.empty()) EXPECT_LE(store.bytes_in_memory(), memory);
        EXPECT_EQ(store.counts(0).triangles, 4U * static_cast<std::uint64_t>(graph.windows(0).count()));
        if (folder.empty()) {
          for (const auto& [reader, parts] : expected) EXPECT_EQ(store.parts_for({1, reader}).size(), parts.size());
        }
      }
      if (folder.empty()) continue;
      ChunkStore store(graph, {folder, memory});  // the next run
      EXPECT_EQ(store.counts(0).samples, static_cast<std::uint64_t>(graph.windows(0).count()));
      for (std::int64_t reader = 0; reader < graph.windows(1).count(); ++reader) {
        const auto parts = store.parts_for({1, reader});
        ASSERT_EQ(parts.size(), expected[reader].size());
        EXPECT_EQ(store.has_parts_for({1, reader}), !parts.empty());
        for (std::size_t i = 0; i < parts.size(); ++i) EXPECT_EQ(bytes_of(*parts[i]), expected[reader][i]);
        store.put_empty({1, reader});
        EXPECT_FALSE(store.has_parts_for({1, reader}));
      }
      for (const auto& entry : fs::directory_iterator(folder_))  // nothing left to be read
        EXPECT_EQ(entry.path().filename(), "index");
      fs::remove(folder_ / "index");
    }
  }
}

// They are as many as the raster is large: memory would grow with it.
TEST_F(ChunkStoreTest, LeavesTheResultsOfTheLastRoundToTheFolder) {
  const WindowGraph graph(40, 40, 16);
  std::mt19937 random(7);
  ChunkStore store(graph, {folder_.string(), std::uint64_t{1} << 30});
  const WindowName task{graph.last_round(), 0};
  const Chunk chunk = random_chunk(random);
  const std::string bytes = bytes_of(chunk);
  std::vector<ChunkPart> parts;
  parts.push_back({task.window, chunk});
  store.put(task, std::move(parts), {});
  EXPECT_EQ(store.bytes_in_memory(), 0U);
  for (int reads = 0; reads < 2; ++reads) EXPECT_EQ(bytes_of(*store.result(task.window)), bytes);
}

}  // namespace
}  // namespace tinsmith
