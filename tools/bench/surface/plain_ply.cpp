#include "plain_ply.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <stdexcept>

namespace bench {
namespace {

constexpr std::size_t kTriangleBytes = 1 + 3 * sizeof(std::uint32_t);

struct Counts {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
};

Counts read_header(std::ifstream& file, const std::string& path) {
  Counts counts;
  std::string line;
  while (std::getline(file, line) && line != "end_header") {
    if (line.starts_with("element vertex ")) counts.vertices = std::stoul(line.substr(15));
    if (line.starts_with("element face ")) counts.triangles = std::stoul(line.substr(13));
  }
  if (!file || counts.triangles == 0) throw std::runtime_error(path + ": is no mesh of plain_ply.py");
  return counts;
}

}  // namespace

Mesh read_plain_ply(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const Counts counts = read_header(file, path);
  Mesh mesh;
  mesh.vertices.resize(counts.vertices);
  mesh.triangles.resize(counts.triangles);
  std::string faces(counts.triangles * kTriangleBytes, '\0');
  file.read(reinterpret_cast<char*>(mesh.vertices.data()),
            static_cast<std::streamsize>(counts.vertices * sizeof mesh.vertices[0]));
  file.read(faces.data(), static_cast<std::streamsize>(faces.size()));
  if (!file) throw std::runtime_error(path + ": is cut short");
  for (std::size_t t = 0; t < counts.triangles; ++t)
    std::memcpy(mesh.triangles[t].data(), &faces[t * kTriangleBytes + 1], sizeof mesh.triangles[t]);
  return mesh;
}

void write_plain_ply(const std::string& path, const Mesh& mesh) {
  std::ofstream file(path, std::ios::binary);
  file << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\n"
      "property double z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  file.write(reinterpret_cast<const char*>(mesh.vertices.data()),
             static_cast<std::streamsize>(mesh.vertices.size() * sizeof mesh.vertices[0]));
  for (const auto& triangle : mesh.triangles) {
    file.put(3);
    file.write(reinterpret_cast<const char*>(triangle.data()), sizeof triangle);
  }
  if (!file.flush()) throw std::runtime_error(path + ": can't be written");
}

}  // namespace bench
