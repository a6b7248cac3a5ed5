// meshopt_peer GRID TRIANGLES OUT.ply: meshopt_simplify of the full grid down to a count of triangles.

#include <meshoptimizer.h>

#include <cstdio>
#include <exception>
#include <string>

#include "grid.hpp"

namespace {

/// (x, y, z) of each vertex in metres; the mesh of the grid is taken back to the grid by vertex number, so that
/// single precision touches the simplifier's costs only.
std::vector<float> positions_of(bench::Mesh mesh, const bench::Grid& grid) {
  bench::to_metres(mesh, grid);
  std::vector<float> positions;
  positions.reserve(mesh.vertices.size() * 3);
  for (const auto& vertex : mesh.vertices)
    for (const double c : vertex) positions.push_back(static_cast<float>(c));
  return positions;
}

/// An error that never stops it (1 is the extent of the mesh): the count alone does.
constexpr float kAnyError = 1;

void run(const std::string& path, std::size_t n_triangles, const std::string& output) {
  const bench::Grid grid = bench::read_grid(path);
  bench::Mesh mesh = bench::full_mesh(grid);
  const std::vector<float> positions = positions_of(mesh, grid);
  std::vector<std::array<std::uint32_t, 3>> simplified(mesh.triangles.size());
  const bench::Stopwatch watch;
  const std::size_t n_indices =
      meshopt_simplify(simplified[0].data(), mesh.triangles[0].data(), mesh.triangles.size() * 3, positions.data(),
                       mesh.vertices.size(), 3 * sizeof(float), n_triangles * 3, kAnyError, 0, nullptr);
  const double seconds = watch.seconds();
  simplified.resize(n_indices / 3);
  mesh.triangles = std::move(simplified);
  bench::compact(mesh);
  bench::write_ply(output, grid, mesh);
  bench::print_result(seconds, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: meshopt_peer GRID TRIANGLES OUT.ply\n");
    return 2;
  }
  try {
    run(argv[1], std::stoul(argv[2]), argv[3]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "meshopt_peer: %s\n", error.what());
    return 1;
  }
}
