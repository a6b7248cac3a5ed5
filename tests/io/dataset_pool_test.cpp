// No two threads decode the same block, and neighbours seldom wait for each other.

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/raster_blocks.hpp"
#include "io/raster_dataset.hpp"

namespace tinsmith {
namespace {

std::string write_raster(const std::string& name) {
  GDALAllRegister();
  std::string path = testing::TempDir() + name;
  GDALClose(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 4, 4, 1, GDT_Byte, nullptr));
  return path;
}

TEST(DatasetPool, HasOneDatasetForEachStripeWhichOneThreadMayHold) {
  DatasetPool pool;
  const std::string path = write_raster("stripes.tif");
  pool.add(path, open_raster(path));
  auto first = std::make_unique<DatasetPool::Loan>(pool, 0, 0);
  GDALDataset* const dataset = &**first;
  std::vector<std::unique_ptr<DatasetPool::Loan>> others;
  for (std::size_t stripe = 1; stripe < kStripes; ++stripe) {
    others.push_back(std::make_unique<DatasetPool::Loan>(pool, 0, stripe));
    EXPECT_NE(&**others.back(), dataset);
  }
  std::atomic<bool> is_served = false;
  std::thread waiting([&] {
    const DatasetPool::Loan loan(pool, 0, 0);
    is_served = true;
    EXPECT_EQ(&*loan, dataset);
  });
  EXPECT_FALSE(is_served);
  first.reset();
  waiting.join();
  EXPECT_TRUE(is_served);
}

TEST(DatasetPool, LendsAgainAfterAFileCouldNotBeOpened) {
  DatasetPool pool;
  const std::string path = write_raster("gone.tif");
  pool.add(path, open_raster(path));
  VSIUnlink(path.c_str());
  for (int i = 0; i < 2; ++i) EXPECT_THROW(DatasetPool::Loan(pool, 0, 1), UnreadableError);
  EXPECT_NO_THROW(DatasetPool::Loan(pool, 0, 0));
}

// For any blocks: the parts cover the rectangle from left to right, no block lies in two stripes.
TEST(Stripes, CutRectanglesWhereNoBlockIsCut) {
  for (const std::int32_t block : {1, 100, 128, 256, 300, 1000, 5000}) {
    RasterSource source;
    source.width = source.height = 5000;
    source.block_width = block;
    for (const GridRect& rect : {GridRect{0, 0, 5000, 10}, GridRect{777, 5, 194, 194}, GridRect{4999, 0, 1, 1}}) {
      std::int32_t x = rect.x0;
      for (const auto& [stripe, part] : stripes_of(source, rect)) {
        EXPECT_LT(stripe, kStripes);
        EXPECT_EQ(part, (GridRect{x, rect.y0, part.width, rect.height}));
        if (x > rect.x0) EXPECT_EQ(x % block, 0) << "blocks of " << block;
        x += part.width;
        for (std::int32_t inside = part.x0; inside < x; ++inside)
          EXPECT_EQ(stripes_of(source, {inside, 0, 1, 1}).front().stripe, stripe);
      }
      EXPECT_EQ(x, rect.x0 + rect.width);
    }
  }
}

}  // namespace
}  // namespace tinsmith
