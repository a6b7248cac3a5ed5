#include "geodesy/crs.hpp"

#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <array>
#include <cctype>
#include <cmath>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

struct NamedUnit {
  std::string_view names;  // letters only, each between two spaces
  double metres;
};

// As GDAL, PROJ, ESRI, EPSG and LAS write them.
constexpr std::array<NamedUnit, 9> kNamedUnits{{
    {" m metre metres meter meters mtr ", 1},
    {" ft foot feet ift ftint footint internationalft internationalfoot internationalfeet intlft intlfoot ",
     0.3048},
    {" usft ftus usfoot usfeet footus feetus ussft sft surveyfoot surveyfeet ussurveyft ussurveyfoot "
     "ussurveyfeet footussurvey ",
     1200.0 / 3937.0},
    {" mm millimetre millimetres millimeter millimeters ", 0.001},
    {" cm centimetre centimetres centimeter centimeters ", 0.01},
    {" dm decimetre decimetres decimeter decimeters ", 0.1},
    {" km kilometre kilometres kilometer kilometers ", 1000},
    {" yd yard yards ", 0.9144},
    {" fathom fathoms ", 1.8288},
}};

bool is_length(double metres) { return std::isfinite(metres) && metres > 0; }

void parse(OGRSpatialReference& crs, const std::string& wkt, const std::string& where) {
  if (crs.importFromWkt(wkt.c_str()) == OGRERR_NONE) return;
  throw InputError(fmt::format("{}: its CRS can't be understood; set one with gdal_edit.py -a_srs", where));
}

std::string name_of(const OGRSpatialReference& crs) {
  const char* name = crs.GetName();
  return name != nullptr ? name : "unnamed";
}

void read_angle(const OGRSpatialReference& crs, CrsUnits& units) {
  const char* name = nullptr;
  units.is_geographic = true;
  units.radians_per_unit = crs.GetAngularUnits(&name);
  units.horizontal_unit = name != nullptr ? name : "degree";
  units.equatorial_radius = crs.GetSemiMajor();
  const double inverse = crs.GetInvFlattening();
  units.flattening = inverse == 0 ? 0 : 1 / inverse;  // 0 is OGR's word for a sphere
}

// OGR answers "unknown" and 1 when the CRS does not say. A factor other than 1 is believed without a name.
void read_length(const OGRSpatialReference& crs, const std::string& where, CrsUnits& units) {
  const char* name = nullptr;
  units.metres_per_horizontal_unit = crs.GetTargetLinearUnits(crs.IsProjected() ? "PROJCS" : "LOCAL_CS", &name);
  units.horizontal_unit = name != nullptr ? name : "unknown";
  const bool is_named = units.horizontal_unit != "unknown" && !units.horizontal_unit.empty();
  if (is_length(units.metres_per_horizontal_unit) && (is_named || units.metres_per_horizontal_unit != 1)) return;
  throw InputError(
      fmt::format("{}: its CRS '{}' does not say how long its unit is; set a CRS with gdal_edit.py -a_srs", where,
                  name_of(crs)));
}

std::optional<double> read_vertical_axis(const OGRSpatialReference& crs) {
  if (crs.GetAxesCount() < 3) return std::nullopt;
  OGRAxisOrientation orientation = OAO_Other;
  double metres = 0;
  if (crs.GetAxis(nullptr, 2, &orientation, &metres) == nullptr || !is_length(metres)) return std::nullopt;
  return metres;
}

// "US survey foot", "us-survey_FOOT" and "Foot (US)" differ in what is no letter only.
std::string letters_of(std::string_view text) {
  std::string letters;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0) letters += static_cast<char>(std::tolower(u));
  }
  return letters;
}

}  // namespace

CrsUnits crs_units(const std::string& wkt, const std::string& where) {
  CrsUnits units;
  if (wkt.empty()) return units;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  OGRSpatialReference crs;
  parse(crs, wkt, where);
  if (crs.IsGeographic()) {
    read_angle(crs, units);
  } else if (crs.IsProjected() || crs.IsLocal()) {
    read_length(crs, where, units);
  } else {
    throw InputError(
        fmt::format("{}: its CRS '{}' has no horizontal axes; bring it to a projected or geographic CRS "
                    "with gdalwarp -t_srs",
                    where, name_of(crs)));
  }
  units.metres_per_height = read_vertical_axis(crs);
  return units;
}

bool is_same_crs(const std::string& a, const std::string& b) {
  if (a == b) return true;
  if (a.empty() || b.empty()) return false;
  const CPLErrorHandlerPusher quiet(CPLQuietErrorHandler);
  OGRSpatialReference one;
  OGRSpatialReference other;
  if (one.importFromWkt(a.c_str()) != OGRERR_NONE || other.importFromWkt(b.c_str()) != OGRERR_NONE) return false;
  const std::array<const char*, 3> options{"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                           "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  return one.IsSame(&other, options.data()) != 0;
}

std::optional<double> metres_per_named_unit(std::string_view name) {
  const std::string word = fmt::format(" {} ", letters_of(name));
  if (word == "  ") return std::nullopt;
  for (const NamedUnit& unit : kNamedUnits) {
    if (unit.names.find(word) != std::string_view::npos) return unit.metres;
  }
  return std::nullopt;
}

}  // namespace tinsmith
