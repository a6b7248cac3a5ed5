// Many rasters as one: found without looking at all, overlaps, unreadable ones, lists, empty parts.

#include "io/mosaic.hpp"

#include <gdal.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <thread>

#include "io/raster_dataset.hpp"
#include "io/raster_index.hpp"
#include "raster_fixture.hpp"
#include "samples/grid_rect.hpp"

namespace tinsmith {
namespace {

using RasterMosaic = RasterTest;

// All samples of one height.
RasterRecipe tile(int column, int row, int width, int height, double z) {
  RasterRecipe recipe{.width = width, .height = height, .type = GDT_Float32};
  recipe.geotransform = {400000 + 30.0 * column, 30, 0, 5100000 - 30.0 * row, 0, -30};
  recipe.values.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), z);
  return recipe;
}

InputOptions with_overlap(Overlap overlap) {
  InputOptions options;
  options.overlap = overlap;
  return options;
}

InputOptions skipping() {
  InputOptions options;
  options.skip_unreadable = true;
  return options;
}

bool mentions(const std::vector<std::string>& remarks, const std::vector<std::string>& words) {
  return std::any_of(remarks.begin(), remarks.end(), [&](const std::string& remark) {
    return std::all_of(words.begin(), words.end(),
                       [&](const std::string& word) { return remark.find(word) != std::string::npos; });
  });
}

std::string all_of(const std::vector<std::string>& remarks) {
  std::string text;
  for (const std::string& remark : remarks) text += remark + "\n";
  return text;
}

TEST(RasterIndex, FindsWhatLookingAtAllFinds) {
  std::mt19937_64 random(5);
  const auto any = [&](int n) { return static_cast<std::int32_t>(random() % static_cast<unsigned>(n)); };
  int n_found = 0;
  for (const int n : {0, 1, 8, 9, 500}) {
    std::vector<GridRect> places;
    for (int i = 0; i < n; ++i) places.push_back({any(1000) - 500, any(1000) - 500, any(60), any(60)});
    if (n > 3) places[3] = {-500, -500, 1060, 1060};
    const RasterIndex index(places);
    for (int i = 0; i < 200; ++i) {
      const GridRect rect{any(1000) - 500, any(1000) - 500, any(80), any(80)};
      std::vector<std::uint32_t> all;
      for (std::uint32_t k = 0; k < places.size(); ++k) {
        if (!is_empty(intersection(places[k], rect))) all.push_back(k);
      }
      EXPECT_EQ(index.touching(rect), all);
      n_found += static_cast<int>(all.size());
    }
  }
  EXPECT_GT(n_found, 500);
}

TEST_F(RasterMosaic, WhereInputsOverlapTheFirstTheLastOrTheMeanOfTheValidCounts) {
  RasterRecipe a = tile(0, 0, 4, 1, 10);
  a.values[3] = -9999;
  a.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(-9999); };
  RasterRecipe b = tile(2, 0, 4, 1, 40);
  b.values[1] = 7;
  b.type = GDT_Int16;
  RasterRecipe c = tile(2, 0, 1, 1, 100);
  c.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(0); };
  const std::vector<std::string> paths{write("a.tif", a), write("b.tif", b), write("c.tif", c)};
  const auto heights = [&](Overlap overlap) { return read_all(RasterField(paths, with_overlap(overlap))).z; };
  EXPECT_EQ(heights(Overlap::kFirst), (std::vector<double>{10, 10, 10, 7, 40, 40}));
  EXPECT_EQ(heights(Overlap::kLast), (std::vector<double>{10, 10, 100, 7, 40, 40}));
  EXPECT_EQ(heights(Overlap::kMean), (std::vector<double>{10, 10, 50, 7, 40, 40}));
}

