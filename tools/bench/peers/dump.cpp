// dump INPUT... OUT.grid: the samples that tinsmith reads, as a grid file for the peers (grid.hpp).
// dump --fill INPUT... OUT.tif: the same with the voids filled in, as a GeoTIFF in metres.

#include <gdal_alg.h>
#include <gdal_priv.h>

#include <cmath>
#include <cstdio>
#include <exception>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "io/raster_field.hpp"

namespace {

using tinsmith::GridRect;
using tinsmith::HeightGrid;
using tinsmith::RasterField;

std::string header(const RasterField& field, bool has_voids) {
  const auto& frame = field.frame();
  std::string crs = frame.crs_wkt;
  std::erase(crs, '\n');
  const nlohmann::json json = {{"width", field.width()},
                               {"height", field.height()},
                               {"step", frame.metres_per_step(field.width() / 2.0, field.height() / 2.0)},
                               {"unit", frame.metres_per_vertical_unit},
                               {"geotransform", frame.geotransform},
                               {"crs", crs},
                               {"has_voids", has_voids}};
  std::string line = json.dump();
  line.append(7 - line.size() % 8, ' ');
  return line + '\n';
}

/// GDAL's inverse-distance filling from the nearest valid samples around.
void fill_voids(std::vector<float>& z, const GridRect& rect) {
  std::vector<std::uint8_t> is_valid(z.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    is_valid[i] = !std::isnan(z[i]);
    if (!is_valid[i]) z[i] = 0;
  }
  GDALDriver* memory = GetGDALDriverManager()->GetDriverByName("MEM");
  const auto raster = [&](void* data, const char* type) {
    std::unique_ptr<GDALDataset> set(memory->Create("", rect.width, rect.height, 0, GDT_Byte, nullptr));
    char pointer[64] = {};
    CPLPrintPointer(pointer, data, sizeof pointer - 1);
    const std::string option = std::string("DATAPOINTER=") + pointer;
    const char* options[] = {option.c_str(), nullptr};
    set->AddBand(GDALGetDataTypeByName(type), const_cast<char**>(options));
    return set;
  };
  const auto heights = raster(z.data(), "Float32");
  const auto mask = raster(is_valid.data(), "Byte");
  if (GDALFillNodata(heights->GetRasterBand(1), mask->GetRasterBand(1), rect.width + rect.height, 0, 0, nullptr,
                     nullptr, nullptr) != CE_None)
    throw std::runtime_error("GDAL could not fill the voids");
}

std::vector<float> read(const RasterField& field, const GridRect& rect) {
  const HeightGrid grid = field.read(rect);
  return {grid.z.begin(), grid.z.end()};
}

void dump(const RasterField& field, const std::string& output) {
  const std::vector<float> z = read(field, {0, 0, field.width(), field.height()});
  std::ofstream file(output, std::ios::binary);
  file << header(field, std::any_of(z.begin(), z.end(), [](float v) { return std::isnan(v); }));
  file.write(reinterpret_cast<const char*>(z.data()), static_cast<std::streamsize>(z.size() * sizeof(float)));
  if (!file.flush()) throw std::runtime_error(output + ": can't be written; check the folder and its free space");
}

void dump_filled(const RasterField& field, const std::string& output) {
  const GridRect rect{0, 0, field.width(), field.height()};
  std::vector<float> z = read(field, rect);
  fill_voids(z, rect);
  const auto& frame = field.frame();
  for (float& v : z) v *= static_cast<float>(frame.metres_per_vertical_unit);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const std::unique_ptr<GDALDataset> set(
      driver->Create(output.c_str(), rect.width, rect.height, 1, GDT_Float32, nullptr));
  if (!set) throw std::runtime_error(output + ": can't be written; check the folder");
  auto geotransform = frame.geotransform;
  set->SetGeoTransform(geotransform.data());
  set->SetProjection(frame.crs_wkt.c_str());
  GDALRasterBand& band = *set->GetRasterBand(1);
  band.SetUnitType("m");
  if (band.RasterIO(GF_Write, 0, 0, rect.width, rect.height, z.data(), rect.width, rect.height, GDT_Float32, 0, 0,
                    nullptr) != CE_None)
    throw std::runtime_error(output + ": can't be written; check the free space");
}

}  // namespace

int main(int argc, char** argv) {
  const bool is_filled = argc > 1 && std::string(argv[1]) == "--fill";
  const int first = is_filled ? 2 : 1;
  if (argc < first + 2) {
    std::fprintf(stderr, "usage: dump [--fill] INPUT... OUT\n");
    return 2;
  }
  try {
    GDALAllRegister();
    const RasterField field({argv + first, argv + argc - 1}, {});
    (is_filled ? dump_filled : dump)(field, argv[argc - 1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dump: %s\n", error.what());
    return 1;
  }
}
