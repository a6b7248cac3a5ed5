// Files that are written aside: what killed writers leave, and who removes it.

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

#include "io/mesh_cases.hpp"
#include "io/output_file.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

/// Another process that is writing a file, until it is killed.
class Writer {
 public:
  explicit Writer(const std::string& path) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return;
    process_ = fork();
    if (process_ == 0) write_for_ever(path, ends[1]);
    close(ends[1]);
    char byte = 0;
    is_writing_ = read(ends[0], &byte, 1) == 1;
    close(ends[0]);
  }
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { kill(); }
  bool is_writing() const { return is_writing_; }
  void kill() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    waitpid(process_, nullptr, 0);
    process_ = -1;
  }

 private:
  [[noreturn]] static void write_for_ever(const std::string& path, int ready) {
    OutputFile file(path);
    file.write(std::string(3 << 20, 'x'));
    if (write(ready, "x", 1) != 1) _exit(1);
    while (true) pause();
  }

  pid_t process_ = -1;
  bool is_writing_ = false;
};

void put(const std::string& path) {
  OutputFile file(path);
  file.write("whole");
  file.commit();
}

TEST(OutputFile, RemovesWhatAKilledWriterOfTheTargetLeft) {
  const ScratchFolder folder;
  for (const std::string& name : {std::string("a.ply"), std::string(250, 'n')}) {
    Writer writer(folder.file(name));
    ASSERT_TRUE(writer.is_writing());
    const std::size_t n_files = folder.n_files();
    writer.kill();
    ASSERT_EQ(folder.n_files(), n_files) << "the killed writer leaves its temporary file";
    put(folder.file(name));
    EXPECT_EQ(folder.n_files(), n_files) << "the target in place of the temporary file";
    EXPECT_EQ(bytes_of(folder.file(name)), "whole");
  }
}

TEST(OutputFile, LeavesTheTemporaryOfALivingWriterAlone) {
  const ScratchFolder folder;
  Writer writer(folder.file("a"));
  OutputFile own(folder.file("a"));
  own.write("own");
  put(folder.file("a"));
  EXPECT_EQ(folder.n_files(), 3U) << "the target, and two that are being written";
  own.commit();
  EXPECT_EQ(bytes_of(folder.file("a")), "own");
  EXPECT_EQ(folder.n_files(), 2U);
}

TEST(OutputFile, LeavesOtherTargetsAndOtherFilesAlone) {
  const ScratchFolder folder;
  for (const char* name : {"a-1", "1", "b", "a.ply"}) {
    Writer writer(folder.file(name));
    ASSERT_TRUE(writer.is_writing());
  }
  for (const char* name : {".tinsmith-a-.tmp", ".tinsmith-a-1-2-3.tmp", ".tinsmith-a-1.tmp", ".tinsmith-a-x-1.tmp"})
    put_bytes(folder.file(name), "someone's");
  std::filesystem::create_directory(folder.file(".tinsmith-a-1-1.tmp"));
  const std::size_t n_files = folder.n_files();
  put(folder.file("a"));
  EXPECT_EQ(folder.n_files(), n_files + 1);
}

// Writers that look for abandoned files meet those that are just being made.
TEST(OutputFile, ManyWritersOfATargetDoNotDisturbEachOther) {
  const ScratchFolder folder;
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([&] {
      for (int n = 0; n < 300; ++n) {
        OutputFile file(folder.file("a"));
        file.write("whole");
        if (n % 50 == 0) EXPECT_NO_THROW(file.commit());
      }
    });
  for (std::thread& writer : writers) writer.join();
  EXPECT_EQ(bytes_of(folder.file("a")), "whole");
  EXPECT_EQ(folder.n_files(), 1U);
}

}  // namespace
}  // namespace tinsmith
