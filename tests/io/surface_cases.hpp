#pragma once
// Surfaces for the tests of surface files, and what every surface that was read must be.

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>
#include <string>
#include <tuple>

#include "io/mesh_cases.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/surface.hpp"

namespace tinsmith {

/// A closed torus; unit normals, colours in whole bytes, one scalar. `offset` moves it away from the origin.
inline Surface torus(std::uint32_t n, double offset) {
  Surface surface;
  surface.attributes.resize(3);
  surface.attributes[0].kind = AttributeKind::kColour;
  surface.attributes[1].kind = AttributeKind::kNormal;
  surface.attributes[2].name = "quality";
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const double u = 2 * std::numbers::pi * i / n;
      const double w = 2 * std::numbers::pi * j / n;
      const double nx = std::cos(u) * std::cos(w);
      const double ny = std::sin(u) * std::cos(w);
      const double nz = std::sin(w);
      surface.position.push_back(
          {offset + 3 * std::cos(u) + nx, 2 * offset + 3 * std::sin(u) + ny, offset / 3 + nz});
      for (const double c : {nx, ny, nz}) {
        surface.attributes[0].values.push_back(static_cast<float>(std::lround(127.5 + 127.5 * c)) / 255.0F);
        surface.attributes[1].values.push_back(static_cast<float>(c));
      }
      surface.attributes[2].values.push_back(static_cast<float>(i) - 0.1F * static_cast<float>(j));
      const std::uint32_t a = i * n + j;
      const std::uint32_t b = (i + 1) % n * n + j;
      const std::uint32_t c = (i + 1) % n * n + (j + 1) % n;
      const std::uint32_t d = i * n + (j + 1) % n;
      surface.triangles.push_back({a, b, c});
      surface.triangles.push_back({a, c, d});
    }
  return surface;
}

/// Six times the volume that the triangles enclose.
inline double six_volumes(const Surface& surface) {
  double sum = 0;
  for (const auto& [i, j, k] : surface.triangles) {
    const auto& [a, b, c] = std::tie(surface.position[i], surface.position[j], surface.position[k]);
    sum += a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
  }
  return sum;
}

/// What read_surface guarantees of all that it returns.
inline void expect_sound(const Surface& surface) {
  ASSERT_FALSE(surface.triangles.empty());
  for (const auto& triangle : surface.triangles)
    for (const std::uint32_t corner : triangle) ASSERT_LT(corner, surface.position.size());
  for (const auto& place : surface.position)
    for (const double coordinate : place) ASSERT_TRUE(std::isfinite(coordinate));
  for (const SurfaceAttribute& attribute : surface.attributes) {
    const auto n = static_cast<std::size_t>(attribute.components());
    ASSERT_EQ(attribute.values.size(), n * surface.position.size());
    for (const float value : attribute.values) {
      ASSERT_TRUE(std::isfinite(value));
      ASSERT_TRUE(attribute.kind != AttributeKind::kColour || (value >= 0 && value <= 1)) << value;
    }
    if (attribute.kind != AttributeKind::kNormal) continue;
    for (std::size_t k = 0; k < attribute.values.size(); k += 3) {
      const float* v = &attribute.values[k];
      const double squared = double{v[0]} * v[0] + double{v[1]} * v[1] + double{v[2]} * v[2];
      ASSERT_TRUE(squared == 0 || std::abs(squared - 1) < 2e-6) << squared;
    }
  }
}

/// Reads bytes as a file of this extension.
inline Surface read_bytes(const ScratchFolder& folder, const std::string& extension, const std::string& bytes) {
  const std::string path = folder.file("bytes" + extension);
  std::filesystem::remove(path);  // some file systems wait for the disk when a file is cut to nothing
  put_bytes(path, bytes);
  Surface surface = read_surface(path);
  expect_sound(surface);
  return surface;
}

/// The text of the InputError that reading these bytes ends with; empty when there is none.
inline std::string complaint_about(const ScratchFolder& folder, const std::string& extension,
                                   const std::string& bytes) {
  try {
    read_bytes(folder, extension, bytes);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Appends the bytes of a number, in the machine's order or turned round.
template <class T>
void append_bytes(std::string& bytes, T value, bool is_reversed = false) {
  std::string own(sizeof value, '\0');
  std::memcpy(own.data(), &value, sizeof value);
  if (is_reversed) own = std::string(own.rbegin(), own.rend());
  bytes += own;
}

}  // namespace tinsmith
