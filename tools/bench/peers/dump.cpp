// dump INPUT... OUT.grid: the samples that tinsmith reads, as a grid file for the peers (grid.hpp).

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

void write(std::ofstream& file, const std::vector<float>& z) {
  file.write(reinterpret_cast<const char*>(z.data()), static_cast<std::streamsize>(z.size() * sizeof(float)));
}

void dump(const std::vector<std::string>& inputs, const std::string& output) {
  const RasterField field(inputs, {});
  const GridRect rect{0, 0, field.width(), field.height()};
  const HeightGrid grid = field.read(rect);
  std::vector<float> z(grid.z.begin(), grid.z.end());
  const bool has_voids = std::any_of(z.begin(), z.end(), [](float v) { return std::isnan(v); });
  std::ofstream file(output, std::ios::binary);
  file << header(field, has_voids);
  write(file, z);
  if (has_voids) {
    fill_voids(z, rect);
    write(file, z);
  }
  if (!file.flush()) throw std::runtime_error(output + ": can't be written; check the folder and its free space");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: dump INPUT... OUT.grid\n");
    return 2;
  }
  try {
    GDALAllRegister();
    dump({argv + 1, argv + argc - 1}, argv[argc - 1]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "dump: %s\n", error.what());
    return 1;
  }
}
