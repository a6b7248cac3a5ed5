#include "judge/measure.hpp"

#include <gtest/gtest.h>

#include "judge/scene.hpp"
#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

TEST(Judge, FindsNothingWrongWithAPlane) {
  for (const Scene& scene : {full_plane(9, 7), plane_of_two(9, 7)}) {
    const Certificate c = scene.judged();
    EXPECT_EQ(c.samples, 63U);
    EXPECT_EQ(c.covered, 63U);
    EXPECT_EQ(c.uncovered, 0U);
    EXPECT_EQ(c.overlapped, 0U);
    EXPECT_EQ(c.vertices, scene.vertices.size());
    EXPECT_EQ(c.triangles, scene.triangles.size());
    EXPECT_LE(c.max_error, c.rounding);
    EXPECT_EQ(c.components, 1U);
    EXPECT_EQ(c.area_plan, 48);
    EXPECT_EQ(c.area_valid, 48);
    EXPECT_EQ(c.cells_valid, 48);
    EXPECT_TRUE(c.broken_promises(0).empty());
  }
}

TEST(Judge, NamesTheSizeAndPlaceOfAnError) {
  Scene scene = plane_of_two(5, 5);
  scene.at(2, 1) += 3.5;
  scene.at(3, 4) -= 1;
  scene.frame.metres_per_vertical_unit = 0.5;
  const Certificate c = scene.judged();
  EXPECT_DOUBLE_EQ(c.max_error, 1.75);
  EXPECT_EQ(c.max_error_column, 2);
  EXPECT_EQ(c.max_error_row, 1);
  EXPECT_DOUBLE_EQ(c.mean_error, 0.5 * (-3.5 + 1) / 25);
  EXPECT_DOUBLE_EQ(c.rmse, 0.5 * std::sqrt((3.5 * 3.5 + 1) / 25));
  EXPECT_DOUBLE_EQ(c.p99_error, 1.75) << "99 % of 25 is all of them";
  EXPECT_TRUE(c.broken_promises(1.75).empty());
  EXPECT_TRUE(c.broken_promises(-1).empty()) << "no tolerance asked for";
  const auto broken = c.broken_promises(1.7);
  ASSERT_EQ(broken.size(), 1U);
  EXPECT_NE(broken[0].find("column 2, row 1"), std::string::npos) << broken[0];
}

TEST(Judge, KnowsThePercentileToTheWidthOfItsBins) {
  Scene scene = plane_of_two(100, 100);
  for (std::size_t i = 0; i < 10000; ++i) scene.z[i] += 0.001 * static_cast<double>(i);
  const Certificate c = scene.judged();
  EXPECT_GE(c.p99_error, 9.899 - 1e-9);
  EXPECT_LE(c.p99_error, 9.899 * 1.016);
}

TEST(Judge, SeesAMissingTriangleByItsArea) {
  Scene scene = full_plane(5, 5);
  scene.triangles.erase(scene.triangles.begin() + 11);
  const Certificate c = scene.judged();
  EXPECT_EQ(c.uncovered, 0U) << "all its corners belong to others";
  EXPECT_EQ(c.cells_plan, 15.5);
  EXPECT_EQ(c.cells_valid, 16);
  EXPECT_EQ(c.broken_promises(0).size(), 1U);
}

TEST(Judge, CountsSamplesInAHole) {
  Scene scene = full_plane(7, 6);
  const std::uint32_t centre = 2 * 7 + 3;
  std::erase_if(scene.triangles, [&](const auto& t) { return t[0] == centre || t[1] == centre || t[2] == centre; });
  const Certificate c = scene.judged();
  EXPECT_EQ(c.uncovered, 1U);
  EXPECT_EQ(c.covered, 41U);
  EXPECT_EQ(c.cells_plan, 27);
  EXPECT_EQ(c.broken_promises(0).size(), 2U) << "a sample and the area";
}

