// A run that was stopped goes on from what is whole, and nobody can tell from the result.

#include <atomic>
#include <filesystem>
#include <fstream>
#include <random>

#include "base/disk.hpp"
#include "pipeline/run_folder.hpp"
#include "pipeline_fixture.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

using namespace test;
namespace fs = std::filesystem;

class Scratch {
 public:
  Scratch() : path_((fs::temp_directory_path() / ("tinsmith-resume-" + std::to_string(::getpid()))).string()) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Scratch() { fs::remove_all(path_); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

bool same(const TerrainMesh& a, const TerrainMesh& b) {
  return a.position == b.position && a.height == b.height && a.triangles == b.triangles;
}

const HeightGrid& terrain() {
  static const HeightGrid grid = [] {
    HeightGrid g = mountains(150, 130, 77);
    cut(g, Mask::kSparse, 5);
    return g;
  }();
  return grid;
}

RoundsOptions options_in(const std::string& folder, std::uint64_t memory = 1 << 26) {
  return {10, 16, Placement::kOptimal, Effort::kDefault, folder, memory};
}

// Runs until the progress was told `n` times; true when the run came to its end before.
bool run_some(const CountedField& field, const RoundsOptions& options, int n, TerrainMesh& mesh,
              CompressReport& report) {
  std::atomic<int> told = 0;
  try {
    mesh = mesh_of(*run_rounds(
        field, {}, options, [&](double, std::string_view) { return ++told < n; }, report));
    return true;
  } catch (const Interrupted&) {
    return false;
  }
}

TEST(Resume, GivesTheSameBytesWithoutDoingWorkTwice) {
  const CountedField whole(terrain());
  CompressReport expected;
  const TerrainMesh mesh = mesh_of(*run_rounds(whole, {}, options_in(""), {}, expected));
  for (const std::uint64_t memory : {std::uint64_t{0}, std::uint64_t{1} << 26}) {
    const Scratch scratch;
    const CountedField field(terrain());
    std::mt19937 random(7);
    TerrainMesh resumed;
    CompressReport report;
    int n_stops = 0;
    while (
        !run_some(field, options_in(scratch.path(), memory), 1 + static_cast<int>(random() % 20), resumed, report))
      ++n_stops;
    EXPECT_GT(n_stops, 10);
    EXPECT_TRUE(same(resumed, mesh));
    EXPECT_EQ(report.samples, expected.samples);
    EXPECT_EQ(report.full_triangles, expected.full_triangles);
    EXPECT_EQ(report.round_triangles, expected.round_triangles);
    // At each stop no more is lost than what was at work.
    EXPECT_LE(field.n_reads(), whole.n_reads() + n_stops * tbb::this_task_arena::max_concurrency());
  }
}

TEST(Resume, DropsWhatNobodyNeedsAnyMore) {
  const Scratch scratch;
  const CountedField field(terrain());
  CompressReport report;
  run_rounds(field, {}, options_in(scratch.path()), {}, report);
  for (const auto& entry : fs::directory_iterator(scratch.path())) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "index" || name.starts_with("round-2-")) << name;
  }
}

void damage(const fs::path& file, std::mt19937& random) {
  const auto size = fs::file_size(file);
  if (size == 0) return;
  const auto place = random() % size;
  switch (random() % 3) {
    case 0:
      fs::resize_file(file, place);
      break;
    case 1:
      fs::remove(file);
      break;
    default: {
      std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
      stream.seekg(static_cast<std::streamoff>(place));
      const int byte = stream.get() ^ (1 << random() % 8);
      stream.seekp(static_cast<std::streamoff>(place));
      stream.put(static_cast<char>(byte));
    }
  }
}

TEST(Resume, ComputesAnewWhatIsDamagedOnDisk) {
  const CountedField field(terrain());
  CompressReport expected;
  const TerrainMesh mesh = mesh_of(*run_rounds(field, {}, options_in(""), {}, expected));
  std::mt19937 random(11);
  std::size_t n_remarks = 0;
  for (int trial = 0; trial < 25; ++trial) {
    const Scratch scratch;
    const RoundsOptions options = options_in(scratch.path(), 0);
    TerrainMesh resumed;
    CompressReport report;
    for (bool is_whole = false; !is_whole;) {
      is_whole = run_some(field, options, 60 + static_cast<int>(random() % 200), resumed, report);
      std::vector<fs::path> files;
      for (const auto& entry : fs::directory_iterator(scratch.path())) files.push_back(entry.path());
      std::sort(files.begin(), files.end());
      if (!files.empty()) damage(files[random() % files.size()], random);
    }
    EXPECT_TRUE(same(resumed, mesh)) << trial;
    EXPECT_EQ(report.round_triangles, expected.round_triangles) << trial;
    n_remarks += report.remarks.size();
  }
  EXPECT_GT(n_remarks, 5U);
}

TEST(RunFolder, GoesOnOnlyFromWorkOfTheSameIdentity) {
  const Scratch scratch;
  const std::string output = scratch.path() + "/dem.ply";
  const Identity identity{"max error: 5", "window: 256"};
  std::string work;
  {
    RunFolder folder(output, "", identity, false);
    work = folder.subfolder("work") + "/index";
    append_to_file(work, "abc");
    EXPECT_THROW(RunFolder(output, "", identity, false), OutputError);  // in use
  }
  EXPECT_TRUE(fs::exists(work));
  { const RunFolder again(output, "", identity, false); }
  EXPECT_TRUE(fs::exists(work));
  try {
    const RunFolder other(output, "", {"max error: 6", "window: 256"}, false);
    ADD_FAILURE() << "took over another run's work";
  } catch (const UsageError& error) {
    EXPECT_NE(std::string(error.what()).find("'max error: 5' then, 'max error: 6' now"), std::string::npos)
        << error.what();
    EXPECT_NE(std::string(error.what()).find("--fresh"), std::string::npos);
  }
  EXPECT_TRUE(fs::exists(work));
  { const RunFolder other(output, "", {"max error: 6", "window: 256"}, true); }
  EXPECT_FALSE(fs::exists(work));
}

TEST(RunFolder, LeavesNothingWhenNothingWasDoneOrAllIs) {
  const Scratch scratch;
  { const RunFolder folder(scratch.path() + "/dem.ply", "", {"a: 1"}, false); }
  EXPECT_TRUE(fs::is_empty(scratch.path()));
  {
    RunFolder folder(scratch.path() + "/dem.ply", scratch.path() + "/tmp", {"a: 1"}, false);
    append_to_file(folder.subfolder("work") + "/index", "abc");
    folder.remove();
  }
  EXPECT_TRUE(fs::is_empty(scratch.path() + "/tmp"));
}

}  // namespace
}  // namespace tinsmith
