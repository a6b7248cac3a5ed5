// What values draw at, and how they follow, by hand.

#include "simplify/surface_values.hpp"

#include <gtest/gtest.h>

#include "tinsmith/simplify.hpp"

namespace tinsmith {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

//     3 ------- 2     Vertex 4 in the middle; it alone is off the border.
//     | \     / |
//     |    4    |
//     | /     \ |
//     0 ------- 1
struct Square {
  SurfaceMesh mesh;
  WedgeValues values;
  FitSamples samples;

  // With a scalar, of the surface (as `found`) and of the samples, which lie at the vertices.
  Square(const std::array<double, 5>& found, const std::array<float, 5>& wanted) {
    Surface surface;
    surface.position = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
    surface.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    SurfaceDefects defects;
    mesh = surface_mesh_of(surface, defects);
    SimplifySurfaceReport report;
    mark_features(mesh, {}, report);
    values.blocks = {{AttributeKind::kScalar, 0, 0, 1}};
    values.n_components = 1;
    samples = fit_samples(mesh, {}, {});
    for (std::int32_t v = 0; v < 5; ++v) {
      values.values.push_back(found[mesh.original_vertex[at(v)]]);
      samples.values.push_back(wanted[mesh.original_vertex[at(v)]]);
      samples.has_values.push_back(mesh.kind[at(v)] == SurfaceVertexKind::kInterior ? 1 : 0);
    }
  }
  std::int32_t vertex(std::uint32_t original) const {
    std::int32_t v = 0;
    while (mesh.original_vertex[at(v)] != original) ++v;
    return v;
  }
  ValuedSurface valued() { return {mesh, values, samples}; }
  std::vector<std::int32_t> nowhere() const { return std::vector<std::int32_t>(samples.place.size(), kNone); }
};

TEST(FitValues, TheMiddleTakesWhatItsSampleWantsAndTheBorderStays) {
  Square square({1, 2, 3, 4, 5}, {0, 0, 0, 0, 9});
  fit_values(square.valued(), square.nowhere());
  EXPECT_DOUBLE_EQ(square.values.of(square.vertex(4))[0], 9);
  for (std::uint32_t v = 0; v < 4; ++v) EXPECT_DOUBLE_EQ(square.values.of(square.vertex(v))[0], v + 1.0);
}

// A sample half of the way to vertex 0 wants 1 where both ends of the edge have 0: the middle has to have 2.
TEST(FitValues, AreTheLeastSquaresOfSamplesBetweenVertices) {
  Square square({0, 0, 0, 0, 0}, {0, 0, 0, 0, 1});
  square.samples.place[at(square.vertex(4))] = scaled(square.mesh, {0.25, 0.25, 0});
  for (int i = 0; i < 10; ++i) fit_values(square.valued(), square.nowhere());
  EXPECT_NEAR(square.values.of(square.vertex(4))[0], 2, 1e-9);
}

// The value rises from 0 at the left to 1 at the right. Below the middle it is 0.5 and the sample there wants 0.75:
// vertices must step to the left by a quarter, each as far as its share goes.
TEST(PullByValues, DrawsVerticesAlongTheSlope) {
  Square square({0, 1, 1, 0, 0.5}, {0, 0, 0, 0, 0.75});
  const std::int32_t sample = square.vertex(4);
  const Nearest there =
      nearest({square.mesh, square.mesh.position}, scaled(square.mesh, {0.5, 0.25, 0}), kNone, sample);
  std::vector<Quadric<3>> pulls(5);
  constexpr double kWeight = 2;
  pull_by_values(square.valued(), at(sample), there, kWeight, pulls);
  using Q = Quadric<3>;
  for (const auto& [original, share] : {std::pair{0U, 0.25}, {1U, 0.25}, {4U, 0.5}, {2U, 0.0}, {3U, 0.0}}) {
    const Q& pull = pulls[at(square.vertex(original))];
    EXPECT_NEAR(pull.q[Q::a(0, 0)], kWeight * share, 1e-12);
    EXPECT_NEAR(pull.q[Q::b(0)], kWeight * share * 0.25, 1e-12);
    EXPECT_NEAR(pull.q[Q::c()], kWeight * share * 0.0625, 1e-12);
    EXPECT_NEAR(pull.q[Q::a(1, 1)], 0, 1e-12);
    EXPECT_NEAR(pull.at({-0.25, 0, 0}), 0, 1e-12);
  }
}

// The one sample with a value lies an eighth over the middle, where the value is 2 less than it wants.
TEST(ErrorsOf, AreDistancesAndDifferencesOfSamplesWithValues) {
  Square square({0, 0, 0, 0, 1}, {0, 0, 0, 0, 3});
  square.samples.place[at(square.vertex(4))] = scaled(square.mesh, {0.5, 0.5, 0.125});
  const SurfaceErrors errors = errors_of(square.valued());
  EXPECT_NEAR(errors.squared_distance, 1.0 / 64, 1e-12);
  EXPECT_NEAR(errors.squared_difference, 4, 1e-12);
}

// The middle differs by 0.01 from the mean of its neighbours; of three times fewer triangles a linear function is
// off by 0.015, half of what counts fully.
TEST(SeenWeight, FallsWithTheSquareOfWhatSmoothValuesWillBeOff) {
  Square smooth({1, 2, 3, 4, 2.51}, {});
  EXPECT_NEAR(seen_weight(1e-3, smooth.valued(), 3), 0.25e-3, 1e-12);
  EXPECT_NEAR(seen_weight(1e-3, smooth.valued(), 1.5), 0.0625e-3, 1e-12);
  EXPECT_DOUBLE_EQ(seen_weight(1e-3, smooth.valued(), 6.1), 1e-3);
}

TEST(SeenWeight, IsTheUsualOneWhereValuesAreRoughAndNoneWhereTheyAreLinear) {
  EXPECT_DOUBLE_EQ(seen_weight(1e-3, Square({0, 1, 0, 1, 1}, {}).valued(), 2), 1e-3);
  EXPECT_DOUBLE_EQ(seen_weight(1e-3, Square({0, 1, 1, 0, 0.5}, {}).valued(), 100), 0);
}

// As rough as the usual weight expects, with four times the triangles: places are off by 1/8 of what they will be.
TEST(BalancedWeight, IsTheUsualOneWhereTheShapeIsRough) {
  EXPECT_DOUBLE_EQ(balanced_weight(1e-3, {1e-3, 8}, 4), 1e-3);
  EXPECT_DOUBLE_EQ(balanced_weight(1e-3, {1, 8}, 4), 1e-3);
  EXPECT_DOUBLE_EQ(balanced_weight(1e-3, {1e-3, 0}, 4), 1e-3);  // nor where values are right
}

TEST(BalancedWeight, FallsWithTheShapesErrorButNotToNothing) {
  double last = 1e-3;
  for (const double squared_distance : {0.9e-3, 0.7e-3, 0.5e-3}) {
    const double weight = balanced_weight(1e-3, {squared_distance, 8}, 4);
    EXPECT_LT(weight, last);
    last = weight;
  }
  EXPECT_GT(balanced_weight(1e-3, {0, 8}, 4), 0);
}

}  // namespace
}  // namespace tinsmith
