#pragma once
// GDAL's datasets: opening them with errors that help, and lending them to threads.

#include <cpl_error.h>
#include <gdal_priv.h>

#include <array>
#include <condition_variable>
#include <cstdint>
#include <list>
#include <mutex>
#include <string>
#include <vector>

#include "io/raster_blocks.hpp"
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

/// Open datasets of the inputs: of each as many as it has stripes (raster_blocks.hpp), with one thread at a time at
/// each, as GDAL asks, so that no block is decoded or cached twice. Idle ones stay open, as many as a quarter of
/// the file descriptors allows. Thread-safe but for add().
class DatasetPool {
  struct Place {
    std::size_t input;
    std::size_t stripe;
    friend bool operator==(const Place&, const Place&) = default;
  };

 public:
  DatasetPool();
  ~DatasetPool();
  DatasetPool(const DatasetPool&) = delete;
  DatasetPool& operator=(const DatasetPool&) = delete;

  /// The next input, counted from 0, and the dataset of its first stripe.
  void add(const std::string& path, GDALDatasetUniquePtr dataset);

  /// Gives its dataset back to the pool when it goes. A thread may hold one loan at a time.
  class Loan {
   public:
    /// Throws UnreadableError when the input can't be opened again.
    Loan(DatasetPool& pool, std::size_t input, std::size_t stripe)
        : pool_(pool), place_{input, stripe}, dataset_(pool.take(place_)) {}
    ~Loan() { pool_.give_back(place_, std::move(dataset_)); }
    Loan(const Loan&) = delete;
    Loan& operator=(const Loan&) = delete;
    GDALDataset& operator*() const { return *dataset_; }

   private:
    DatasetPool& pool_;
    Place place_;
    GDALDatasetUniquePtr dataset_;
  };

 private:
  struct Input {
    std::string path;
    std::array<bool, kStripes> is_lent{};
  };
  struct Idle {
    Place place;
    GDALDatasetUniquePtr dataset;
  };

  GDALDatasetUniquePtr take(const Place& place);
  GDALDatasetUniquePtr take_idle(const Place& place);
  void give_back(const Place& place, GDALDatasetUniquePtr dataset) noexcept;

  std::vector<Input> inputs_;
  std::size_t max_idle_;
  std::mutex mutex_;
  std::condition_variable returned_;
  std::list<Idle> idle_;  // last used first
};

}  // namespace tinsmith
