#pragma once
// Small grids and hand-made meshes over them for the tests of the judge.

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "geodesy/grid_frame.hpp"
#include "judge/measure.hpp"
#include "samples/array_field.hpp"
#include "tinsmith/certificate.hpp"
#include "tinsmith/tin.hpp"

namespace tinsmith {

inline constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

/// A grid of heights, and a mesh whose vertices are given as column, row and height.
struct Scene {
  std::int32_t width = 0;
  std::int32_t height = 0;
  std::vector<double> z;
  std::vector<std::array<double, 3>> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise in the grid
  GridFrame frame;

  double& at(int x, int y) { return z[static_cast<std::size_t>(y * width + x)]; }

  Tin tin() const {
    Tin tin{vertices, triangles, {}};
    for (auto& v : tin.vertices) {
      const auto [x, y] = frame.to_crs(v[0], v[1]);
      v = {x, y, v[2]};
    }
    if (frame.is_mirrored())
      for (auto& t : tin.triangles) std::swap(t[1], t[2]);
    return tin;
  }

  Certificate judged(BlockSize block = {}, const Budget& budget = {}) const {
    const ArrayField field(z.data(), width, height);
    return measure(tin(), {field, frame, block, {}}, budget);
  }
};

/// Every sample a vertex, two triangles for each valid cell, the diagonal from (x, y) to (x + 1, y + 1).
inline void mesh_fully(Scene& scene) {
  scene.vertices.clear();
  scene.triangles.clear();
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const double z = scene.at(x, y);
      scene.vertices.push_back({double(x), double(y), std::isnan(z) ? 0 : z});
    }
  for (int y = 0; y + 1 < scene.height; ++y)
    for (int x = 0; x + 1 < scene.width; ++x) {
      const auto a = static_cast<std::uint32_t>(y * scene.width + x);
      const auto below = a + static_cast<std::uint32_t>(scene.width);
      if (std::isnan(scene.z[a] + scene.z[a + 1] + scene.z[below] + scene.z[below + 1])) continue;
      scene.triangles.push_back({a, a + 1, below + 1});
      scene.triangles.push_back({a, below + 1, below});
    }
}

/// A plane, meshed fully. All its heights are exact.
inline Scene full_plane(int width, int height) {
  Scene scene{width, height, {}, {}, {}, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) scene.z.push_back(100 + 2 * x - 3 * y);
  mesh_fully(scene);
  return scene;
}

/// The same plane as two triangles.
inline Scene plane_of_two(int width, int height) {
  Scene scene = full_plane(width, height);
  const double right = width - 1;
  const double bottom = height - 1;
  scene.vertices = {{0, 0, 100},
                    {right, 0, 100 + 2 * right},
                    {right, bottom, 100 + 2 * right - 3 * bottom},
                    {0, bottom, 100 - 3 * bottom}};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}};
  return scene;
}

}  // namespace tinsmith
