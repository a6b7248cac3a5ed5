// Threads share open datasets, so that no block is decoded for each of them, but not all threads one.

#include <gtest/gtest.h>

#include <atomic>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/raster_dataset.hpp"

namespace tinsmith {
namespace {

std::string write_raster(const std::string& name) {
  GDALAllRegister();
  std::string path = testing::TempDir() + name;
  GDALClose(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path.c_str(), 4, 4, 1, GDT_Byte, nullptr));
  return path;
}

// Threads that each want a dataset of input 0 and keep it until released.
class Borrowers {
 public:
  Borrowers(DatasetPool& pool, int n) {
    for (int i = 0; i < n; ++i) threads_.emplace_back([this, &pool] { borrow(pool); });
  }
  ~Borrowers() {
    release();
    for (std::thread& thread : threads_) thread.join();
  }
  Borrowers(const Borrowers&) = delete;
  Borrowers& operator=(const Borrowers&) = delete;

  GDALDataset* first() { return first_.get_future().get(); }
  int n_served() const { return n_served_; }
  void release() {
    if (!is_released_.exchange(true)) release_.set_value();
  }

 private:
  void borrow(DatasetPool& pool) {
    const std::shared_future<void> released = released_;
    const DatasetPool::Loan loan(pool, 0);
    if (n_served_++ == 0) first_.set_value(&*loan);
    released.wait();
  }

  std::promise<void> release_;
  std::shared_future<void> released_ = release_.get_future();
  std::atomic<bool> is_released_ = false;
  std::promise<GDALDataset*> first_;
  std::atomic<int> n_served_ = 0;
  std::vector<std::thread> threads_;
};

TEST(DatasetPool, OpensAnotherDatasetForEveryFourThreadsThatWantOneAtOnce) {
  DatasetPool pool;
  const std::string path = write_raster("shared.tif");
  pool.add(path, open_raster(path), Handles::kFew);
  auto held = std::make_unique<DatasetPool::Loan>(pool, 0);
  Borrowers borrowers(pool, kThreadsPerHandle);
  EXPECT_NE(borrowers.first(), &**held);  // ends only if the fifth thread is served
  EXPECT_EQ(borrowers.n_served(), 1) << "the others wait";
  held.reset();
}

TEST(DatasetPool, LendsOneDatasetAfterTheOther) {
  DatasetPool pool;
  const std::string path = write_raster("alone.tif");
  pool.add(path, open_raster(path), Handles::kOne);
  auto held = std::make_unique<DatasetPool::Loan>(pool, 0);
  GDALDataset* const only = &**held;
  Borrowers borrowers(pool, 2 * kThreadsPerHandle);
  EXPECT_EQ(borrowers.n_served(), 0);
  held.reset();
  EXPECT_EQ(borrowers.first(), only);
}

TEST(DatasetPool, LendsAgainAfterAFileCouldNotBeOpened) {
  DatasetPool pool;
  const std::string path = write_raster("gone.tif");
  pool.add(path, open_raster(path), Handles::kFew);
  VSIUnlink(path.c_str());
  auto held = std::make_unique<DatasetPool::Loan>(pool, 0);
  std::atomic<int> n_refused = 0;
  std::vector<std::thread> threads;
  for (int i = 0; i < kThreadsPerHandle; ++i) {
    threads.emplace_back([&] {
      try {
        const DatasetPool::Loan loan(pool, 0);
      } catch (const UnreadableError&) {
        ++n_refused;
      }
    });
  }
  while (n_refused == 0) std::this_thread::yield();
  held.reset();
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(n_refused, 1) << "who waited was served by the one that is open";
}

}  // namespace
}  // namespace tinsmith
