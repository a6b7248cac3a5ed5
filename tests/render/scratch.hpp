#pragma once
// Small rasters, meshes and pictures in a folder that goes away with the test.

#include <cairo.h>
#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <stdlib.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "io/mesh_file.hpp"

namespace tinsmith::test {

inline constexpr double kNodata = -9999;

class Scratch {
 public:
  Scratch() : folder_(std::filesystem::temp_directory_path() / "tinsmith-render-XXXXXX") {
    std::string name = folder_.string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
  }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  ~Scratch() { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::size_t n_files() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }

 private:
  std::filesystem::path folder_;
};

struct RasterRecipe {
  int width = 0;
  int height = 0;
  std::function<double(int column, int row)> z;
  std::array<double, 6> geotransform{400000, 10, 0, 5100000, 0, -10};
  int epsg = 32632;
};

inline std::string wkt_of(int epsg) {
  OGRSpatialReference crs;
  crs.importFromEPSG(epsg);
  char* text = nullptr;
  crs.exportToWkt(&text);
  std::string wkt = text;
  CPLFree(text);
  return wkt;
}

inline void write_raster(const std::string& path, const RasterRecipe& recipe) {
  GDALAllRegister();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const GDALDatasetUniquePtr dataset(
      driver->Create(path.c_str(), recipe.width, recipe.height, 1, GDT_Float64, nullptr));
  std::array<double, 6> geotransform = recipe.geotransform;
  dataset->SetGeoTransform(geotransform.data());
  dataset->SetProjection(wkt_of(recipe.epsg).c_str());
  dataset->GetRasterBand(1)->SetNoDataValue(kNodata);
  std::vector<double> row(static_cast<std::size_t>(recipe.width));
  for (int y = 0; y < recipe.height; ++y) {
    for (int x = 0; x < recipe.width; ++x) row[static_cast<std::size_t>(x)] = recipe.z(x, y);
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, y, recipe.width, 1, row.data(), recipe.width, 1,
                                                  GDT_Float64, 0, 0, nullptr),
              CE_None);
  }
}

inline GridFrame frame_of(const RasterRecipe& recipe) {
  GridFrame frame;
  frame.geotransform = recipe.geotransform;
  frame.crs_wkt = wkt_of(recipe.epsg);
  return frame;
}

/// Every `step`-th sample and the last ones, two triangles for each of the cells between.
inline TerrainMesh thinned_grid(const RasterRecipe& recipe, int step) {
  const auto places = [step](int count) {
    std::vector<int> at;
    for (int i = 0; i < count - 1; i += step) at.push_back(i);
    at.push_back(count - 1);
    return at;
  };
  const std::vector<int> columns = places(recipe.width);
  const std::vector<int> rows = places(recipe.height);
  TerrainMesh mesh;
  for (const int y : rows) {
    for (const int x : columns) {
      mesh.position.push_back({x * kLatticePerCell, y * kLatticePerCell});
      mesh.height.push_back(recipe.z(x, y));
    }
  }
  const auto n = static_cast<std::uint32_t>(columns.size());
  for (std::uint32_t y = 0; y + 1 < rows.size(); ++y) {
    for (std::uint32_t x = 0; x + 1 < n; ++x) {
      const std::uint32_t a = y * n + x;
      mesh.triangles.push_back({a, a + 1, a + n + 1});
      mesh.triangles.push_back({a, a + n + 1, a + n});
    }
  }
  return mesh;
}

struct Rgb {
  int r, g, b;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

class Picture {
 public:
  explicit Picture(cairo_surface_t* surface) : surface_(surface, &cairo_surface_destroy) {
    cairo_surface_flush(surface);
  }
  static Picture load(const std::string& png) { return Picture(cairo_image_surface_create_from_png(png.c_str())); }

  bool is_valid() const { return cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS; }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }
  Rgb at(int x, int y) const {
    const unsigned char* const pixel =
        cairo_image_surface_get_data(surface_.get()) +
        static_cast<std::ptrdiff_t>(y) * cairo_image_surface_get_stride(surface_.get()) +
        static_cast<std::ptrdiff_t>(4) * x;
    return {pixel[2], pixel[1], pixel[0]};
  }

 private:
  std::shared_ptr<cairo_surface_t> surface_;
};

}  // namespace tinsmith::test
