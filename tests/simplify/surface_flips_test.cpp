// Edges flip where the other diagonal is nearer to the samples, and nowhere else.

#include "simplify/surface_flips.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tinsmith/simplify.hpp"

namespace tinsmith {
namespace {

// A square whose diagonal runs from vertex 0 to vertex 2; vertices 1 and 3 are raised by `ridge`.
//
//     3 --- 2
//     |   / |
//     | /   |
//     0 --- 1
SurfaceMesh square(double ridge) {
  Surface surface;
  surface.position = {{0, 0, 0}, {1, 0, ridge}, {1, 1, 0}, {0, 1, ridge}};
  surface.triangles = {{0, 1, 2}, {0, 2, 3}};
  SurfaceDefects defects;
  SurfaceMesh mesh = surface_mesh_of(surface, defects);
  SimplifySurfaceReport report;
  mark_features(mesh, {}, report);
  return mesh;
}

std::int32_t diagonal(const SurfaceMesh& mesh) {
  std::int32_t h = 0;
  while (mesh.is_border_edge(h)) ++h;
  return h;
}

// Samples at the given height over the middle of the square, nearest to its first triangle.
struct MiddleSample {
  std::vector<Vec<3>> place;
  std::vector<float> weight{1};
  std::vector<std::int32_t> triangle{0};
  std::vector<float> squared;

  MiddleSample(const SurfaceMesh& mesh, double height) : place{scaled(mesh, {0.5, 0.5, height})} {
    const Vec<3> off = place[0] - scaled(mesh, {0.5, 0.5, 0});
    squared = {static_cast<float>(dot(off, off))};
  }
  SurfaceSamples samples() const { return {place, weight, triangle, squared}; }
};

bool nothing_is_astray(const Vec<3>&, const Vec<3>&, std::int32_t) { return false; }

bool runs_along_the_ridge(const SurfaceMesh& mesh) {
  const auto h = static_cast<std::size_t>(diagonal(mesh));
  const auto original = [&](std::int32_t v) { return mesh.original_vertex[static_cast<std::size_t>(v)]; };
  return original(mesh.origin[h]) % 2 == 1 && original(mesh.destination(diagonal(mesh))) % 2 == 1;
}

TEST(FlipNearer, TakesTheDiagonalThatTheSamplesLieOn) {
  SurfaceMesh mesh = square(0.2);
  flip_nearer(mesh, MiddleSample(mesh, 0.2).samples(), nothing_is_astray);
  EXPECT_TRUE(runs_along_the_ridge(mesh));
  for (std::size_t h = 0; h < mesh.origin.size(); ++h) {  // what goes with halfedges has gone with them
    EXPECT_EQ(mesh.wedge[h], mesh.origin[h]);
    EXPECT_EQ(mesh.is_feature[h] != 0, mesh.is_border_edge(static_cast<std::int32_t>(h)));
  }
}

TEST(FlipNearer, KeepsADiagonalThatTheSamplesLieOn) {
  SurfaceMesh mesh = square(0.2);
  flip_nearer(mesh, MiddleSample(mesh, 0).samples(), nothing_is_astray);
  EXPECT_FALSE(runs_along_the_ridge(mesh));
}

// Flat: no diagonal is nearer. The values are wrong on triangles that have both vertex 0 and vertex 2, so that they
// ask for the other one, or the other way around.
TEST(FlipNearer, TakesTheDiagonalThatTheValuesAskFor) {
  for (const bool is_wrong_with_it : {true, false}) {
    SurfaceMesh mesh = square(0);
    const MiddleSample sample(mesh, 0);
    SurfaceSamples samples = sample.samples();
    samples.value_error = [&](std::size_t, const PlaceInTriangle& place) {
      const auto has = [&](std::uint32_t original) {
        return std::any_of(place.wedge.begin(), place.wedge.end(), [&](std::int32_t w) {
          return mesh.original_vertex[static_cast<std::size_t>(w)] == original;
        });
      };
      EXPECT_NEAR(place.share[0] + place.share[1] + place.share[2], 1, 1e-12);
      return (has(0) && has(2)) == is_wrong_with_it ? 1.0 : 0.0;
    };
    flip_nearer(mesh, samples, nothing_is_astray);
    EXPECT_EQ(runs_along_the_ridge(mesh), is_wrong_with_it);
  }
}

TEST(FlipNearer, KeepsFeatures) {
  SurfaceMesh mesh = square(0.2);
  const std::int32_t h = diagonal(mesh);
  mesh.is_feature[static_cast<std::size_t>(h)] = 1;
  mesh.is_feature[static_cast<std::size_t>(mesh.twin[static_cast<std::size_t>(h)])] = 1;
  flip_nearer(mesh, MiddleSample(mesh, 0.2).samples(), nothing_is_astray);
  EXPECT_FALSE(runs_along_the_ridge(mesh));
}

TEST(FlipNearer, KeepsSeams) {
  SurfaceMesh mesh = square(0.2);
  mesh.wedge[static_cast<std::size_t>(diagonal(mesh))] = 4;
  flip_nearer(mesh, MiddleSample(mesh, 0.2).samples(), nothing_is_astray);
  EXPECT_FALSE(runs_along_the_ridge(mesh));
}

TEST(FlipNearer, DoesNotLeaveTheInput) {
  SurfaceMesh mesh = square(0.2);
  flip_nearer(mesh, MiddleSample(mesh, 0.2).samples(),
              [](const Vec<3>&, const Vec<3>&, std::int32_t) { return true; });
  EXPECT_FALSE(runs_along_the_ridge(mesh));
}

// The other diagonal passes vertex 2 outside; seen from above it would leave the sample nearer all the same.
TEST(FlipNearer, FoldsNothing) {
  SurfaceMesh mesh = square(0.2);
  for (std::size_t v = 0; v < mesh.position.size(); ++v) {
    if (mesh.original_vertex[v] == 1) mesh.position[v] = scaled(mesh, {1.2, 0.9, 0.2});
    if (mesh.original_vertex[v] == 3) mesh.position[v] = scaled(mesh, {1, 1.3, 0.2});
  }
  flip_nearer(mesh, MiddleSample(mesh, 0.09).samples(), nothing_is_astray);
  EXPECT_FALSE(runs_along_the_ridge(mesh));
}

}  // namespace
}  // namespace tinsmith
