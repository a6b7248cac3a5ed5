#include "base/disk.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstdio>
#include <string>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

/// No file grows beyond so many bytes while it lives: the last write that fits in part is short.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit now{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }

 private:
  rlimit before_{};
  void (*signal_)(int);
};

TEST(AppendToFile, AppendsAllOrNothing) {
  const std::string path = testing::TempDir() + "tinsmith_append_all_or_nothing";
  std::remove(path.c_str());
  EXPECT_EQ(append_to_file(path, "whole "), 0U);
  {
    const FileSizeLimit limit(10);
    EXPECT_THROW(append_to_file(path, "does not fit"), OutputError);
    EXPECT_EQ(read_from_file(path, 0, 100), "whole ");
    EXPECT_EQ(append_to_file(path, "fits"), 6U);
  }
  EXPECT_EQ(append_to_file(path, " again"), 10U);
  EXPECT_EQ(read_from_file(path, 0, 100), "whole fits again");
  std::remove(path.c_str());
}

}  // namespace
}  // namespace tinsmith
