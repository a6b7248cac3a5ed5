#pragma once
// Small rasters in a folder of their own, for the tests of reading.

#include <gdal_priv.h>
#include <gtest/gtest.h>
#include <ogr_spatialref.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/raster_field.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {

/// What to write; every test changes what it is about.
struct RasterRecipe {
  int width = 3;
  int height = 2;
  GDALDataType type = GDT_Int16;
  std::vector<double> values{1, 2, 3, 4, 5, 6};
  std::string crs = "EPSG:32632";
  std::optional<std::array<double, 6>> geotransform = std::array<double, 6>{400000, 30, 0, 5100000, 0, -30};
  std::vector<std::string> creation = {};           // GTiff creation options
  std::function<void(GDALDataset&)> declare = {};   // before the values are written
  std::function<void(GDALDataset&)> complete = {};  // after
};

/// A fresh folder for each test, gone after it.
class RasterTest : public testing::Test {
 protected:
  RasterTest() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::path(testing::TempDir()) /
              (std::string("tinsmith_") + test->name() + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    GDALAllRegister();
  }
  ~RasterTest() override { std::filesystem::remove_all(folder_); }

  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  std::string write(const std::string& name, const RasterRecipe& recipe, const char* driver = "GTiff") const {
    CPLStringList creation;
    for (const std::string& option : recipe.creation) creation.AddString(option.c_str());
    GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName(driver)->Create(
        path(name).c_str(), recipe.width, recipe.height, 1, recipe.type, creation.List()));
    declare_place(*dataset, recipe);
    if (recipe.declare) recipe.declare(*dataset);
    std::vector<double> values = recipe.values;
    EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, recipe.width, recipe.height, values.data(),
                                                  recipe.width, recipe.height, GDT_Float64, 0, 0, nullptr),
              CE_None);
    if (recipe.complete) recipe.complete(*dataset);
    return path(name);
  }

  std::string write_text(const std::string& name, const std::string& text) const {
    std::ofstream(path(name), std::ios::binary) << text;
    return path(name);
  }

 private:
  static void declare_place(GDALDataset& dataset, const RasterRecipe& recipe) {
    if (!recipe.crs.empty()) {
      OGRSpatialReference crs;
      EXPECT_EQ(crs.SetFromUserInput(recipe.crs.c_str()), OGRERR_NONE);
      crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
      dataset.SetSpatialRef(&crs);
    }
    std::array<double, 6> geotransform = recipe.geotransform.value_or(std::array<double, 6>{});
    if (recipe.geotransform) dataset.SetGeoTransform(geotransform.data());
  }

  std::filesystem::path folder_;
};

inline InputOptions with_band(int band) {
  InputOptions options;
  options.band = band;
  return options;
}

inline InputOptions with_nodata(double nodata) {
  InputOptions options;
  options.nodata = nodata;
  return options;
}

inline InputOptions with_bbox(const std::array<double, 4>& bbox) {
  InputOptions options;
  options.bbox = bbox;
  return options;
}

inline InputOptions with_vertical_unit(double metres) {
  InputOptions options;
  options.vertical_unit = metres;
  return options;
}

inline HeightGrid read_all(const RasterField& field) { return field.read({0, 0, field.width(), field.height()}); }

inline HeightGrid read_all(const std::string& path, const InputOptions& options = {}) {
  return read_all(RasterField({path}, options));
}

/// Fails unless the call throws the error with all of the words in its one line.
template <typename Failure>
void expect_error(const std::function<void()>& call, const std::vector<std::string>& words) {
  try {
    call();
    ADD_FAILURE() << "nothing thrown";
  } catch (const Failure& error) {
    const std::string text = error.what();
    for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
  }
}

}  // namespace tinsmith
