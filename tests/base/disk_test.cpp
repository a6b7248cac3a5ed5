#include "base/disk.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "support/file_size_limit.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

TEST(AppendToFile, AppendsAllOrNothing) {
  const std::string path = testing::TempDir() + "tinsmith_append_all_or_nothing";
  std::remove(path.c_str());
  EXPECT_EQ(append_to_file(path, "whole "), 0U);
  {
    const test::FileSizeLimit limit(10);
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
