// Terrain with colour from raster to file: the colours are those of the ortho, the heights keep their promise, and
// neither threads nor stops change a byte.

#include <atomic>
#include <cmath>

#include "io/colour_raster.hpp"
#include "io/mesh_file.hpp"
#include "support/colour_file.hpp"
#include "tinsmith/compress.hpp"
#include "tinsmith/verify.hpp"

namespace tinsmith {
namespace {

using namespace test;

constexpr int kWidth = 60;
constexpr int kHeight = 44;

struct ColouredTin {
  Tin tin;
  std::vector<Levels> colour;
  int n_channels = 0;
};

ColouredTin read_coloured(const std::string& path) {
  ColouredTin mesh;
  MeshVisitor visitor;
  visitor.vertices = [&](std::span<const std::array<double, 3>> block) {
    mesh.tin.vertices.insert(mesh.tin.vertices.end(), block.begin(), block.end());
  };
  visitor.colours = [&](std::span<const Levels> block, int n_channels) {
    mesh.n_channels = n_channels;
    mesh.colour.insert(mesh.colour.end(), block.begin(), block.end());
  };
  visitor.triangles = [&](std::span<const std::array<std::uint64_t, 3>> block) {
    for (const auto& [a, b, c] : block)
      mesh.tin.triangles.push_back(
          {static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), static_cast<std::uint32_t>(c)});
  };
  visit_mesh(path, visitor);
  return mesh;
}

class TerrainWithColour : public RasterTest {
 protected:
  /// A plane, or rough ground with a void.
  std::string terrain(bool is_plane) const {
    RasterRecipe recipe;
    recipe.width = kWidth;
    recipe.height = kHeight;
    recipe.type = GDT_Float32;
    recipe.values.clear();
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        recipe.values.push_back(is_plane ? 100 + 2 * x - 3 * y
                                : x > 40 && x < 46 && y > 10 && y < 20
                                    ? -9999
                                    : 300 + 40 * std::sin(x * 0.4) * std::cos(y * 0.3));
    recipe.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-9999); };
    return write("dem.tif", recipe);
  }

  /// Two colours, one west and one east of the middle.
  std::string two_colours(int bands) const {
    return write_colours(path("ortho.tif"), {kWidth, kHeight, bands, [](int band, int x, int) {
                                               return x < kWidth / 2 ? 40 * band : 250 - 50 * band;
                                             }});
  }

  /// Stripes and a gradient, beside the terrain in part.
  std::string stripes(int bands) const {
    return write_colours(path("ortho.tif"),
                         {kWidth,
                          kHeight,
                          bands,
                          [](int band, int x, int y) { return (3 * x + 20 * band + (y % 8 < 4 ? 60 : 0)) % 256; },
                          "EPSG:32632",
                          {400000 + 30 * 7, 30, 0, 5100000, 0, -30}});
  }

  CompressOptions options(const std::string& ortho) const {
    CompressOptions options;
    options.max_error = 4;
    options.window = 16;
    options.color = ortho;
    return options;
  }
};

VerifyOptions against(const std::string& ortho) {
  VerifyOptions options;
  options.color = ortho;
  return options;
}

double column_of(const std::array<double, 3>& vertex) { return (vertex[0] - 400000) / 30 - 0.5; }
double row_of(const std::array<double, 3>& vertex) { return (5100000 - vertex[1]) / 30 - 0.5; }

TEST_F(TerrainWithColour, HasTheColoursOfTheOrthoOnAPlaneInEveryFormat) {
  const std::string dem = terrain(true);
  for (int bands = 1; bands <= 4; ++bands) {
    const std::string ortho = two_colours(bands);
    CompressOptions sharp = options(ortho);
    sharp.color_tolerance = 0.5;
    for (const std::string name : {"m.ply", "m.glb", "m.obj"}) {
      if (name == "m.obj" && bands % 2 == 0) continue;
      SCOPED_TRACE(std::to_string(bands) + " bands, " + name);
      const CompressReport report = compress({dem}, path(name), {}, sharp);
      EXPECT_LT(report.triangles, report.full_triangles / 4);
      const ColouredTin mesh = read_coloured(path(name));
      ASSERT_EQ(mesh.colour.size(), mesh.tin.vertices.size());
      ASSERT_EQ(mesh.n_channels, bands % 2 == 1 ? 3 : 4);
      std::size_t n_west = 0, n_east = 0;
      for (std::size_t v = 0; v < mesh.colour.size(); ++v) {
        const double column = column_of(mesh.tin.vertices[v]);
        constexpr int kMiddle = kWidth / 2;
        const bool is_west = column <= kMiddle - 1;
        if (!is_west && column < kMiddle) continue;
        ++(is_west ? n_west : n_east);
        for (int c = 0; c < mesh.n_channels; ++c) {
          const int band = c == 3 ? bands : bands < 3 ? 1 : c + 1;
          EXPECT_NEAR(mesh.colour[v][static_cast<std::size_t>(c)], is_west ? 40 * band : 250 - 50 * band, 1.01);
        }
      }
      EXPECT_GT(n_west, 5U);
      EXPECT_GT(n_east, 5U);
      EXPECT_LT(verify({dem}, path(name), {}, against(ortho)).color_rmse, 1);
    }
  }
}

