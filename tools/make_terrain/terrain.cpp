#include "terrain.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "gradient_noise.hpp"

namespace tinsmith {

namespace {

constexpr double kMassif = 24000;  // metres: the wavelength of the largest mountains

/// As many octaves as it takes from the wavelength down to two samples, the finest that a raster can hold.
int n_octaves_of(double wavelength, double cell) {
  int n = 1;
  for (; n < 24 && wavelength > 4 * cell; wavelength /= 2) ++n;
  return n;
}

double plane_height(const Terrain& t, double column, double row) {
  const auto steps = static_cast<std::uint64_t>(2 * static_cast<std::int64_t>(t.width) + t.height);
  return t.amplitude * ((2 * column + row) / static_cast<double>(std::bit_ceil(steps)));
}

double cone_height(const Terrain& t, double column, double row) {
  const double dx = column - (t.width - 1) / 2.0;
  const double dy = row - (t.height - 1) / 2.0;
  const double radius = 0.45 * std::min(t.width, t.height);
  return t.amplitude * std::max(0.0, 1 - std::sqrt(dx * dx + dy * dy) / radius);
}

double ridge_height(const Terrain& t, double column, double row) {
  const double dx = column - (t.width - 1) / 2.0;
  const double dy = row - (t.height - 1) / 2.0;
  const double distance = std::abs(0.8 * dx + 0.6 * dy);
  return t.amplitude * (1 - distance / (0.4 * t.width + 0.3 * t.height));
}

/// The noise of one terrain, with the cells that neighbouring samples share kept warm.
class Relief {
 public:
  explicit Relief(const Terrain& t)
      : per_sample_(t.cell / kMassif),
        warp_x_(hash_of(t.seed, 1, 0), 3),
        warp_y_(hash_of(t.seed, 2, 0), 3),
        land_(hash_of(t.seed, 3, 0), 2),
        mountains_(hash_of(t.seed, 4, 0), n_octaves_of(kMassif, t.cell)) {}

  /// Within [0, 1]: massifs with ridges, and valleys and plains between them.
  double mountains(double column, double row) {
    const auto [x, y] = warped(column, row);
    const double land = std::clamp(0.5 + 1.5 * land_.sum(0.5 * x, 0.5 * y), 0.0, 1.0);
    return land * (0.1 + 0.9 * mountains_.ridged(x, y));
  }

  /// Within [0, 1], 0 on most of the ground: islands.
  double islands(double column, double row) {
    const auto [x, y] = warped(column, row);
    const double land = std::max(0.0, 2 * land_.sum(1.5 * x, 1.5 * y) - 0.35);
    return land > 0 ? std::min(1.0, land * (0.2 + 1.5 * mountains_.ridged(x, y))) : 0;
  }

 private:
  /// Bends the ground, so that ridges wind and fork.
  std::pair<double, double> warped(double column, double row) {
    constexpr double kBend = 0.5;
    const double x = column * per_sample_;
    const double y = row * per_sample_;
    return {x + kBend * warp_x_.sum(x, y), y + kBend * warp_y_.sum(x, y)};
  }

  double per_sample_;  // massifs
  Octaves warp_x_;
  Octaves warp_y_;
  Octaves land_;
  Octaves mountains_;
};

double height_of(const Terrain& t, Relief& relief, std::int32_t column, std::int32_t row) {
  switch (t.kind) {
    case TerrainKind::kPlane:
      return plane_height(t, column, row);
    case TerrainKind::kFlat:
      return t.amplitude / 2;
    case TerrainKind::kCone:
      return cone_height(t, column, row);
    case TerrainKind::kRidge:
      return ridge_height(t, column, row);
    case TerrainKind::kStep:
      return column < t.width / 2 ? 0 : t.amplitude;
    case TerrainKind::kFractal:
      return t.amplitude * relief.mountains(column, row);
    case TerrainKind::kSea:
      return t.amplitude * relief.islands(column, row);
  }
  return 0;
}

bool is_middle(std::int32_t i, std::int32_t n) { return i >= n / 3 && i < n - n / 3; }

bool is_checker_void(std::int32_t column, std::int32_t row) {
  return column % 8 != 0 && row % 8 != 0 && (column / 8 + row / 8) % 2 == 1;
}

bool is_bridges_void(std::int32_t column, std::int32_t row) { return column % 16 >= 12 && row % 32 >= 2; }

/// Outside of the largest rectangle of these proportions that still fits in when it is turned.
bool is_border_void(const Terrain& t, std::int32_t column, std::int32_t row) {
  constexpr double kCos = 0.96;
  constexpr double kSin = 0.28;
  const double half_x = (t.width - 1) / 2.0;
  const double half_y = (t.height - 1) / 2.0;
  const double dx = column - half_x;
  const double dy = row - half_y;
  const double fit = std::min(half_x / (kCos * half_x + kSin * half_y), half_y / (kSin * half_x + kCos * half_y));
  return std::abs(kCos * dx + kSin * dy) > fit * half_x || std::abs(kCos * dy - kSin * dx) > fit * half_y;
}

/// The ragged voids, whose patches are some forty samples wide.
class Rags {
 public:
  explicit Rags(std::uint64_t seed) : noise_(hash_of(seed, 5, 0), 6) {}
  bool is_void(std::int32_t column, std::int32_t row) { return noise_.sum(column / 80.0, row / 80.0) > 0.115; }

