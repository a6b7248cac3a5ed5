#include "io/raster_description.hpp"

#include <fmt/format.h>

#include "io/raster_dataset.hpp"
#include "io/raster_source.hpp"

namespace tinsmith {
namespace {

std::string validity(const RasterSource& source) {
  std::string text = source.nodata ? fmt::format("{}", *source.nodata) : "none";
  if (source.has_mask) text += ", mask band";
  if (source.alpha_band > 0) text += fmt::format(", alpha in band {}", source.alpha_band);
  return text;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> describe_raster_file(const std::string& path,
                                                                      const InputOptions& options) {
  const QuietGdal quiet;
  const GDALDatasetUniquePtr dataset = open_raster(path);
  const RasterSource source = read_source(*dataset, path, options);
  std::vector<std::pair<std::string, std::string>> entries{
      {"format", dataset->GetDriver()->GetMetadataItem(GDAL_DMD_LONGNAME)},
      {"size", fmt::format("{} x {} samples", source.width, source.height)},
      {"bands", fmt::format("{}", dataset->GetRasterCount())},
      {"type", fmt::format("{} (band {})", GDALGetDataTypeName(source.type), source.band)},
      {"nodata", validity(source)}};
  if (source.scale != 1 || source.offset != 0)
    entries.emplace_back("height", fmt::format("value * {} + {}", source.scale, source.offset));
  if (!source.height_unit.empty()) entries.emplace_back("band unit", source.height_unit);
  return entries;
}

}  // namespace tinsmith