TEST_F(RasterMosaic, ABorderThatDisagreesIsToldWithItsLargestDifferenceFilesAndPlace) {
  RasterRecipe east = tile(9, 0, 10, 10, 5);
  east.values[40] = 5.5;
  east.values[70] = 3;
  const std::vector<std::string> paths{write("west.tif", tile(0, 0, 10, 10, 5)), write("east.tif", east),
                                       write("south.tif", tile(0, 9, 10, 10, 5.25))};
  const RasterField field(paths, with_vertical_unit(2));
  const auto remark = field.remark_on_overlaps();
  ASSERT_TRUE(remark);
  EXPECT_TRUE(mentions({*remark}, {"west.tif and", "east.tif disagree", "2 of 10 samples", "by up to 4 m",
                                   "at 400285 5099775", "3 of 3 such pairs"}))
      << *remark;
  EXPECT_FALSE(RasterField({paths[0], write("same.tif", tile(9, 0, 10, 10, 5))}, {}).remark_on_overlaps());
  EXPECT_FALSE(RasterField({paths[0], write("apart.tif", tile(10, 0, 10, 10, 9))}, {}).remark_on_overlaps());
}

TEST_F(RasterMosaic, OnlyTheOverlapIsReadToCompare) {
  RasterRecipe west = tile(0, 0, 600, 64, 5);
  west.creation = {"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=64"};
  RasterRecipe east = west;
  east.geotransform = tile(599, 0, 1, 1, 0).geotransform;
  const std::string damaged = write("east.tif", east);
  std::filesystem::resize_file(damaged, std::filesystem::file_size(damaged) / 2);
  const RasterField field({write("west.tif", west), damaged}, {});
  EXPECT_FALSE(field.remark_on_overlaps()) << "the half that is missing lies outside of the overlap";
  EXPECT_THROW(read_all(field), InputError);
}

TEST_F(RasterMosaic, AFileThatCannotBeOpenedStopsOrIsSkippedAndNamed) {
  const std::string whole = write("whole.tif", tile(0, 0, 3, 3, 1));
  std::vector<std::string> paths{path("missing.tif"), whole, write_text("text.tif", "no raster"),
                                 write("other.tif", tile(6, 0, 3, 3, 2))};
  expect_error<InputError>([&] { RasterField(paths, {}); }, {"missing.tif", "no such file"});
  const RasterField field(paths, skipping());
  EXPECT_EQ(field.width(), 9);
  EXPECT_EQ(field.read({0, 0, 9, 1}).at(0, 0), 1);
  EXPECT_FALSE(field.read({0, 0, 9, 1}).is_valid(4, 0));
  EXPECT_EQ(field.n_unreadable(), 2);
  EXPECT_TRUE(mentions(field.remarks(), {"2 inputs can't be read", "missing.tif", "text.tif"}));
  expect_error<InputError>(
      [&] {
        RasterField({paths[0], paths[2]}, skipping());
      },
      {"none of the 2", "missing.tif"});
  const std::string kelvin =
      write("kelvin.tif", {.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetUnitType("K"); }});
  EXPECT_THROW(RasterField({whole, kelvin}, skipping()), InputError) << "readable, but no heights";
}

// Reads parts by four threads, each in its own order; how many samples are not as they are in the whole.
int count_differing(const RasterField& field, const HeightGrid& whole) {
  constexpr std::int32_t kSide = 40;
  std::atomic<int> n_differing = 0;
  const auto read_parts = [&](unsigned seed) {
    std::mt19937 random(seed);
    for (int i = 0; i < 50; ++i) {
      const auto x0 = static_cast<std::int32_t>(random() % (field.width() - kSide));
      const auto y0 = static_cast<std::int32_t>(random() % (field.height() - kSide));
      const HeightGrid part = field.read({x0, y0, kSide, kSide});
      for (std::int32_t y = y0; y < y0 + kSide; ++y) {
        for (std::int32_t x = x0; x < x0 + kSide; ++x) {
          const bool same = part.is_valid(x, y) ? part.at(x, y) == whole.at(x, y) : !whole.is_valid(x, y);
          n_differing += same ? 0 : 1;
        }
      }
    }
  };
  std::vector<std::thread> threads;
  for (unsigned seed = 0; seed < 4; ++seed) threads.emplace_back(read_parts, seed);
  for (std::thread& thread : threads) thread.join();
  return n_differing;
}

