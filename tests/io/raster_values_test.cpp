// Which values are heights, which are voids.

#include <cmath>
#include <limits>

#include "raster_fixture.hpp"

namespace tinsmith {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using RasterValues = RasterTest;

void expect_heights(const HeightGrid& grid, const std::vector<double>& expected) {
  ASSERT_EQ(grid.z.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(grid.z[i])) << i << ": " << grid.z[i];
    } else {
      EXPECT_EQ(grid.z[i], expected[i]) << i;
    }
  }
}

std::function<void(GDALDataset&)> nodata(double value) {
  return [value](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetNoDataValue(value); };
}

TEST_F(RasterValues, EveryNumericTypeGivesItsExactValues) {
  const std::vector<std::pair<GDALDataType, std::vector<double>>> types{
      {GDT_Byte, {0, 1, 127, 128, 254, 255}},
      {GDT_UInt16, {0, 1, 32767, 32768, 65534, 65535}},
      {GDT_Int16, {-32768, -1, 0, 1, 32766, 32767}},
      {GDT_UInt32, {0, 1, 2147483647, 2147483648, 4294967294, 4294967295}},
      {GDT_Int32, {-2147483648, -1, 0, 1, 2147483646, 2147483647}},
      {GDT_UInt64, {0, 1, 2, 4294967296, 9999999999, 10000000000}},
      {GDT_Int64, {-10000000000, -1, 0, 1, 4294967296, 10000000000}},
      {GDT_Float32, {-0.5, 0.25, 1e9, -8848.75, 3, 16777216}},
      {GDT_Float64, {-0.1, 0.3, 1e10, -1e10, 1e-300, 4478.123456789}}};
  for (const auto& [type, values] : types) {
    SCOPED_TRACE(GDALGetDataTypeName(type));
    expect_heights(read_all(write("dem.tif", {.type = type, .values = values})), values);
  }
}

TEST_F(RasterValues, SignedBytesAreSigned) {
  const std::string dem = write("dem.tif", {.type = GDT_Byte,
                                            .values = {0, 1, 127, 128, 200, 255},
                                            .creation = {"PIXELTYPE=SIGNEDBYTE"},
                                            .declare = nodata(-128)});
  expect_heights(read_all(dem), {0, 1, 127, kNaN, -56, -1});
}

TEST_F(RasterValues, ComplexNumbersAreRefused) {
  for (const GDALDataType type : {GDT_CInt16, GDT_CInt32, GDT_CFloat32, GDT_CFloat64}) {
    const std::string dem = write("dem.tif", {.type = type});
    expect_error<InputError>([&] { read_all(dem); }, {"dem.tif", "complex", GDALGetDataTypeName(type)});
  }
}

TEST_F(RasterValues, NodataOfEveryTypeIsVoid) {
  const std::vector<std::pair<GDALDataType, double>> types{{GDT_Byte, 255},
                                                           {GDT_UInt16, 65535},
                                                           {GDT_Int16, -32768},
                                                           {GDT_UInt32, 4294967295},
                                                           {GDT_Int32, -9999},
                                                           {GDT_Int32, -2147483648.0},
                                                           {GDT_Float32, -9999.9},
                                                           {GDT_Float32, -3.4028234663852886e38},
                                                           {GDT_Float32, 1e-12},
                                                           {GDT_Float64, 1e20},
                                                           {GDT_Float64, -1.7976931348623157e308}};
  for (const auto& [type, value] : types) {
    SCOPED_TRACE(GDALGetDataTypeName(type));
    const std::string dem =
        write("dem.tif", {.type = type, .values = {1, value, 3, 4, 5, value}, .declare = nodata(value)});
    expect_heights(read_all(dem), {1, kNaN, 3, 4, 5, kNaN});
  }
}

TEST_F(RasterValues, NodataOfSixtyFourBitIntegersIsVoid) {
  const auto lowest = std::numeric_limits<std::int64_t>::min();
  const std::string signed_dem =
      write("signed.tif",
            {.type = GDT_Int64, .complete = [=](GDALDataset& dataset) {
               std::vector<std::int64_t> z{lowest, 2, 3, 4, 5, lowest};
               GDALRasterBand* band = dataset.GetRasterBand(1);
               band->SetNoDataValueAsInt64(lowest);
               ASSERT_EQ(band->RasterIO(GF_Write, 0, 0, 3, 2, z.data(), 3, 2, GDT_Int64, 0, 0, nullptr), CE_None);
             }});
  expect_heights(read_all(signed_dem), {kNaN, 2, 3, 4, 5, kNaN});
  const auto highest = std::numeric_limits<std::uint64_t>::max();
  const std::string unsigned_dem =
      write("unsigned.tif",
            {.type = GDT_UInt64, .complete = [=](GDALDataset& dataset) {
               std::vector<std::uint64_t> z{1, highest, 3, 4, 5, 6};
               GDALRasterBand* band = dataset.GetRasterBand(1);
               band->SetNoDataValueAsUInt64(highest);
               ASSERT_EQ(band->RasterIO(GF_Write, 0, 0, 3, 2, z.data(), 3, 2, GDT_UInt64, 0, 0, nullptr), CE_None);
             }});
  expect_heights(read_all(unsigned_dem), {1, kNaN, 3, 4, 5, 6});
}

TEST_F(RasterValues, NodataThatTheTypeCannotHoldIsNoSample) {
  const std::string dem = write("dem.tif", {.type = GDT_Byte, .values = {0, 1, 15, 241, 254, 255}});
  for (const double value : {-9999.0, 15.5, 1e30, kNaN, kInfinity, 256.0, -1.0}) {
    expect_heights(read_all(dem, with_nodata(value)), {0, 1, 15, 241, 254, 255});
  }
}

