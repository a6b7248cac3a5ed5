#include "terrain_file.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <utility>

#include "tinsmith/error.hpp"

namespace tinsmith {

namespace {

constexpr std::int32_t kBlock = 512;

struct NamedType {
  std::string_view name;
  SampleType type;
  GDALDataType gdal;
};
constexpr std::array<NamedType, 4> kTypes{{
    {"int16", SampleType::kInt16, GDT_Int16},
    {"int32", SampleType::kInt32, GDT_Int32},
    {"float32", SampleType::kFloat32, GDT_Float32},
    {"float64", SampleType::kFloat64, GDT_Float64},
}};

GDALDataType gdal_type(SampleType type) {
  return std::find_if(kTypes.begin(), kTypes.end(), [&](const NamedType& t) { return t.type == type; })->gdal;
}

bool is_integer(SampleType type) { return type == SampleType::kInt16 || type == SampleType::kInt32; }

double nodata_of(const TerrainFileOptions& options) {
  return options.nodata.value_or(is_integer(options.type) ? -32768 : std::numeric_limits<double>::quiet_NaN());
}

void require(bool succeeded, const std::string& path, const char* what) {
  if (succeeded) return;
  throw OutputError(fmt::format("{}: {}: {}; check the folder, its free space and the options", path, what,
                                CPLGetLastErrorMsg()));
}

/// The upper left sample lies in the Alps (7 degrees east, 47 north, or there about in UTM zone 32).
void georeference(GDALDataset& file, const std::string& path, const Terrain& terrain, int epsg) {
  if (epsg == 0) {
    std::array<double, 6> local{0, terrain.cell, 0, 0, 0, -terrain.cell};
    require(file.SetGeoTransform(local.data()) == CE_None, path, "cannot set the georeference");
    return;
  }
  OGRSpatialReference crs;
  require(crs.importFromEPSG(epsg) == OGRERR_NONE, path, "no such EPSG code");
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  constexpr double kMetresPerDegree = 111319.49079327358;  // on the equator of WGS 84
  const double step = crs.IsGeographic() ? terrain.cell / kMetresPerDegree : terrain.cell / crs.GetLinearUnits();
  const std::array<double, 2> corner =
      crs.IsGeographic() ? std::array{7.0, 47.0}
                         : std::array{350000 / crs.GetLinearUnits(), 5200000 / crs.GetLinearUnits()};
  std::array<double, 6> transform{corner[0], step, 0, corner[1], 0, -step};
  require(file.SetGeoTransform(transform.data()) == CE_None, path, "cannot set the georeference");
  require(file.SetSpatialRef(&crs) == CE_None, path, "cannot set the CRS");
}

using File = std::unique_ptr<GDALDataset>;

File create(const std::string& path, const Terrain& terrain, const TerrainFileOptions& options) {
  CPLStringList how;
  how.SetNameValue("TILED", "YES");
  how.SetNameValue("BLOCKXSIZE", std::to_string(kBlock).c_str());
  how.SetNameValue("BLOCKYSIZE", std::to_string(kBlock).c_str());
  how.SetNameValue("COMPRESS", "DEFLATE");
  how.SetNameValue("PREDICTOR", is_integer(options.type) ? "2" : "3");
  how.SetNameValue("ZLEVEL", "1");
  how.SetNameValue("SPARSE_OK", "TRUE");
  how.SetNameValue("BIGTIFF", "IF_SAFER");
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  File file(driver->Create(path.c_str(), terrain.width, terrain.height, 1, gdal_type(options.type), how.List()));
  require(file != nullptr, path, "cannot create the file");
  georeference(*file, path, terrain, options.epsg);
  GDALRasterBand& band = *file->GetRasterBand(1);
  require(band.SetNoDataValue(nodata_of(options)) == CE_None, path, "cannot set nodata");
  require(band.SetUnitType("m") == CE_None, path, "cannot set the unit");
  return file;
}

/// Voids become nodata, heights whole numbers where the type asks for them. False when all is void.
bool encode(HeightGrid& grid, const TerrainFileOptions& options) {
  const double nodata = nodata_of(options);
  bool any = false;
  for (double& z : grid.z) {
    if (std::isnan(z)) {
      z = nodata;
    } else {
      any = true;
      if (is_integer(options.type)) z = std::floor(z + 0.5);
    }
  }
  return any;
}

void write_blocks(GDALDataset& file, const std::string& path, const Terrain& terrain,
                  const TerrainFileOptions& options) {
  for (std::int32_t y = 0; y < terrain.height; y += kBlock) {
    for (std::int32_t x = 0; x < terrain.width; x += kBlock) {
      const GridRect rect{x, y, std::min(kBlock, terrain.width - x), std::min(kBlock, terrain.height - y)};
      HeightGrid grid = heights_of(terrain, rect);
      if (!encode(grid, options)) continue;
      const CPLErr status = file.GetRasterBand(1)->RasterIO(GF_Write, x, y, rect.width, rect.height, grid.z.data(),
                                                            rect.width, rect.height, GDT_Float64, 0, 0, nullptr);
      require(status == CE_None, path, "cannot write");
    }
  }
}

}  // namespace

void write_terrain(const std::string& path, const Terrain& terrain, const TerrainFileOptions& options) {
  GDALAllRegister();
  const std::string aside = path + ".part";
  try {
    File file = create(aside, terrain, options);
    write_blocks(*file, aside, terrain, options);
    CPLErrorReset();
    file.reset();  // the last blocks are written here; GDAL tells of a failure in the last error only
    require(CPLGetLastErrorType() < CE_Failure, aside, "cannot write");
    std::filesystem::rename(aside, path);
  } catch (const std::exception&) {
    std::error_code ignored;
    std::filesystem::remove(aside, ignored);
    throw;
  }
}

std::optional<SampleType> sample_type(std::string_view name) {
  const auto* found =
      std::find_if(kTypes.begin(), kTypes.end(), [&](const NamedType& t) { return t.name == name; });
  if (found == kTypes.end()) return std::nullopt;
  return found->type;
}

}  // namespace tinsmith
