// meshopt_surface IN.ply TRIANGLES OUT.ply: meshopt_simplify of a surface down to a count of triangles.

#include <meshoptimizer.h>

#include <cstdio>
#include <exception>
#include <string>

#include "plain_ply.hpp"

namespace {

/// An error that never stops it (1 is the extent of the mesh): the count alone does.
constexpr float kAnyError = 1;

void run(const std::string& input, std::size_t n_triangles, const std::string& output) {
  bench::Mesh mesh = bench::read_plain_ply(input);
  std::vector<float> positions;
  positions.reserve(mesh.vertices.size() * 3);
  for (const auto& vertex : mesh.vertices)
    for (const double c : vertex) positions.push_back(static_cast<float>(c));
  std::vector<std::array<std::uint32_t, 3>> simplified(mesh.triangles.size());
  const bench::Stopwatch watch;
  const std::size_t n_indices =
      meshopt_simplify(simplified[0].data(), mesh.triangles[0].data(), mesh.triangles.size() * 3, positions.data(),
                       mesh.vertices.size(), 3 * sizeof(float), n_triangles * 3, kAnyError, 0, nullptr);
  const double seconds = watch.seconds();
  simplified.resize(n_indices / 3);
  mesh.triangles = std::move(simplified);
  bench::compact(mesh);
  bench::write_plain_ply(output, mesh);
  bench::print_result(seconds, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: meshopt_surface IN.ply TRIANGLES OUT.ply\n");
    return 2;
  }
  try {
    run(argv[1], std::stoul(argv[2]), argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "meshopt_surface: %s\n", error.what());
    return 1;
  }
}
