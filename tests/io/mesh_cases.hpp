#pragma once
// Meshes and georeferences for the tests of mesh files, and a folder to write them to.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "mesh/terrain_mesh.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

/// A folder of its own that goes away with the object.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "tinsmith-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() { std::filesystem::remove_all(path_); }
  std::string file(const std::string& name) const { return (path_ / name).string(); }
  std::size_t n_files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void put_bytes(const std::string& path, const std::string& bytes) {
  std::filesystem::remove(path);  // cutting off a file that is there makes some file systems wait for the disk
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

inline const char* const kUtm32 =
    "PROJCS[\"WGS 84 / UTM zone 32N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,"
    "298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_"
    "Mercator\"],"
    "PARAMETER[\"latitude_of_origin\",0],PARAMETER[\"central_meridian\",9],PARAMETER[\"scale_factor\",0.9996],"
    "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1],AUTHORITY[\"EPSG\","
    "\"32632\"]]";

/// North-up metres, south-up, turned by 30 degrees, degrees with feet, and no CRS at all.
inline std::vector<GridFrame> frames() {
  GridFrame utm;
  utm.geotransform = {412345.678, 30, 0, 5098765.432, 0, -30};
  utm.crs_wkt = kUtm32;
  GridFrame south_up = utm;
  south_up.geotransform[5] = 30;
  GridFrame turned = utm;
  turned.geotransform = {412345.678, 30 * std::sqrt(0.75), 15, 5098765.432, 15, -30 * std::sqrt(0.75)};
  GridFrame degrees;
  degrees.geotransform = {7 - 0.5 / 1200, 1.0 / 1200, 0, 46 + 0.5 / 1200, 0, -1.0 / 1200};
  degrees.crs_wkt =
      "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],PRIMEM[\"Greenwich\",0],"
      "UNIT[\"degree\",0.0174532925199433],AUTHORITY[\"EPSG\",\"4326\"]]";
  degrees.is_geographic = true;
  degrees.radians_per_unit = M_PI / 180;
  degrees.metres_per_vertical_unit = 0.3048;
  return {utm, south_up, turned, degrees, GridFrame{}};
}

/// Triangles all over a jittered lattice; every vertex is used.
inline TerrainMesh random_mesh(std::uint64_t seed, int n_columns, int n_rows) {
  std::mt19937_64 random(seed);
  TerrainMesh mesh;
  for (int j = 0; j <= n_rows; ++j)
    for (int i = 0; i <= n_columns; ++i) {
      mesh.position.push_back({i * 48 + static_cast<int>(random() % 16), j * 48 + static_cast<int>(random() % 16)});
      mesh.height.push_back(std::ldexp(static_cast<double>(random() >> 11), -41) - 17);  // -17 to 4079, 53 bits
    }
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(j * (n_columns + 1) + i); };
  for (int j = 0; j < n_rows; ++j)
    for (int i = 0; i < n_columns; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

}  // namespace tinsmith
