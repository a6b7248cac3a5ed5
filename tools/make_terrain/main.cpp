// make_terrain: writes terrain from a seed as a GeoTIFF of any size.

#include <cpl_error.h>
#include <gdal.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <string>

#include "terrain.hpp"
#include "terrain_file.hpp"
#include "tinsmith/error.hpp"

namespace {

using namespace tinsmith;

struct Words {
  std::string output;
  std::string size = "1025x1025";
  std::string kind = "fractal";
  std::string voids = "none";
  std::string type = "float32";
  std::string crs = "32632";
};

void declare(CLI::App& app, Words& words, Terrain& terrain, TerrainFileOptions& options) {
  app.add_option("OUTPUT", words.output, "the GeoTIFF to write")->required();
  app.add_option("--kind", words.kind, "plane flat cone ridge step fractal sea")->capture_default_str();
  app.add_option("--voids", words.voids, "none square diagonal ragged checker holes bridges border")
      ->capture_default_str();
  app.add_option("--size", words.size, "WIDTHxHEIGHT in samples")->capture_default_str();
  app.add_option("--seed", terrain.seed, "of all that is random")->capture_default_str();
  app.add_option("--type", words.type, "int16 int32 float32 float64")->capture_default_str();
  app.add_option("--cell", terrain.cell, "metres between samples")->capture_default_str();
  app.add_option("--amplitude", terrain.amplitude, "metres: heights lie within 0 and this")->capture_default_str();
  app.add_option("--nodata", options.nodata, "default: -32768 for integers, NaN for floats");
  app.add_option("--crs", words.crs, "EPSG code, or none")->capture_default_str();
}

/// "WIDTHxHEIGHT", both from 1 to 1 000 000.
void read_size(const std::string& text, Terrain& terrain) {
  int length = 0;
  const int n = std::sscanf(text.c_str(), "%dx%d%n", &terrain.width, &terrain.height, &length);
  constexpr std::int32_t kMost = 1000000;
  if (n != 2 || static_cast<std::size_t>(length) != text.size() || terrain.width < 1 || terrain.height < 1 ||
      terrain.width > kMost || terrain.height > kMost) {
    throw UsageError("--size " + text + ": give samples as WIDTHxHEIGHT, for example 1025x1025");
  }
}

template <class T>
T known(const std::optional<T>& found, const char* option, const std::string& word) {
  if (!found) throw UsageError(std::string(option) + " " + word + ": unknown; --help lists what there is");
  return *found;
}

int epsg_of(const std::string& text) {
  if (text == "none") return 0;
  const bool is_number =
      !text.empty() && text.size() < 9 && text.find_first_not_of("0123456789") == std::string::npos;
  if (!is_number) throw UsageError("--crs " + text + ": give an EPSG code or none");
  return std::stoi(text);
}

void interpret(const Words& words, Terrain& terrain, TerrainFileOptions& options) {
  read_size(words.size, terrain);
  terrain.kind = known(terrain_kind(words.kind), "--kind", words.kind);
  terrain.voids = known(void_kind(words.voids), "--voids", words.voids);
  options.type = known(sample_type(words.type), "--type", words.type);
  options.epsg = epsg_of(words.crs);
  if (!(terrain.cell > 0) || !std::isfinite(terrain.cell)) throw UsageError("--cell: give metres above 0");
  if (!std::isfinite(terrain.amplitude)) throw UsageError("--amplitude: give metres");
}

int run(int argc, char** argv) {
  CLI::App app("Writes terrain from a seed as a GeoTIFF of any size; the same options, the same heights.");
  Words words;
  Terrain terrain;
  TerrainFileOptions options;
  declare(app, words, terrain, options);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  GDALSetCacheMax64(std::int64_t{64} << 20);  // blocks are written once: no more need be held
  CPLSetErrorHandler(CPLQuietErrorHandler);   // what GDAL says becomes part of our one line
  interpret(words, terrain, options);
  write_terrain(words.output, terrain, options);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const Error& error) {
    std::fprintf(stderr, "make_terrain: %s\n", error.what());
    return error.exit_code();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make_terrain: %s; check the folder and its free space\n", error.what());
    return 4;
  }
}
