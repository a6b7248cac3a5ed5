#pragma once
// Terrain as a tiled, compressed GeoTIFF, written in blocks.

#include <optional>
#include <string>

#include "terrain.hpp"

namespace tinsmith {

enum class SampleType { kInt16, kInt32, kFloat32, kFloat64 };

struct TerrainFileOptions {
  SampleType type = SampleType::kFloat32;
  std::optional<double> nodata;  // default: -32768 for integers, NaN for floats
  int epsg = 32632;              // CRS; 0: none
};

/// Writes the terrain to `path`, north up, heights in metres; integers are rounded to the nearest. Blocks that are
/// all void take no space. Memory does not depend on the size. Written aside and renamed. Throws OutputError.
void write_terrain(const std::string& path, const Terrain& terrain, const TerrainFileOptions& options);

/// From the names int16, int32, float32, float64; empty when there is none such.
std::optional<SampleType> sample_type(std::string_view name);

}  // namespace tinsmith
