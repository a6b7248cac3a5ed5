// The judge on files: what it measures does not depend on the format, the CRS or the turn of the grid.

#include "tinsmith/verify.hpp"

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include "io/mesh_cases.hpp"
#include "io/mesh_file.hpp"
#include "judge/scene.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

void write_raster(const std::string& path, const Scene& scene, GridFrame frame) {
  GDALAllRegister();
  GDALDataset* const file = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), scene.width, scene.height, 1, GDT_Float64, nullptr);
  file->SetGeoTransform(frame.geotransform.data());
  file->SetProjection(frame.crs_wkt.c_str());
  std::vector<double> z = scene.z;
  for (double& height : z)
    if (std::isnan(height)) height = -9999;
  file->GetRasterBand(1)->SetNoDataValue(-9999);
  if (frame.metres_per_vertical_unit != 1) file->GetRasterBand(1)->SetUnitType("ft");
  ASSERT_EQ(file->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, scene.width, scene.height, z.data(), scene.width,
                                             scene.height, GDT_Float64, 0, 0),
            CE_None);
  GDALClose(file);
}

TerrainMesh terrain_mesh(const Scene& scene) {
  TerrainMesh mesh;
  for (const auto& [x, y, z] : scene.vertices) {
    mesh.position.push_back(
        {static_cast<std::int32_t>(std::lround(16 * x)), static_cast<std::int32_t>(std::lround(16 * y))});
    mesh.height.push_back(z);
  }
  mesh.triangles = scene.triangles;
  return mesh;
}

/// Full but for a void and one raised sample; its inner vertices off the samples.
Scene scene_with_an_error() {
  Scene scene = full_plane(12, 9);
  scene.at(5, 3) = kVoid;
  mesh_fully(scene);
  for (int y = 5; y < 8; ++y)
    for (int x = 1; x < 11; ++x) {
      auto& v = scene.vertices[std::size_t{12} * y + x];
      const double dx = ((7 * x + 3 * y) % 9 - 4) / 16.0;
      const double dy = ((5 * x + y) % 9 - 4) / 16.0;
      v = {v[0] + dx, v[1] + dy, v[2] + 2 * dx - 3 * dy};
    }
  scene.at(8, 6) -= 2.25;
  return scene;
}

TEST(Verify, MeasuresTheSameInEveryFormatAndFrame) {
  const Scene scene = scene_with_an_error();
  for (const GridFrame& frame : frames()) {
    const ScratchFolder folder;  // its own, for the .prj
    const std::string raster = folder.file("dem.tif");
    write_raster(raster, scene, frame);
    for (const std::string extension : {".ply", ".obj", ".glb", ".2dm"}) {
      const std::string path = folder.file("mesh" + extension);
      write_mesh(path, terrain_mesh(scene), frame);
      const Certificate c = verify({raster}, path);
      SCOPED_TRACE(extension + " " + frame.crs_wkt);
      const double rounding = c.rounding + height_rounding(path, 70, 125);
      EXPECT_EQ(c.samples, 107U);
      EXPECT_EQ(c.covered, 107U);
      EXPECT_NEAR(c.max_error, 2.25 * frame.metres_per_vertical_unit, rounding);
      EXPECT_EQ(c.max_error_column, 8);
      EXPECT_EQ(c.max_error_row, 6);
      EXPECT_EQ(c.cells_plan, 84);
      EXPECT_EQ(c.cells_valid, 84);
      EXPECT_EQ(c.folded, 0U);
      EXPECT_NEAR(c.area_plan / c.area_valid, 1, 1e-6);
      EXPECT_TRUE(c.broken_promises(2.25 * frame.metres_per_vertical_unit + rounding).empty());
      EXPECT_EQ(c.broken_promises(2.25 * frame.metres_per_vertical_unit - 1e-3).size(), 1U);
    }
  }
}

TEST(Verify, RefusesWhatIsNoRasterOrNoMesh) {
  const ScratchFolder folder;
  const Scene scene = full_plane(4, 4);
  write_raster(folder.file("dem.tif"), scene, GridFrame{});
  write_mesh(folder.file("mesh.ply"), terrain_mesh(scene), GridFrame{});
  put_bytes(folder.file("text.ply"), "not a mesh\n");
  EXPECT_NO_THROW(verify({folder.file("dem.tif")}, folder.file("mesh.ply")));
  EXPECT_THROW(verify({folder.file("dem.tif")}, folder.file("text.ply")), InputError);
  EXPECT_THROW(verify({folder.file("dem.tif")}, folder.file("missing.ply")), InputError);
  EXPECT_THROW(verify({folder.file("dem.tif")}, folder.file("dem.tif")), InputError);
  EXPECT_THROW(verify({folder.file("mesh.ply")}, folder.file("mesh.ply")), InputError);
}

}  // namespace
}  // namespace tinsmith
