#pragma once
// Terrain from a seed, for tests and benchmarks. Each height is a function of its column and row alone, so
// any block of a raster of any size can be had by itself and is the same as that part of the whole.
// Only additions, multiplications, divisions and square roots: the same bits on every machine.

#include <cstdint>
#include <optional>
#include <string_view>

#include "samples/height_grid.hpp"

namespace tinsmith {

enum class TerrainKind {
  kPlane,    // inclined; the slopes are dyadic, so that float32 holds it exactly
  kFlat,     // half the amplitude everywhere
  kCone,     // in the middle of a flat ground at 0; the apex is a sample when the sizes are odd
  kRidge,    // a roof whose ridge runs askew of the grid
  kStep,     // 0 in the left half, the amplitude in the right one
  kFractal,  // mountains with ridges and valleys
  kSea,      // exactly 0, with islands
};

enum class VoidKind {
  kNowhere,
  kSquare,    // one rectangle in the middle
  kDiagonal,  // every other sample along every 16th diagonal: rows of pinches, where two valid cells share a corner
              // only
  kRagged,    // about a seventh of the samples, in patches with ragged rims and islands
  kChecker,   // squares of 8 x 8 cells as on a board, valid ones pinched together at their corners
  kHoles,     // single samples, one in 64
  kBridges,   // stripes, crossed by bridges that are one cell wide
  kBorder,    // a frame, from a raster that was turned by some degrees
};

struct Terrain {
  TerrainKind kind = TerrainKind::kFractal;
  VoidKind voids = VoidKind::kNowhere;
  std::uint64_t seed = 1;      // of fractal and sea, and of the voids ragged and holes
  std::int32_t width = 1025;   // samples
  std::int32_t height = 1025;  // samples
  double cell = 30;            // metres between samples; mountains keep their size on the ground
  double amplitude = 2000;     // metres; heights lie within 0 and this
};

/// The height at a sample, voids not regarded.
double height_at(const Terrain& terrain, std::int32_t column, std::int32_t row);

/// Whether the sample is a void.
bool is_void_at(const Terrain& terrain, std::int32_t column, std::int32_t row);

/// The heights of a rectangle; voids, and what lies outside the terrain, are NaN.
HeightGrid heights_of(const Terrain& terrain, const GridRect& rect);

/// From the names of the kinds as written above, without k and in lower case; empty when there is none such.
std::optional<TerrainKind> terrain_kind(std::string_view name);
std::optional<VoidKind> void_kind(std::string_view name);

/// A terrain as the source of samples that the stages of tinsmith ask for.
class TerrainField : public HeightField {
 public:
  explicit TerrainField(const Terrain& terrain) : terrain_(terrain) {}
  std::int32_t width() const override { return terrain_.width; }
  std::int32_t height() const override { return terrain_.height; }
  HeightGrid read(const GridRect& rect) const override { return heights_of(terrain_, rect); }

 private:
  Terrain terrain_;
};

}  // namespace tinsmith
