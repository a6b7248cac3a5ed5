// What the simplification of surfaces keeps at every size, on generated shapes and on real terrain as a mesh.

#include <gdal_priv.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "support/surface_measures.hpp"
#include "support/surface_shapes.hpp"
#include "tinsmith/simplify.hpp"

namespace tinsmith {
namespace {

using namespace test;

// The part of the Matterhorn's raster around its summit, n x n samples of 1/3600 degree: 2 (n - 1)^2 triangles in
// metres, heights times `exaggeration`. As it is it has cliffs with edges where it turns by more than 90 degrees.
Surface matterhorn_mesh(int n, double exaggeration = 1) {
  GDALAllRegister();
  const std::unique_ptr<GDALDataset> file(
      GDALDataset::Open(TINSMITH_SOURCE_DIR "/data/matterhorn.tif", GDAL_OF_RASTER));
  if (!file) return {};
  std::vector<double> height(static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
  const int first = (1025 - n) / 2;
  if (file->GetRasterBand(1)->RasterIO(GF_Read, first, first, n, n, height.data(), n, n, GDT_Float64, 0, 0) !=
      CE_None)
    return {};
  Surface s = open_sheet(n - 1);  // its triangles
  const double pixel = 30 * (n - 1);
  for (std::size_t v = 0; v < height.size(); ++v)
    s.position[v] = {pixel * s.position[v][0], pixel * s.position[v][1], exaggeration * height[v]};
  return s;
}

struct Shape {
  const char* name;
  Surface surface;
};
std::vector<Shape> shapes() {
  return {{"sphere", sphere(24)},
          {"torus", torus(60, 30)},
          {"cube", cube_with_creases(16)},
          {"sheet", open_sheet(40)},
          {"scan", scan(24)},
          {"matterhorn", matterhorn_mesh(160)},
          {"hills", matterhorn_mesh(160, 0.25)}};
}

Surface simplified(const Surface& surface, const SimplifySurfaceOptions& options) {
  SimplifySurfaceReport report;
  return simplify_surface(surface, options, report);
}

Surface simplified(const Surface& surface, double ratio) {
  SimplifySurfaceOptions options;
  options.ratio = ratio;
  return simplified(surface, options);
}

constexpr std::array kRatios{0.5, 0.2, 0.05, 0.01};
constexpr double kRightAngle = 90 + 1e-6;  // degrees

TEST(SurfaceGuarantees, TopologyStaysAtAnyShare) {
  for (const auto& [name, surface] : shapes()) {
    ASSERT_FALSE(surface.triangles.empty()) << name;
    for (const double ratio : kRatios) {
      SCOPED_TRACE(testing::Message() << name << ", " << ratio);
      const Surface result = simplified(surface, ratio);
      EXPECT_LE(static_cast<double>(result.triangles.size()),
                ratio * static_cast<double>(surface.triangles.size()));
      EXPECT_TRUE(is_manifold(result));
      EXPECT_EQ(count_borders(result), count_borders(surface));
      EXPECT_EQ(genus(result), genus(surface));
    }
  }
}

// Where the input has no edge at which normals are more than 90 degrees apart, no triangle's is so far from that of
// the input's nearest place, and no edge of the result is one.
TEST(SurfaceGuarantees, NothingTurnsOverWhereNothingIsTurned) {
  int n_smooth = 0;
  for (const auto& [name, surface] : shapes()) {
    if (largest_dihedral_deg(surface) > kRightAngle) continue;
    ++n_smooth;
    for (const double ratio : kRatios) {
      SCOPED_TRACE(testing::Message() << name << ", " << ratio);
      const Surface result = simplified(surface, ratio);
      EXPECT_EQ(normal_turn(result, surface).n_flipped, 0U);
      EXPECT_LE(largest_dihedral_deg(result), kRightAngle);
    }
  }
  EXPECT_EQ(n_smooth, 6);
}

// Cliffs of noisy heights, folded already, have normals of all sides at one place: there no triangle is turned over
// against all of the input that is less than twice as far as the nearest; at 20 %, amid the folds, one in 3000 may
// be.
TEST(SurfaceGuarantees, HardlyATriangleTurnsOverOnFoldedCliffs) {
  const Surface surface = matterhorn_mesh(160);
  ASSERT_GT(largest_dihedral_deg(surface), kRightAngle);
  for (const double ratio : kRatios) {
    SCOPED_TRACE(ratio);
    const Surface result = simplified(surface, ratio);
    EXPECT_LE(normal_turn(result, surface, 2).n_flipped, result.triangles.size() / 800);
  }
}

TEST(SurfaceGuarantees, TheFitBringsTheSurfaceNearerAndNoPlaceAstray) {
  for (const Surface& surface : {scan(24), torus(60, 30), matterhorn_mesh(100)}) {
    for (const double ratio : {0.2, 0.05}) {
      SCOPED_TRACE(testing::Message() << surface.triangles.size() << " triangles, " << ratio);
      SimplifySurfaceOptions options;
      options.ratio = ratio;
      const Surface with = simplified(surface, options);
      options.fit = false;
      const Surface without = simplified(surface, options);
      EXPECT_EQ(with.triangles.size(), without.triangles.size());
      EXPECT_LT(distance(with, surface, 10'000).rms(), 0.9 * distance(without, surface, 10'000).rms());
      EXPECT_LT(distance(with, surface, 10'000).max(), 1.1 * distance(without, surface, 10'000).max());
    }
  }
}

TEST(SurfaceGuarantees, TheFitLeavesFeaturesAndFlatGroundWhereTheyAre) {
  const Surface cube = cube_with_creases(12);
  SimplifySurfaceOptions options;
  options.crease = 45;
  options.ratio = 0.1;
  EXPECT_LT(distance(simplified(cube, options), cube, 4'000).max(), 1e-12);
}

}  // namespace
}  // namespace tinsmith