 private:
  Octaves noise_;
};

bool is_void_of(const Terrain& t, Rags& rags, std::int32_t column, std::int32_t row) {
  switch (t.voids) {
    case VoidKind::kNowhere:
      return false;
    case VoidKind::kSquare:
      return is_middle(column, t.width) && is_middle(row, t.height);
    case VoidKind::kDiagonal:
      return (column + row) % 16 == 15 && column % 2 == 0;
    case VoidKind::kRagged:
      return rags.is_void(column, row);
    case VoidKind::kChecker:
      return is_checker_void(column, row);
    case VoidKind::kHoles:
      return hash_of(t.seed, column, row) % 64 == 0;
    case VoidKind::kBridges:
      return is_bridges_void(column, row);
    case VoidKind::kBorder:
      return is_border_void(t, column, row);
  }
  return false;
}

constexpr std::array<std::pair<std::string_view, TerrainKind>, 7> kTerrainNames{{
    {"plane", TerrainKind::kPlane},
    {"flat", TerrainKind::kFlat},
    {"cone", TerrainKind::kCone},
    {"ridge", TerrainKind::kRidge},
    {"step", TerrainKind::kStep},
    {"fractal", TerrainKind::kFractal},
    {"sea", TerrainKind::kSea},
}};

constexpr std::array<std::pair<std::string_view, VoidKind>, 8> kVoidNames{{
    {"none", VoidKind::kNowhere},
    {"square", VoidKind::kSquare},
    {"diagonal", VoidKind::kDiagonal},
    {"ragged", VoidKind::kRagged},
    {"checker", VoidKind::kChecker},
    {"holes", VoidKind::kHoles},
    {"bridges", VoidKind::kBridges},
    {"border", VoidKind::kBorder},
}};

template <class Names>
auto find_kind(const Names& names, std::string_view name) -> std::optional<decltype(names[0].second)> {
  for (const auto& [known, kind] : names) {
    if (known == name) return kind;
  }
  return std::nullopt;
}

}  // namespace

double height_at(const Terrain& terrain, std::int32_t column, std::int32_t row) {
  Relief relief(terrain);
  return height_of(terrain, relief, column, row);
}

bool is_void_at(const Terrain& terrain, std::int32_t column, std::int32_t row) {
  Rags rags(terrain.seed);
  return is_void_of(terrain, rags, column, row);
}

HeightGrid heights_of(const Terrain& terrain, const GridRect& rect) {
  constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();
  HeightGrid grid{rect, {}};
  grid.z.reserve(static_cast<std::size_t>(rect.area()));
  Relief relief(terrain);
  Rags rags(terrain.seed);
  for (std::int32_t row = rect.y0; row < rect.y0 + rect.height; ++row) {
    for (std::int32_t column = rect.x0; column < rect.x0 + rect.width; ++column) {
      const bool inside = column >= 0 && row >= 0 && column < terrain.width && row < terrain.height;
      const bool valid = inside && !is_void_of(terrain, rags, column, row);
      grid.z.push_back(valid ? height_of(terrain, relief, column, row) : kVoid);
    }
  }
  return grid;
}

std::optional<TerrainKind> terrain_kind(std::string_view name) { return find_kind(kTerrainNames, name); }

std::optional<VoidKind> void_kind(std::string_view name) { return find_kind(kVoidNames, name); }

}  // namespace tinsmith
