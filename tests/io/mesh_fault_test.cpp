// Writes that fail: the old output stays, and nothing else does.

#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

#include "io/mesh_cases.hpp"
#include "io/mesh_file.hpp"
#include "support/file_size_limit.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr std::array kExtensions{".ply", ".obj", ".glb", ".2dm"};

/// A mesh whose vertices or triangles can't be brought after the first block, as when scratch space is damaged.
class BrokenSurface : public TerrainSurface {
 public:
  BrokenSurface(const TerrainMesh& mesh, bool has_vertices) : whole_(mesh), has_vertices_(has_vertices) {}
  const TerrainExtent& extent() const override { return whole_.extent(); }
  void for_each_vertex_block(const std::function<void(VertexBlock)>& visit) const override {
    whole_.for_each_vertex_block([&](VertexBlock block) {
      visit(block);
      if (!has_vertices_) throw std::runtime_error("no vertices");
    });
  }
  void for_each_triangle_block(const std::function<void(TriangleBlock)>& visit) const override {
    whole_.for_each_triangle_block([&](TriangleBlock block) {
      visit(block);
      if (has_vertices_) throw std::runtime_error("no triangles");
    });
  }

 private:
  MeshSurface whole_;
  bool has_vertices_;
};

TEST(MeshFault, KeepsTheOldFileWhereverTheWriteFails) {
  const ScratchFolder folder;
  const TerrainMesh small = random_mesh(1, 2, 2);
  const TerrainMesh large = random_mesh(1, 250, 250);
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    write_mesh(path, large, frames()[0]);
    const std::size_t whole = bytes_of(path).size();
    write_mesh(path, small, frames()[0]);
    const std::string old = bytes_of(path);
    const std::size_t n_files = folder.n_files();
    for (const std::size_t limit :
         {std::size_t{0}, std::size_t{10}, std::size_t{300}, std::size_t{1} << 20, whole - 1}) {
      const test::FileSizeLimit full(limit);
      EXPECT_THROW(write_mesh(path, large, frames()[0]), OutputError) << extension << " at byte " << limit;
      EXPECT_TRUE(bytes_of(path) == old) << extension << " at byte " << limit;
      EXPECT_EQ(folder.n_files(), n_files) << extension << " at byte " << limit;
    }
    const test::FileSizeLimit enough(whole);
    EXPECT_NO_THROW(write_mesh(path, large, frames()[0])) << extension;
  }
}

TEST(MeshFault, KeepsTheOldFileWhenTheSurfaceBreaks) {
  const ScratchFolder folder;
  const TerrainMesh mesh = random_mesh(1, 100, 100);
  for (const std::string extension : kExtensions)
    for (const bool has_vertices : {false, true}) {
      const std::string path = folder.file("a" + extension);
      write_mesh(path, random_mesh(1, 2, 2), frames()[0]);
      const std::string old = bytes_of(path);
      const std::size_t n_files = folder.n_files();
      EXPECT_THROW(write_mesh(path, BrokenSurface(mesh, has_vertices), frames()[0]), std::runtime_error);
      EXPECT_TRUE(bytes_of(path) == old) << extension;
      EXPECT_EQ(folder.n_files(), n_files) << extension;
    }
}

constexpr int kCannotMount = 77;

/// Fills a disk of 100 kB; the exit code of a process of its own, which may mount one.
int fill_a_disk(const ScratchFolder& folder) {
  const std::string disk = folder.file("");
  if (unshare(CLONE_NEWNS) != 0 || mount("none", "/", nullptr, MS_REC | MS_PRIVATE, nullptr) != 0 ||
      mount("none", disk.c_str(), "tmpfs", 0, "size=100k") != 0)
    return kCannotMount;
  for (const std::string extension : kExtensions) {
    const std::string path = folder.file("a" + extension);
    write_mesh(path, random_mesh(1, 2, 2), frames()[0]);
    const std::string old = bytes_of(path);
    const std::size_t n_files = folder.n_files();
    try {
      write_mesh(path, random_mesh(1, 100, 100), frames()[0]);
      return 1;
    } catch (const OutputError& error) {
      if (std::string(error.what()).find("No space left on device") == std::string::npos) return 2;
    }
    if (bytes_of(path) != old) return 3;
    if (folder.n_files() != n_files) return 4;
  }
  return 0;
}

TEST(MeshFault, KeepsTheOldFileOnADiskThatIsFull) {
  const ScratchFolder folder;
  const pid_t process = fork();
  ASSERT_GE(process, 0);
  if (process == 0) _exit(fill_a_disk(folder));
  int status = 0;
  waitpid(process, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  if (WEXITSTATUS(status) == kCannotMount) GTEST_SKIP() << "this user may not mount a small disk";
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

}  // namespace
}  // namespace tinsmith