TEST_F(TerrainWithColour, KeepsTheCertificateOfTheHeights) {
  const std::string dem = terrain(false);
  const std::string ortho = stripes(3);
  for (const char* name : {"m.ply", "m.glb", "m.obj"}) {
    compress({dem}, path(name), {}, options(ortho));
    const Certificate plain = verify({dem}, path(name));
    const Certificate coloured = verify({dem}, path(name), {}, against(ortho));
    EXPECT_EQ(plain.broken_promises(4), std::vector<std::string>{});
    EXPECT_EQ(plain.color_samples, 0U);
    EXPECT_GT(coloured.color_samples, 0U);
    EXPECT_LT(coloured.color_samples, coloured.samples);  // the ortho lies beside the terrain in part
    EXPECT_EQ(coloured.max_error, plain.max_error);
    EXPECT_EQ(coloured.rmse, plain.rmse);
    EXPECT_EQ(coloured.covered, plain.covered);
    EXPECT_EQ(coloured.cells_plan, plain.cells_plan);
  }
}

/// The differences of colour at all samples, the slow and obvious way.
Certificate slow_colours(const ColouredTin& mesh, const HeightGrid& heights, const ColourGrid& colours) {
  Certificate result;
  double sum = 0;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      if (std::isnan(heights.at(x, y)) || std::isnan(colours.channels[0].at(x, y))) continue;
      std::array<double, 4> largest{-1, -1, -1, -1};
      for (const auto& triangle : mesh.tin.triangles) {
        std::array<double, 3> px{}, py{}, w{};
        for (std::size_t k = 0; k < 3; ++k) {
          px[k] = column_of(mesh.tin.vertices[triangle[k]]) - x;
          py[k] = row_of(mesh.tin.vertices[triangle[k]]) - y;
        }
        for (std::size_t k = 0; k < 3; ++k) {
          const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
          w[k] = px[j] * py[i] - px[i] * py[j];
        }
        if (std::min({w[0], w[1], w[2]}) < -1e-6) continue;
        for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.n_channels); ++c) {
          double level = 0;
          for (std::size_t k = 0; k < 3; ++k) level += w[k] / (w[0] + w[1] + w[2]) * mesh.colour[triangle[k]][c];
          const std::size_t n = colours.channels.size();
          const std::size_t channel = c == 3 ? n - 1 : n < 3 ? 0 : c;
          largest[c] = std::max(largest[c], std::abs(level - colours.channels[channel].at(x, y)));
        }
      }
      if (largest[0] < 0) continue;
      ++result.color_samples;
      for (std::size_t c = 0; c < static_cast<std::size_t>(mesh.n_channels); ++c) {
        sum += largest[c] * largest[c];
        result.color_max_error = std::max(result.color_max_error, largest[c]);
      }
    }
  }
  result.color_rmse = std::sqrt(sum / static_cast<double>(result.color_samples) / mesh.n_channels);
  return result;
}

TEST_F(TerrainWithColour, IsMeasuredAsByBruteForce) {
  const std::string dem = terrain(false);
  const RasterField field({dem}, {});
  for (int bands = 1; bands <= 4; ++bands) {
    const std::string ortho = stripes(bands);
    const ColourRaster colours(ortho, field.frame(), kWidth, kHeight);
    for (const std::string name : {"m.ply", "m.glb", "m.obj"}) {
      if (name == "m.obj" && bands % 2 == 0) continue;
      SCOPED_TRACE(std::to_string(bands) + " bands, " + name);
      compress({dem}, path(name), {}, options(ortho));
      const Certificate slow =
          slow_colours(read_coloured(path(name)), read_all(field), colours.read({0, 0, kWidth, kHeight}));
      const Certificate judged = verify({dem}, path(name), {}, against(ortho));
      EXPECT_GT(slow.color_rmse, 1);
      EXPECT_EQ(judged.color_samples, slow.color_samples);
      EXPECT_NEAR(judged.color_rmse, slow.color_rmse, 1e-6);
      EXPECT_NEAR(judged.color_max_error, slow.color_max_error, 1e-6);
    }
  }
}

