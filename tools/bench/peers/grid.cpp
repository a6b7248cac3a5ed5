#include "grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace bench {

namespace {

using Point = std::array<double, 2>;

/// Sample (0, 0) is the centre of the upper left cell.
Point to_crs(const Grid& grid, double column, double row) {
  const auto& g = grid.geotransform;
  const double x = column + 0.5;
  const double y = row + 0.5;
  return {g[0] + x * g[1] + y * g[2], g[3] + x * g[4] + y * g[5]};
}

double plan_area(const std::vector<std::array<double, 3>>& vertices,
                 const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0;
  for (const auto& [i, j, k] : triangles) {
    const auto& a = vertices[i];
    const auto& b = vertices[j];
    const auto& c = vertices[k];
    sum += (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  return sum / 2;
}

bool is_valid_cell(const Grid& grid, std::size_t at) {
  const auto width = static_cast<std::size_t>(grid.width);
  const auto& z = grid.z;
  return !std::isnan(z[at]) && !std::isnan(z[at + 1]) && !std::isnan(z[at + width]) &&
         !std::isnan(z[at + width + 1]);
}

}  // namespace

Grid read_grid(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error(path + ": no grid file; make one with dump");
  const auto header = nlohmann::json::parse(line);
  Grid grid;
  grid.width = header.at("width");
  grid.height = header.at("height");
  grid.step = header.at("step");
  grid.unit = header.at("unit");
  grid.geotransform = header.at("geotransform");
  grid.crs = header.at("crs");
  grid.has_voids = header.at("has_voids");
  grid.z.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  if (!file.read(reinterpret_cast<char*>(grid.z.data()),
                 static_cast<std::streamsize>(grid.z.size() * sizeof(float))))
    throw std::runtime_error(path + ": the grid file ends too early; make it again with dump");
  return grid;
}

Mesh full_mesh(const Grid& grid) {
  Mesh mesh;
  for (std::int32_t row = 0; row < grid.height; ++row) {
    for (std::int32_t column = 0; column < grid.width; ++column) {
      const auto at = static_cast<std::uint32_t>(row * grid.width + column);
      mesh.vertices.push_back({static_cast<double>(column), static_cast<double>(row), grid.z[at]});
      if (row + 1 == grid.height || column + 1 == grid.width || !is_valid_cell(grid, at)) continue;
      const auto below = at + static_cast<std::uint32_t>(grid.width);
      mesh.triangles.push_back({at, at + 1, below});
      mesh.triangles.push_back({at + 1, below + 1, below});
    }
  }
  if (grid.has_voids) compact(mesh);
  return mesh;
}

void compact(Mesh& mesh) {
  constexpr std::uint32_t kUnused = 0xffffffff;
  std::vector<std::uint32_t> number(mesh.vertices.size(), kUnused);
  std::vector<std::array<double, 3>> used;
  for (auto& triangle : mesh.triangles) {
    for (auto& v : triangle) {
      if (number[v] == kUnused) {
        number[v] = static_cast<std::uint32_t>(used.size());
        used.push_back(mesh.vertices[v]);
      }
      v = number[v];
    }
  }
  mesh.vertices = std::move(used);
}

void to_metres(Mesh& mesh, const Grid& grid) {
  for (auto& [x, y, z] : mesh.vertices) {
    x *= grid.step[0];
    y *= grid.step[1];
    z *= grid.unit;
  }
}

void to_grid(Mesh& mesh, const Grid& grid) {
  for (auto& [x, y, z] : mesh.vertices) {
    x /= grid.step[0];
    y /= grid.step[1];
    z /= grid.unit;
  }
}

void write_ply(const std::string& path, const Grid& grid, const Mesh& mesh) {
  std::ofstream file(path, std::ios::binary);
  file << fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment crs {}\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      grid.crs, mesh.vertices.size(), mesh.triangles.size());
  auto vertices = mesh.vertices;
  for (auto& [x, y, z] : vertices) {
    const Point p = to_crs(grid, x, y);
    x = p[0];
    y = p[1];
  }
  file.write(reinterpret_cast<const char*>(vertices.data()),
             static_cast<std::streamsize>(vertices.size() * sizeof vertices[0]));
  const bool is_clockwise = plan_area(vertices, mesh.triangles) < 0;
  for (auto triangle : mesh.triangles) {
    if (is_clockwise) std::swap(triangle[1], triangle[2]);
    file.put(3);
    file.write(reinterpret_cast<const char*>(triangle.data()), sizeof triangle);
  }
  if (!file.flush()) throw std::runtime_error(path + ": can't be written; check the folder and its free space");
}

void print_result(double seconds, const Mesh& mesh) {
  fmt::print("{{\"own_seconds\":{:.6f},\"triangles\":{}}}\n", seconds, mesh.triangles.size());
}

}  // namespace bench
