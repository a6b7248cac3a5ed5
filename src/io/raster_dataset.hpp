#pragma once
// GDAL's datasets: opening them with errors that help, and lending them to threads.

#include <cpl_error.h>
#include <gdal_priv.h>

#include <list>
#include <mutex>
#include <string>
#include <vector>

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

/// Opens a raster for reading. Throws InputError that says why not: missing, a folder, empty, vector data,
/// only subdatasets, not a raster.
GDALDatasetUniquePtr open_raster(const std::string& path);

/// Open datasets of the inputs. A GDALDataset may serve one thread at a time, hence each borrower has one for
/// itself. Thread-safe.
class DatasetPool {
 public:
  explicit DatasetPool(std::vector<std::string> paths) : paths_(std::move(paths)) {}
  ~DatasetPool();
  DatasetPool(const DatasetPool&) = delete;
  DatasetPool& operator=(const DatasetPool&) = delete;

  /// Gives its dataset back to the pool when it goes.
  class Loan {
   public:
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
  struct Idle {
    std::size_t input;
    GDALDatasetUniquePtr dataset;
  };

  GDALDatasetUniquePtr take(std::size_t input);
  void give_back(std::size_t input, GDALDatasetUniquePtr dataset) noexcept;

  std::vector<std::string> paths_;
  std::mutex mutex_;
  std::list<Idle> idle_;  // last used first
};

}  // namespace tinsmith
