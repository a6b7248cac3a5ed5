#pragma once
// GDAL's datasets: opening them with errors that help, and lending them to threads.

#include <cpl_error.h>
#include <gdal_priv.h>

#include <condition_variable>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <vector>

#include "tinsmith/error.hpp"

namespace tinsmith {

/// While one lives, GDAL prints nothing from this thread; its last message is kept for gdal_reason().
class QuietGdal {
 public:
  QuietGdal() : pusher_(CPLQuietErrorHandler) { CPLErrorReset(); }

 private:
  CPLErrorHandlerPusher pusher_;
};

/// " (GDAL: its last message)" in one line, or nothing when there is no message.
std::string gdal_reason();

/// Opens a raster for reading. Throws UnreadableError that says why not: missing, a folder, empty, vector data,
/// only subdatasets, not a raster.
GDALDatasetUniquePtr open_raster(const std::string& path);

/// How many datasets of an input may be open at once. Each decodes and caches blocks for itself: when two threads
/// on neighbouring windows had one each, nearly all blocks were decoded twice. On 16 million samples of generated
/// mountains at 5.4 m two threads that share one take 0.85 of the time.
enum class Handles {
  kFew,  // one for each kThreadsPerHandle threads that want one at the same time
  kOne,  // threads wait for each other; no block is decoded or cached twice
};
inline constexpr int kThreadsPerHandle = 4;

/// Open datasets of the inputs. A GDALDataset may serve one thread at a time, hence each borrower has one for
/// itself. Idle ones stay open, as many as a quarter of the file descriptors allows. Thread-safe but for add().
class DatasetPool {
 public:
  DatasetPool();
  ~DatasetPool();
  DatasetPool(const DatasetPool&) = delete;
  DatasetPool& operator=(const DatasetPool&) = delete;

  /// The next input, counted from 0, and a dataset of it.
  void add(const std::string& path, GDALDatasetUniquePtr dataset, Handles handles);

  /// Gives its dataset back to the pool when it goes. A thread may hold one loan at a time.
  class Loan {
   public:
    /// Throws UnreadableError when the input can't be opened again.
    Loan(DatasetPool& pool, std::size_t input) : pool_(pool), input_(input), dataset_(pool.take(input)) {}
    ~Loan() { pool_.give_back(input_, std::move(dataset_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    GDALDataset& operator*() const { return *dataset_; }

   private:
    DatasetPool& pool_;
    std::size_t input_;
    GDALDatasetUniquePtr dataset_;
  };

 private:
  struct Input {
    std::string path;
    Handles handles = Handles::kFew;
    int n_lent = 0;
    int n_waiting = 0;
  };
  struct Idle {
    std::size_t input;
    GDALDatasetUniquePtr dataset;
  };

  GDALDatasetUniquePtr take(std::size_t input);
  GDALDatasetUniquePtr take_idle(std::size_t input);
  bool may_open(const Input& input) const;
  void give_back(std::size_t input, GDALDatasetUniquePtr dataset) noexcept;

  std::vector<Input> inputs_;
  std::size_t max_idle_;
  std::mutex mutex_;
  std::condition_variable returned_;
  std::list<Idle> idle_;  // last used first
};

}  // namespace tinsmith
