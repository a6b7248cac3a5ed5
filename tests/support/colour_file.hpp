#pragma once
// Rasters of colours as files.

#include <functional>

#include "io/raster_fixture.hpp"

namespace tinsmith::test {

/// Cells of 30 m beside those of RasterRecipe.
struct ColourFile {
  int width = 0;
  int height = 0;
  int bands = 3;
  std::function<double(int band, int column, int row)> value;  // bands from 1
  std::string crs = "EPSG:32632";
  std::array<double, 6> geotransform{400000, 30, 0, 5100000, 0, -30};
  GDALDataType type = GDT_Byte;
  /// Tells the dataset what its bands mean; otherwise nothing is known of them (the fourth is no mask).
  std::function<void(GDALDataset&)> declare = [](GDALDataset& dataset) {
    for (int b = 1; b <= dataset.GetRasterCount(); ++b)
      dataset.GetRasterBand(b)->SetColorInterpretation(GCI_Undefined);
  };
};

inline std::string write_colours(const std::string& path, const ColourFile& recipe) {
  GDALAllRegister();
  GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), recipe.width, recipe.height, recipe.bands, recipe.type, nullptr));
  if (!recipe.crs.empty()) {
    OGRSpatialReference crs;
    EXPECT_EQ(crs.SetFromUserInput(recipe.crs.c_str()), OGRERR_NONE);
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    dataset->SetSpatialRef(&crs);
  }
  std::array<double, 6> geotransform = recipe.geotransform;
  dataset->SetGeoTransform(geotransform.data());
  if (recipe.declare) recipe.declare(*dataset);
  for (int b = 1; b <= recipe.bands; ++b) {
    std::vector<double> values;
    for (int y = 0; y < recipe.height; ++y) {
      for (int x = 0; x < recipe.width; ++x) values.push_back(recipe.value(b, x, y));
    }
    EXPECT_EQ(dataset->GetRasterBand(b)->RasterIO(GF_Write, 0, 0, recipe.width, recipe.height, values.data(),
                                                  recipe.width, recipe.height, GDT_Float64, 0, 0, nullptr),
              CE_None);
  }
  return path;
}

}  // namespace tinsmith::test