TEST_F(RasterMosaic, DamagedBlocksAreTheSameVoidsInAnyOrderOfReading) {
  constexpr int kSide = 300;
  for (const std::vector<std::string>& creation :
       {std::vector<std::string>{"TILED=YES", "BLOCKXSIZE=64", "BLOCKYSIZE=64"},
        {"BLOCKYSIZE=1"},
        {"COMPRESS=LZW"}}) {
    RasterRecipe recipe = tile(0, 0, kSide, kSide, 5);
    recipe.creation = creation;
    std::mt19937 random(3);
    for (double& z : recipe.values) z = random() % 3000;
    const std::string cut = write("cut.tif", recipe);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) * 2 / 3);
    const RasterField field({cut}, skipping());
    EXPECT_TRUE(field.remarks().empty());
    const HeightGrid whole = read_all(field);
    std::size_t n_void = 0;
    for (std::size_t i = 0; i < whole.z.size(); ++i) {
      n_void += std::isnan(whole.z[i]) ? 1 : 0;
      if (!std::isnan(whole.z[i])) EXPECT_EQ(whole.z[i], recipe.values[i]);
    }
    EXPECT_GT(n_void, 1000);
    EXPECT_LT(n_void, whole.z.size() / 2);
    EXPECT_TRUE(
        mentions(field.remarks(), {"1 input can't be read", std::to_string(n_void) + " samples", "cut.tif"}))
        << all_of(field.remarks());
    EXPECT_EQ(count_differing(RasterField({cut}, skipping()), whole), 0);
    expect_error<InputError>([&] { read_all(cut); }, {"cut.tif", "cut short"});
  }
}

TEST_F(RasterMosaic, AListNamesInputs) {
  const std::string a = write("a.tif", tile(0, 0, 2, 2, 1));
  const std::string b = write("b.tif", tile(2, 0, 2, 2, 2));
  const std::string list = write_text("list.txt", a + "\r\n\n" + b);
  EXPECT_EQ(RasterField({"@" + list}, {}).width(), 4);
  EXPECT_EQ(RasterField({"@" + list, write("c.tif", tile(4, 0, 1, 1, 3))}, {}).width(), 5);
  expect_error<InputError>([&] { RasterField({"@" + path("none.txt")}, {}); }, {"none.txt", "can't be read"});
  expect_error<InputError>([&] { RasterField({"@" + path("")}, {}); }, {"can't be read"});
  expect_error<InputError>([&] { RasterField({"@" + write_text("e.txt", "\n \n")}, {}); }, {"e.txt", "is empty"});
}

TEST_F(RasterMosaic, AnLOfTilesIsSurelyVoidWhereOneIsMissing) {
  const RasterField field({write("a.tif", tile(0, 0, 10, 10, 1)), write("b.tif", tile(0, 10, 10, 10, 2)),
                           write("c.tif", tile(10, 10, 10, 10, 3))},
                          {});
  EXPECT_TRUE(field.is_surely_void({10, 0, 10, 10}));
  EXPECT_TRUE(field.is_surely_void({100, 100, 10, 10}));
  EXPECT_TRUE(field.is_surely_void({-10, -10, 10, 10}));
  EXPECT_FALSE(field.is_surely_void({9, 0, 10, 10}));
  const HeightGrid grid = read_all(field);
  EXPECT_EQ(grid.at(5, 15), 2);
  EXPECT_EQ(grid.at(15, 15), 3);
  EXPECT_FALSE(grid.is_valid(15, 5));
}

