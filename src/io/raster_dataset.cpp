#include "io/raster_dataset.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <sys/resource.h>

#include <algorithm>
#include <limits>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

// Mosaics of thousands of tiles must not run out of file descriptors (1024 by default), of which each dataset
// takes one or, with a mask beside it, a few. 256 serve a row of windows across 128 tiles.
std::size_t max_idle() {
  constexpr rlim_t kMost = 256;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0) return 16;
  return static_cast<std::size_t>(std::clamp<rlim_t>(limit.rlim_cur / 4, 1, kMost));
}

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
  if (path.empty()) throw UnreadableError("the name of an input is empty; name a raster file");
  if (VSIStatL(path.c_str(), &stat) != 0) {
    throw UnreadableError(fmt::format("{}: no such file{}; check the path", path, reason));
  }
  if (VSI_ISDIR(stat.st_mode))
    throw UnreadableError(fmt::format("{}: a folder, not a raster; name the files in it", path));
  if (stat.st_size == 0) throw UnreadableError(fmt::format("{}: an empty file, not a raster; get it again", path));
  if (holds_vectors(path) || opens_as_vectors(path)) {
    throw UnreadableError(
        fmt::format("{}: vector data, not a raster; make a raster of it first with gdal_grid", path));
  }
  throw UnreadableError(fmt::format("{}: not a raster that GDAL can read{}; see what gdalinfo says", path, reason));
}

void require_band(GDALDataset& dataset, const std::string& path) {
  if (dataset.GetRasterCount() > 0) return;
  char** names = dataset.GetMetadata("SUBDATASETS");
  const char* first = CSLFetchNameValue(names, "SUBDATASET_1_NAME");
  if (first == nullptr)
    throw UnreadableError(fmt::format("{}: holds no raster band; see what gdalinfo says", path));
  throw UnreadableError(
      fmt::format("{}: holds {} rasters; name one of them, for example '{}'", path, CSLCount(names) / 2, first));
}

GDALDatasetUniquePtr open_with_what_is_registered(const std::string& path) {
  return GDALDatasetUniquePtr(
      GDALDataset::Open(path.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
}

// GeoTIFF first: registering all of GDAL's drivers takes 6 ms and 6 MB, for every tile of a pipeline that starts
// tinsmith for each. Of the others only VRT, which takes no TIFF, is asked before GeoTIFF when all are there; and
// HFA reads the .aux file that may lie beside one.
GDALDatasetUniquePtr open_dataset(const std::string& path) {
  GDALRegister_GTiff();
  GDALRegister_HFA();
  GDALDatasetUniquePtr dataset = open_with_what_is_registered(path);
  if (dataset != nullptr) return dataset;
  CPLErrorReset();
  GDALAllRegister();
  return open_with_what_is_registered(path);
}

}  // namespace

std::string gdal_reason() {
  std::string message = CPLGetLastErrorMsg();
  std::replace(message.begin(), message.end(), '\n', ' ');
  return message.empty() ? "" : fmt::format(" (GDAL: {})", message);
}

GDALDatasetUniquePtr open_raster(const std::string& path) {
  const QuietGdal quiet;
  // Looking for each sidecar file by its name: listing a folder of thousands for each of them took twice as long.
  const CPLConfigOptionSetter no_listing("GDAL_DISABLE_READDIR_ON_OPEN", "TRUE", true);
  GDALDatasetUniquePtr dataset = open_dataset(path);
  if (dataset == nullptr) refuse(path);
  require_band(*dataset, path);
  return dataset;
}

DatasetPool::DatasetPool() : max_idle_(max_idle()) {}

DatasetPool::~DatasetPool() {
  const QuietGdal quiet;
  idle_.clear();
}

void DatasetPool::add(const std::string& path, GDALDatasetUniquePtr dataset) {
  inputs_.push_back({path, {}});
  give_back({inputs_.size() - 1, 0}, std::move(dataset));
}

GDALDatasetUniquePtr DatasetPool::take_idle(const Place& place) {
  bool& is_lent = inputs_[place.input].is_lent[place.stripe];
  std::unique_lock lock(mutex_);
  returned_.wait(lock, [&] { return !is_lent; });
  is_lent = true;
  const auto found =
      std::find_if(idle_.begin(), idle_.end(), [&](const Idle& idle) { return idle.place == place; });
  if (found == idle_.end()) return nullptr;
  GDALDatasetUniquePtr dataset = std::move(found->dataset);
  idle_.erase(found);
  return dataset;
}

GDALDatasetUniquePtr DatasetPool::take(const Place& place) {
  GDALDatasetUniquePtr dataset = take_idle(place);
  if (dataset != nullptr) return dataset;
  try {
    return open_raster(inputs_[place.input].path);
  } catch (...) {
    give_back(place, nullptr);
    throw;
  }
}

void DatasetPool::give_back(const Place& place, GDALDatasetUniquePtr dataset) noexcept {
  const QuietGdal quiet;
  std::list<Idle> closed;  // outside the lock
  const std::lock_guard lock(mutex_);
  inputs_[place.input].is_lent[place.stripe] = false;
  returned_.notify_all();
  if (dataset == nullptr) return;
  idle_.push_front({place, std::move(dataset)});
  if (idle_.size() > max_idle_) closed.splice(closed.begin(), idle_, std::prev(idle_.end()));
}

}  // namespace tinsmith