std::string bytes_in(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(TerrainWithColour, GivesTheSameBytesForAnyNumberOfThreads) {
  const std::string dem = terrain(false);
  CompressOptions run = options(stripes(3));
  run.threads = 1;
  compress({dem}, path("one.glb"), {}, run);
  for (const int threads : {2, 3, 8}) {
    run.threads = threads;
    compress({dem}, path("more.glb"), {}, run);
    EXPECT_EQ(bytes_in(path("more.glb")), bytes_in(path("one.glb"))) << threads;
  }
}

TEST_F(TerrainWithColour, GivesTheSameBytesAfterStops) {
  const std::string dem = terrain(false);
  CompressOptions run = options(stripes(3));
  compress({dem}, path("whole.ply"), {}, run);
  int n_stops = 0;
  for (bool is_done = false; !is_done;) {
    std::atomic<int> told = 0;
    run.progress = [&](double, std::string_view) { return ++told < 4; };
    try {
      compress({dem}, path("resumed.ply"), {}, run);
      is_done = true;
    } catch (const Interrupted&) {
      ++n_stops;
    }
  }
  EXPECT_GT(n_stops, 3);
  EXPECT_EQ(bytes_in(path("resumed.ply")), bytes_in(path("whole.ply")));
}

TEST_F(TerrainWithColour, GoesOnOnlyWithTheSameColours) {
  const std::string dem = terrain(false);
  CompressOptions run = options(stripes(3));
  std::atomic<int> told = 0;
  run.progress = [&](double, std::string_view) { return ++told < 4; };
  EXPECT_THROW(compress({dem}, path("m.ply"), {}, run), Interrupted);
  run.progress = {};
  const auto attempt = [&] { compress({dem}, path("m.ply"), {}, run); };
  run.color_tolerance = 5;
  expect_error<UsageError>(attempt, {"color tolerance: 12", "color tolerance: 5", "--fresh"});
  run.color_tolerance = 12;
  two_colours(3);
  expect_error<UsageError>(attempt, {"color", "--fresh"});
  run.color.clear();
  expect_error<UsageError>(attempt, {"--fresh"});
  run.fresh = true;
  EXPECT_NO_THROW(attempt());
}

TEST_F(TerrainWithColour, IsRefusedAtTheStartWhereItCannotBe) {
  const std::string dem = terrain(true);
  bool has_begun = false;
  const auto attempt = [&](const std::string& ortho, const std::string& name) {
    CompressOptions run = options(ortho);
    run.progress = [&](double, std::string_view) { return has_begun = true; };
    compress({dem}, path(name), {}, run);
  };
  expect_error<UsageError>([&] { attempt(two_colours(3), "m.2dm"); }, {".2dm", "no colours", ".ply"});
  expect_error<UsageError>([&] { attempt(two_colours(4), "m.obj"); }, {".obj", "alpha", "4 channels"});
  expect_error<InputError>([&] { attempt(two_colours(5), "m.ply"); }, {"5 bands", "gdal_translate"});
  expect_error<InputError>([&] { attempt(path("none.tif"), "m.ply"); }, {"none.tif"});
  EXPECT_FALSE(has_begun);
  compress({dem}, path("plain.ply"), {}, options(""));
  expect_error<InputError>([&] { verify({dem}, path("plain.ply"), {}, against(two_colours(3))); },
                           {"plain.ply", "no colours"});
  attempt(two_colours(3), "three.ply");
  expect_error<InputError>([&] { verify({dem}, path("three.ply"), {}, against(two_colours(4))); },
                           {"three.ply", "3 channels"});
}

TEST_F(TerrainWithColour, IsNotForHeightsInMemory) {
  const std::vector<double> z(16, 1.0);
  expect_error<UsageError>([&] { compress(HeightArray{4, 4, z.data(), 1, 1}, options("ortho.tif")); }, {"color"});
}

}  // namespace
}  // namespace tinsmith