// A sparse raster of which only the block around one sample is there.
std::string write_sparse(const std::string& path, int width, int height, std::optional<double> nodata) {
  CPLStringList creation;
  for (const char* option : {"TILED=YES", "SPARSE_OK=TRUE", "BIGTIFF=YES", "COMPRESS=DEFLATE"})
    creation.AddString(option);
  GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      path.c_str(), width, height, 1, GDT_Int16, creation.List()));
  std::array<double, 6> geotransform{0, 1, 0, 0, 0, -1};
  dataset->SetGeoTransform(geotransform.data());
  if (nodata) dataset->GetRasterBand(1)->SetNoDataValue(*nodata);
  double z = 77;
  EXPECT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, width - 1, height - 1, 1, 1, &z, 1, 1, GDT_Float64, 0, 0,
                                                nullptr),
            CE_None);
  return path;
}

TEST_F(RasterMosaic, NinetyBillionSamplesOfNextToNothingAreKnownToBeVoid) {
  constexpr std::int32_t kSide = 300000;
  const RasterField field({write_sparse(path("sparse.tif"), kSide, kSide, -9999)}, {});
  EXPECT_EQ(field.width(), kSide);
  int n_void = 0;
  for (std::int32_t i = 0; i < 1000; ++i) n_void += field.is_surely_void({i * 293, i * 299, 257, 257}) ? 1 : 0;
  EXPECT_EQ(n_void, 1000);
  EXPECT_FALSE(field.is_surely_void({kSide - 300, kSide - 300, 299, 300}));
  EXPECT_EQ(field.read({kSide - 2, kSide - 2, 2, 2}).at(kSide - 1, kSide - 1), 77);
  EXPECT_FALSE(field.read({kSide - 2, kSide - 2, 2, 2}).is_valid(kSide - 2, kSide - 1));
  EXPECT_FALSE(field.read({150000, 150000, 1, 1}).is_valid(150000, 150000));
}

TEST_F(RasterMosaic, HugeOverlapsAreComparedInPartWhichIsSaid) {
  std::vector<std::string> paths;
  for (const double first : {1.0, 3.0}) {
    paths.push_back(write_sparse(path("sparse" + std::to_string(paths.size()) + ".tif"), 60000, 60000, -9999));
    const GDALDatasetUniquePtr dataset(GDALDataset::Open(paths.back().c_str(), GDAL_OF_UPDATE));
    double z = first;
    ASSERT_EQ(dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, 1, 1, &z, 1, 1, GDT_Float64, 0, 0, nullptr),
              CE_None);
  }
  const auto remark = RasterField(paths, {}).remark_on_overlaps();
  ASSERT_TRUE(remark);
  EXPECT_TRUE(mentions({*remark}, {"by up to 2 m", "1 of 1 overlaps were compared, large ones in part"}))
      << *remark;
}

TEST_F(RasterMosaic, EmptyBlocksAreOnlyVoidWhereTheirValueIs) {
  const std::string zeros = write_sparse(path("zeros.tif"), 1000, 1000, {});
  EXPECT_FALSE(RasterField({zeros}, {}).is_surely_void({0, 0, 10, 10}));
  EXPECT_EQ(RasterField({zeros}, {}).read({0, 0, 1, 1}).at(0, 0), 0);
  EXPECT_TRUE(RasterField({zeros}, with_nodata(0)).is_surely_void({0, 0, 10, 10}));
  const std::string voids = write_sparse(path("voids.tif"), 1000, 1000, -9999);
  EXPECT_FALSE(RasterField({voids}, with_nodata(5)).is_surely_void({0, 0, 10, 10}));
  EXPECT_FALSE(RasterField({write("dense.tif", tile(0, 0, 3, 3, 1))}, {}).is_surely_void({0, 0, 3, 3}));
}

