#include "io/raster_dataset.hpp"

#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>

#include <algorithm>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// Mosaics of thousands of tiles must not run out of file descriptors (1024 by default); 64 serve any number
// of threads that work on neighbouring windows.
constexpr std::size_t kMaxIdle = 64;

// A message that only repeats that the file is no raster says nothing new.
bool says_more(const std::string& message) {
  return !message.empty() && message.find("not recognized as a supported file format") == std::string::npos &&
         message.find("No such file or directory") == std::string::npos &&
         message.find("does not exist in the file system") == std::string::npos;
}

bool holds_vectors(const std::string& path) {
  const auto driver = GDALIdentifyDriverEx(path.c_str(), GDAL_OF_VECTOR, nullptr, nullptr);
  return driver != nullptr && GDALGetMetadataItem(driver, GDAL_DCAP_RASTER, nullptr) == nullptr;
}

bool opens_as_vectors(const std::string& path) {
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
  return dataset != nullptr && dataset->GetLayerCount() > 0;
}

[[noreturn]] void refuse(const std::string& path) {
  const std::string reason = says_more(CPLGetLastErrorMsg()) ? gdal_reason() : "";
  VSIStatBufL stat;
  if (path.empty()) throw InputError("the name of an input is empty; name a raster file");
  if (VSIStatL(path.c_str(), &stat) != 0) {
    throw InputError(fmt::format("{}: no such file{}; check the path", path, reason));
  }
  if (VSI_ISDIR(stat.st_mode))
    throw InputError(fmt::format("{}: a folder, not a raster; name the files in it", path));
  if (stat.st_size == 0) throw InputError(fmt::format("{}: an empty file, not a raster; get it again", path));
  if (holds_vectors(path) || opens_as_vectors(path)) {
    throw InputError(fmt::format("{}: vector data, not a raster; make a raster of it first with gdal_grid", path));
  }
  throw InputError(fmt::format("{}: not a raster that GDAL can read{}; see what gdalinfo says", path, reason));
}

void require_band(GDALDataset& dataset, const std::string& path) {
  if (dataset.GetRasterCount() > 0) return;
  char** names = dataset.GetMetadata("SUBDATASETS");
  const char* first = CSLFetchNameValue(names, "SUBDATASET_1_NAME");
  if (first == nullptr) throw InputError(fmt::format("{}: holds no raster band; see what gdalinfo says", path));
  throw InputError(
      fmt::format("{}: holds {} rasters; name one of them, for example '{}'", path, CSLCount(names) / 2, first));
}

}  // namespace

std::string gdal_reason() {
  std::string message = CPLGetLastErrorMsg();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "" : fmt::format(" (GDAL: {})", message);
}

GDALDatasetUniquePtr open_raster(const std::string& path) {
  GDALAllRegister();
  const QuietGdal quiet;
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (dataset == nullptr) refuse(path);
  require_band(*dataset, path);
  return dataset;
}

DatasetPool::~DatasetPool() {
  const QuietGdal quiet;
  idle_.clear();
}

GDALDatasetUniquePtr DatasetPool::take(std::size_t input) {
  {
    const std::lock_guard lock(mutex_);
    const auto found =
        std::find_if(idle_.begin(), idle_.end(), [input](const Idle& idle) { return idle.input == input; });
    if (found != idle_.end()) {
      GDALDatasetUniquePtr dataset = std::move(found->dataset);
      idle_.erase(found);
      return dataset;
    }
  }
  return open_raster(paths_[input]);
}

void DatasetPool::give_back(std::size_t input, GDALDatasetUniquePtr dataset) noexcept {
  const QuietGdal quiet;
  std::list<Idle> closed;  // outside the lock
  const std::lock_guard lock(mutex_);
  idle_.push_front({input, std::move(dataset)});
  if (idle_.size() > kMaxIdle) closed.splice(closed.begin(), idle_, std::prev(idle_.end()));
}

}  // namespace tinsmith