TEST_F(RasterValues, NodataGivenInDecimalsMatchesTheFloatsItStandsFor) {
  const double huge = -std::numeric_limits<float>::max();
  const double tenth = static_cast<double>(0.1F);
  const std::string dem = write("dem.tif", {.type = GDT_Float32, .values = {tenth, 2, huge, 4, 5, tenth}});
  expect_heights(read_all(dem, with_nodata(huge)), {tenth, 2, kNaN, 4, 5, tenth});
  expect_heights(read_all(dem, with_nodata(-3.4028235e38)), {tenth, 2, kNaN, 4, 5, tenth});
  expect_heights(read_all(dem, with_nodata(-3.4e38)), {tenth, 2, kNaN, 4, 5, tenth});
  const std::string low = write("low.tif", {.type = GDT_Float32, .values = {tenth, 2, 3, 4, 5, 0.10001}});
  expect_heights(read_all(low, with_nodata(0.1)), {kNaN, 2, 3, 4, 5, static_cast<double>(0.10001F)});
}

TEST_F(RasterValues, TheNodataOptionReplacesWhatTheFileDeclares) {
  const std::string dem = write("dem.tif", {.declare = nodata(3)});
  expect_heights(read_all(dem), {1, 2, kNaN, 4, 5, 6});
  expect_heights(read_all(dem, with_nodata(5)), {1, 2, 3, 4, kNaN, 6});
}

TEST_F(RasterValues, NaNIsVoidWhateverIsDeclared) {
  const std::string dem =
      write("dem.tif", {.type = GDT_Float32, .values = {1, kNaN, -9999, 4, 5, 6}, .declare = nodata(-9999)});
  expect_heights(read_all(dem), {1, kNaN, kNaN, 4, 5, 6});
  const std::string nan =
      write("nan.tif", {.type = GDT_Float64, .values = {1, kNaN, 3, 4, 5, 6}, .declare = nodata(kNaN)});
  expect_heights(read_all(nan), {1, kNaN, 3, 4, 5, 6});
}

TEST_F(RasterValues, TheMaskBandHidesItsSamplesAndNodataStaysVoid) {
  const std::string dem =
      write("dem.tif", {.declare = nodata(6), .complete = [](GDALDataset& dataset) {
                          ASSERT_EQ(dataset.CreateMaskBand(GMF_PER_DATASET), CE_None);
                          std::array<std::uint8_t, 6> mask{255, 0, 255, 0, 255, 255};
                          ASSERT_EQ(dataset.GetRasterBand(1)->GetMaskBand()->RasterIO(
                                        GF_Write, 0, 0, 3, 2, mask.data(), 3, 2, GDT_Byte, 0, 0, nullptr),
                                    CE_None);
                        }});
  expect_heights(read_all(dem), {1, kNaN, 3, kNaN, 5, kNaN});
}

TEST_F(RasterValues, AlphaZeroIsVoid) {
  GDALDatasetUniquePtr dataset(GetGDALDriverManager()->GetDriverByName("GTiff")->Create(path("dem.tif").c_str(), 3,
                                                                                        2, 2, GDT_UInt16, nullptr));
  dataset->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
  std::array<std::uint16_t, 12> bands{1, 2, 3, 4, 5, 6, 65535, 0, 1, 256, 0, 65535};
  ASSERT_EQ(dataset->RasterIO(GF_Write, 0, 0, 3, 2, bands.data(), 3, 2, GDT_UInt16, 2, nullptr, 0, 0, 0, nullptr),
            CE_None);
  dataset.reset();
  expect_heights(read_all(path("dem.tif")), {1, kNaN, 3, 4, kNaN, 6});
  expect_heights(read_all(path("dem.tif"), with_band(2)), {65535, 0, 1, 256, 0, 65535});
}

TEST_F(RasterValues, ScaleAndOffsetMakeHeightsOfValuesButNotOfNodata) {
  const std::string dem = write("dem.tif", {.declare = [](GDALDataset& dataset) {
                                  dataset.GetRasterBand(1)->SetScale(0.5);
                                  dataset.GetRasterBand(1)->SetOffset(100);
                                  dataset.GetRasterBand(1)->SetNoDataValue(2);
                                }});
  expect_heights(read_all(dem), {100.5, kNaN, 101.5, 102, 102.5, 103});
  const std::string flat =
      write("flat.tif", {.declare = [](GDALDataset& dataset) { dataset.GetRasterBand(1)->SetScale(0); }});
  expect_error<InputError>([&] { read_all(flat); }, {"flat.tif", "scale"});
}

TEST_F(RasterValues, WhatCannotBeAHeightIsNamedWithItsPlaceAndTheWayOut) {
  for (const auto& [value, text] : std::vector<std::pair<double, std::string>>{
           {kInfinity, "inf"}, {-kInfinity, "-inf"}, {1e30, "1e+30"}, {-2e10, "-20000000000"}}) {
    const std::string dem = write("dem.tif", {.type = GDT_Float64, .values = {1, 2, 3, 4, 5, value}});
    expect_error<InputError>([&] { read_all(dem); }, {"dem.tif", "column 2, row 1", text, "--nodata " + text});
    expect_heights(read_all(dem, with_nodata(value)), {1, 2, 3, 4, 5, kNaN});
  }
}

TEST_F(RasterValues, AnotherBandIsReadWhenAskedFor) {
  const std::string dem = write("dem.tif", {});
  expect_error<InputError>([&] { read_all(dem, with_band(2)); }, {"dem.tif", "band 2", "--band"});
  expect_error<UsageError>([&] { read_all(dem, with_band(0)); }, {"band 0"});
}

}  // namespace
}  // namespace tinsmith
