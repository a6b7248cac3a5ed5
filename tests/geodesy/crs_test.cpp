#include "geodesy/crs.hpp"

#include <gtest/gtest.h>
#include <ogr_spatialref.h>

#include <numbers>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr double kUsFoot = 1200.0 / 3937.0;

std::string wkt(const char* name) {
  OGRSpatialReference crs;
  EXPECT_EQ(crs.SetFromUserInput(name), OGRERR_NONE) << name;
  char* text = nullptr;
  crs.exportToWkt(&text);
  std::string result = text;
  CPLFree(text);
  return result;
}

CrsUnits units(const char* name) { return crs_units(wkt(name), "dem.tif"); }

TEST(Crs, NoCrsMeansMetres) {
  EXPECT_FALSE(crs_units("", "dem.tif").is_geographic);
  EXPECT_EQ(crs_units("", "dem.tif").metres_per_horizontal_unit, 1);
}

TEST(Crs, EveryProjectedUnitIsReckonedInMetres) {
  EXPECT_EQ(units("EPSG:32632").metres_per_horizontal_unit, 1);
  EXPECT_DOUBLE_EQ(units("EPSG:2994").metres_per_horizontal_unit, 0.3048);
  EXPECT_DOUBLE_EQ(units("EPSG:2263").metres_per_horizontal_unit, kUsFoot);
  EXPECT_EQ(units("EPSG:2263").horizontal_unit, "US survey foot");
  EXPECT_DOUBLE_EQ(units("+proj=utm +zone=32 +to_meter=0.5").metres_per_horizontal_unit, 0.5);
}

TEST(Crs, GeographicHasItsAngleAndItsEllipsoid) {
  const CrsUnits degrees = units("EPSG:4326");
  EXPECT_TRUE(degrees.is_geographic);
  EXPECT_NEAR(degrees.radians_per_unit, std::numbers::pi / 180, 1e-16);
  EXPECT_NEAR(units("EPSG:4807").radians_per_unit, std::numbers::pi / 200, 1e-16);
  EXPECT_EQ(units("EPSG:4807").equatorial_radius, 6378249.2);
  EXPECT_EQ(units("+proj=longlat +R=1737400 +no_defs").flattening, 0);
}

TEST(Crs, TheVerticalAxisSaysItsUnit) {
  EXPECT_FALSE(units("EPSG:2263").metres_per_height);
  EXPECT_DOUBLE_EQ(units("EPSG:4326+8228").metres_per_height.value_or(0), 0.3048);
  EXPECT_DOUBLE_EQ(units("EPSG:2263+6360").metres_per_height.value_or(0), kUsFoot);
  EXPECT_DOUBLE_EQ(units("EPSG:2263+5703").metres_per_height.value_or(0), 1);
  EXPECT_DOUBLE_EQ(units("EPSG:4979").metres_per_height.value_or(0), 1);
}

TEST(Crs, AnUnknownUnitIsRefusedWithTheFileAndTheCrs) {
  try {
    crs_units(R"(LOCAL_CS["building site",UNIT["unknown",1]])", "dem.tif");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("dem.tif"), std::string::npos) << text;
    EXPECT_NE(text.find("building site"), std::string::npos) << text;
  }
  EXPECT_DOUBLE_EQ(units(R"(LOCAL_CS["site",UNIT["foot",0.3048]])").metres_per_horizontal_unit, 0.3048);
}

TEST(Crs, WhatHasNoHorizontalAxesIsRefused) {
  EXPECT_THROW(units("EPSG:5773"), InputError);
  EXPECT_THROW(units("EPSG:4978"), InputError);
  EXPECT_THROW(crs_units("PROJCS[rubbish", "dem.tif"), InputError);
}

TEST(Crs, TheSameCrsInAnotherDialectIsTheSame) {
  OGRSpatialReference crs;
  crs.importFromEPSG(32632);
  char* wkt2 = nullptr;
  const char* options[] = {"FORMAT=WKT2_2019", nullptr};
  crs.exportToWkt(&wkt2, options);
  EXPECT_TRUE(is_same_crs(wkt("EPSG:32632"), wkt2));
  CPLFree(wkt2);
  EXPECT_FALSE(is_same_crs(wkt("EPSG:32632"), wkt("EPSG:32633")));
  EXPECT_FALSE(is_same_crs(wkt("EPSG:32632"), ""));
  EXPECT_TRUE(is_same_crs("", ""));
}

TEST(Crs, UnitNamesAreReadHoweverTheyAreSpelt) {
  for (const char* metre : {"m", "M", "metre", "Meters", " metres "})
    EXPECT_EQ(metres_per_named_unit(metre), 1) << metre;
  for (const char* foot : {"ft", "foot", "Feet", "International Foot"})
    EXPECT_EQ(metres_per_named_unit(foot), 0.3048);
  for (const char* foot : {"us-ft", "US survey foot", "ftUS", "Foot_US", "US Survey Feet", "foot (US survey)"}) {
    EXPECT_EQ(metres_per_named_unit(foot), kUsFoot) << foot;
  }
  for (const char* none : {"", "  ", "K", "dBZ", "feets", "degree"})
    EXPECT_FALSE(metres_per_named_unit(none)) << none;
}

}  // namespace
}  // namespace tinsmith