TEST_F(RasterMosaic, LongAndThinRastersAreReadToTheirEnds) {
  for (const auto& [width, height] : {std::pair{1, 1000000}, {10000000, 20}}) {
    const RasterField field({write_sparse(path("thin.tif"), width, height, -9999)}, {});
    EXPECT_EQ(field.width(), width);
    EXPECT_EQ(field.height(), height);
    EXPECT_EQ(field.read({width - 1, height - 1, 2, 2}).at(width - 1, height - 1), 77);
    EXPECT_TRUE(field.is_surely_void({0, 0, 1, 10}));
  }
}

TEST_F(RasterMosaic, OverviewsAndArchivesChangeNoHeight) {
  RasterRecipe recipe = tile(0, 0, 600, 500, 0);
  for (std::size_t i = 0; i < recipe.values.size(); ++i) recipe.values[i] = static_cast<double>(i % 1013);
  const std::string plain = write("dem.tif", recipe);
  std::vector<std::string> copies;
  const GDALDatasetUniquePtr dataset(GDALDataset::Open(plain.c_str()));
  if (auto* cog = GetGDALDriverManager()->GetDriverByName("COG"); cog != nullptr) {
    CPLStringList creation;
    creation.AddString("OVERVIEWS=IGNORE_EXISTING");
    creation.AddString("BLOCKSIZE=128");
    GDALClose(cog->CreateCopy(path("cog.tif").c_str(), dataset.get(), 0, creation.List(), nullptr, nullptr));
    const GDALDatasetUniquePtr made(GDALDataset::Open(path("cog.tif").c_str()));
    EXPECT_GT(made->GetRasterBand(1)->GetOverviewCount(), 0);
    copies.push_back(path("cog.tif"));
  }
  const std::string text = [&] {
    std::ifstream file(plain, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  for (const std::string& archive : {"/vsizip/" + path("a.zip") + "/dem.tif", "/vsigzip/" + path("dem.tif.gz")}) {
    VSILFILE* file = VSIFOpenL(archive.c_str(), "wb");
    ASSERT_NE(file, nullptr);
    VSIFWriteL(text.data(), 1, text.size(), file);
    VSIFCloseL(file);
    copies.push_back(archive);
  }
  const std::vector<double> heights = read_all(plain).z;
  for (const std::string& copy : copies) EXPECT_EQ(read_all(copy).z, heights) << copy;
  EXPECT_GE(copies.size(), 2);
}

TEST_F(RasterMosaic, TheCacheForARectangleFollowsFromTheBlocks) {
  CPLStringList creation;
  creation.AddString("SPARSE_OK=TRUE");
  creation.AddString("BLOCKYSIZE=1");
  GDALClose(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path("strips.tif").c_str(), 300000, 3000, 1,
                                                                     GDT_Float32, creation.List()));
  const RasterField strips({path("strips.tif")}, {});
  const RasterField tiles({write_sparse(path("tiles.tif"), 300000, 3000, -9999)}, {});
  EXPECT_GE(strips.cache_for(9 * 256, 256), 300000ULL * 256 * 4);
  EXPECT_LE(strips.cache_for(9 * 256, 256), 300000ULL * 260 * 4) << "whole rows are decoded anyway";
  EXPECT_LE(tiles.cache_for(2 * 256, 256), 2U << 20);
  EXPECT_GE(tiles.cache_for(300000, 3000), 300000ULL * 3000 * 2);
  EXPECT_LE(tiles.cache_for(300000, 3000), 300000ULL * 3600 * 2) << "no more than the raster has";
  EXPECT_TRUE(mentions(strips.remarks(), {"strips.tif", "blocks of 300000 x 1", "TILED=YES"}))
      << all_of(strips.remarks());
  EXPECT_FALSE(mentions(tiles.remarks(), {"blocks of"})) << all_of(tiles.remarks());
}

TEST(RasterCache, IsAsLargeAsAsked) {
  const auto before = GDALGetCacheMax64();
  set_raster_cache(123 << 20);
  EXPECT_EQ(GDALGetCacheMax64(), 123 << 20);
  GDALSetCacheMax64(before);
}

}  // namespace
}  // namespace tinsmith