TEST(Judge, SeesADoubledTriangle) {
  Scene scene = plane_of_two(9, 9);
  scene.triangles.push_back(scene.triangles[0]);
  const Certificate c = scene.judged();
  EXPECT_EQ(c.non_manifold_edges, 3U);
  EXPECT_EQ(c.overlapped, 21U) << "1 + 2 + ... + 6 samples strictly inside it";
  EXPECT_EQ(c.cells_plan, 96);
  EXPECT_EQ(c.broken_promises(0).size(), 3U);
}

TEST(Judge, SeesAFoldedTriangle) {
  Scene scene = full_plane(4, 4);
  std::swap(scene.triangles[8][0], scene.triangles[8][1]);
  const Certificate turned = scene.judged();
  EXPECT_EQ(turned.folded, 1U);
  EXPECT_EQ(turned.non_manifold_edges, 3U) << "used twice in one direction by it and its neighbours";
  Scene flat = plane_of_two(4, 4);
  flat.vertices.push_back({1, 0, 102});
  flat.triangles.push_back({0, 1, 4});
  EXPECT_EQ(flat.judged().folded, 1U) << "no area is not positive";
}

TEST(Judge, SeesTheWrongSideUpInAMirroredGrid) {
  Scene scene = full_plane(4, 4);
  scene.frame.geotransform = {1000, 10, 0, 2000, 0, -10};
  EXPECT_EQ(scene.judged().folded, 0U);
  for (auto& t : scene.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(scene.judged().folded, 18U);
}

// 0-----------1     The upper triangle uses the whole edge 3-2, the lower ones its halves.
// |         / |
// |      /    |
// 3-----4-----2
// |    / \    |
// 6-----------5
TEST(Judge, SeesATJunction) {
  Scene scene = full_plane(5, 5);
  const auto vertex = [&](double x, double y) { scene.vertices.push_back({x, y, 100 + 2 * x - 3 * y}); };
  scene.vertices.clear();
  vertex(0, 0), vertex(4, 0), vertex(4, 2), vertex(0, 2), vertex(2, 2), vertex(4, 4), vertex(0, 4);
  scene.triangles = {{0, 1, 3}, {1, 2, 3}, {3, 4, 6}, {4, 5, 6}, {4, 2, 5}};
  const Certificate c = scene.judged();
  EXPECT_EQ(c.t_junctions, 1U);
  EXPECT_EQ(c.components, 2U);
  EXPECT_EQ(c.unwelded_edges, 0U);
  EXPECT_LE(c.max_error, c.rounding);
  const auto broken = c.broken_promises(0);
  EXPECT_EQ(broken.size(), 2U) << "the T-junction, and the two vertices of two fans";
  EXPECT_EQ(c.non_manifold_vertices, 2U);
}

TEST(Judge, SeesASeamThatIsNotWelded) {
  Scene scene = full_plane(3, 2);
  scene.vertices.push_back(scene.vertices[1]);
  scene.vertices.push_back(scene.vertices[4]);
  for (std::size_t t : {2, 3})
    for (auto& corner : scene.triangles[t]) corner = corner == 1 ? 6 : corner == 4 ? 7 : corner;
  const Certificate c = scene.judged();
  EXPECT_EQ(c.unwelded_edges, 1U);
  EXPECT_EQ(c.components, 2U);
  EXPECT_EQ(c.t_junctions, 0U);
  EXPECT_EQ(c.broken_promises(0).size(), 1U);
}

// Two valid cells that share a corner only. One vertex with two fans is no manifold; one for each fan is.
TEST(Judge, TellsAPinchFromTwoVerticesInOnePlace) {
  Scene scene = full_plane(3, 3);
  scene.at(2, 0) = scene.at(0, 2) = kVoid;
  mesh_fully(scene);
  const Certificate pinched = scene.judged();
  EXPECT_EQ(pinched.non_manifold_vertices, 1U);
  EXPECT_EQ(pinched.components, 2U);
  EXPECT_EQ(pinched.broken_promises(0).size(), 1U);
  scene.vertices.push_back(scene.vertices[4]);
  for (std::size_t t : {2, 3})
    for (auto& corner : scene.triangles[t]) corner = corner == 4 ? 9 : corner;
  const Certificate apart = scene.judged();
  EXPECT_EQ(apart.non_manifold_vertices, 0U);
  EXPECT_TRUE(apart.broken_promises(0).empty());
}

TEST(Judge, AsksForNothingWhereNoCellIsValid) {
  Scene scene = full_plane(6, 5);
  scene.at(1, 1) = kVoid;                   // opens the four cells about it
  scene.at(4, 3) = scene.at(4, 4) = kVoid;  // leaves (5, 4) without a valid cell
  mesh_fully(scene);
  const Certificate c = scene.judged();
  EXPECT_EQ(c.samples, 27U);
  EXPECT_EQ(c.covered, 22U) << "three about (0, 0) and two about (5, 4) are beside no valid cell";
  EXPECT_EQ(c.uncovered, 0U);
  EXPECT_EQ(c.cells_valid, 12);
  EXPECT_TRUE(c.broken_promises(0).empty());
}

TEST(Judge, SeesATriangleOverAVoid) {
  Scene scene = plane_of_two(6, 6);
  scene.at(3, 1) = kVoid;
  const Certificate c = scene.judged();
  EXPECT_EQ(c.voids_covered, 1U);
  EXPECT_EQ(c.samples, 35U);
  EXPECT_EQ(c.cells_plan - c.cells_valid, 4);
  EXPECT_EQ(c.broken_promises(0).size(), 2U);
}

TEST(Judge, GivesSensibleNumbersForAMeshElsewhere) {
  Scene scene = full_plane(8, 8);
  for (auto& v : scene.vertices) v[0] += 1e6;
  const Certificate c = scene.judged();
  EXPECT_EQ(c.uncovered, 64U);
  EXPECT_EQ(c.covered, 0U);
  EXPECT_EQ(c.max_error, 0);
  EXPECT_EQ(c.rmse, 0);
  EXPECT_EQ(c.area_plan, 49);
  EXPECT_EQ(c.broken_promises(0).size(), 1U);
  for (auto& v : scene.vertices) v[1] = -1e200;
  EXPECT_THROW(scene.judged(), InputError);
}

TEST(Judge, GivesSensibleNumbersForNoMesh) {
  Scene scene = full_plane(8, 8);
  scene.triangles.clear();
  const Certificate c = scene.judged();
  EXPECT_EQ(c.uncovered, 64U);
  EXPECT_EQ(c.components, 0U);
  EXPECT_FALSE(c.broken_promises(1e9).empty());
}

TEST(Judge, MeasuresAreasInSquareMetres) {
  Scene metres = full_plane(5, 4);
  metres.frame.geotransform = {1000, 10, 0, 2000, 0, -20};
  EXPECT_DOUBLE_EQ(metres.judged().area_plan, 12 * 200);
  EXPECT_DOUBLE_EQ(metres.judged().area_valid, 12 * 200);
  Scene degrees = full_plane(401, 201);
  degrees.frame.geotransform = {7, 0.0025, 0, 46.5, 0, -0.0025};
  degrees.frame.is_geographic = true;
  degrees.frame.radians_per_unit = M_PI / 180;
  // 1 x 0.5 degrees: the authalic formula of the WGS 84 ellipsoid between 45.99875 N and 46.49875 N.
  const Certificate c = degrees.judged();
  EXPECT_NEAR(c.area_valid, 4285914623.42, 5);
  EXPECT_NEAR(c.area_plan / c.area_valid, 1, 1e-9);
}

TEST(Judge, StopsOnRequest) {
  const Scene scene = full_plane(50, 50);
  const ArrayField field(scene.z.data(), 50, 50);
  double last = -1;
  const Progress watch = [&](double fraction, std::string_view) {
    EXPECT_GE(fraction, last);
    last = fraction;
    return fraction < 0.5;
  };
  EXPECT_THROW(measure(scene.tin(), {field, scene.frame, {512, 5}, watch}), Interrupted);
  EXPECT_GE(last, 0.5);
  EXPECT_LT(last, 0.7);
}

}  // namespace
}  // namespace tinsmith
