// The certificate holds in every format, also where float32 and other units round heights.

#include <random>

#include "io/raster_fixture.hpp"
#include "tinsmith/compress.hpp"
#include "tinsmith/verify.hpp"

namespace tinsmith {
namespace {

using EveryFormat = RasterTest;

// Rough ground in feet: vertices lie beyond the highest and lowest sample, where the steps of float32 are larger.
TEST_F(EveryFormat, KeepsTheToleranceInFeetToo) {
  constexpr int kSide = 60;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    RasterRecipe recipe;
    recipe.width = kSide;
    recipe.height = kSide;
    recipe.type = GDT_Float32;
    recipe.crs = "EPSG:2994";
    recipe.values.clear();
    for (int i = 0; i < kSide * kSide; ++i)
      recipe.values.push_back(100 + static_cast<double>(random() % 4096) / 8.0);
    const std::string raster = write("rough.tif", recipe);
    CompressOptions options;
    options.max_error = 40;
    options.window = 32;
    for (const char* name : {"m.ply", "m.obj", "m.2dm", "m.glb"}) {
      const CompressReport report = compress({raster}, path(name), {}, options);
      EXPECT_LT(report.triangles, report.full_triangles / 2);
      const Certificate certificate = verify({raster}, path(name));
      EXPECT_EQ(certificate.broken_promises(*options.max_error), std::vector<std::string>{}) << name;
      EXPECT_GT(certificate.max_error, 39.9);
    }
  }
}

}  // namespace
}  // namespace tinsmith
