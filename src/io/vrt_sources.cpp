#include "io/vrt_sources.hpp"

#include <cpl_minixml.h>
#include <cpl_string.h>
#include <fmt/format.h>

#include <cstring>
#include <filesystem>
#include <memory>

#include "io/raster_dataset.hpp"

namespace tinsmith {
namespace {

using Xml = std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)>;

std::string file_of(const char* source_xml, const std::string& vrt) {
  const Xml source(CPLParseXMLString(source_xml), CPLDestroyXMLNode);
  const CPLXMLNode* const file = source ? CPLGetXMLNode(source.get(), "SourceFilename") : nullptr;
  if (file == nullptr) return "";
  const std::string name = CPLGetXMLValue(file, "", "");
  const bool is_relative = std::strcmp(CPLGetXMLValue(file, "relativeToVRT", "0"), "1") == 0;
  return is_relative ? (std::filesystem::path(vrt).parent_path() / name).string() : name;
}

std::string reason_at(GDALRasterBand& band, const std::string& path, int depth);

std::string reason_of(const std::string& file, int depth) {
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  if (dataset == nullptr) return gdal_reason();
  return dataset->GetRasterCount() > 0 ? reason_at(*dataset->GetRasterBand(1), file, depth + 1) : "";
}

std::string reason_at(GDALRasterBand& band, const std::string& path, int depth) {
  constexpr int kDeepest = 8;  // VRTs in VRTs, which may go round in circles
  if (depth > kDeepest) return "";
  char** const sources = band.GetMetadata("vrt_sources");
  for (int i = 0; i < CSLCount(sources); ++i) {
    const char* const xml = std::strchr(sources[i], '=');  // behind the name of the item
    const std::string file = xml == nullptr ? "" : file_of(xml + 1, path);
    std::string reason = file.empty() ? "" : reason_of(file, depth);
    if (!reason.empty()) return reason;
  }
  return "";
}

}  // namespace

std::string reason_of_vrt(GDALRasterBand& band, const std::string& path) {
  const QuietGdal quiet;
  return reason_at(band, path, 0);
}

}  // namespace tinsmith
