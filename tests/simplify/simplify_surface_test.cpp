// Simplification of surfaces in space: what it keeps, on closed, open, creased, noisy and coloured ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "support/surface_measures.hpp"
#include "support/surface_shapes.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/simplify.hpp"

namespace tinsmith {
namespace {

using namespace test;

struct Simplified {
  Surface surface;
  SimplifySurfaceReport report;
};

Simplified simplified(const Surface& surface, SimplifySurfaceOptions options, double ratio) {
  Simplified result;
  options.ratio = ratio;
  result.surface = simplify_surface(surface, options, result.report);
  return result;
}

struct Shape {
  const char* name;
  Surface surface;
};
std::vector<Shape> shapes() {
  return {{"sphere", sphere(24)},
          {"torus", torus(60, 30)},
          {"cube", cube_with_creases(16)},
          {"sheet", open_sheet(40)},
          {"scan", scan(24)}};
}

TEST(SimplifySurface, ReachesTheRatioAndKeepsTopologyAndSides) {
  for (const auto& [name, surface] : shapes()) {
    for (const Placement placement : {Placement::kOptimal, Placement::kSegment, Placement::kSubset}) {
      for (const double ratio : {0.5, 0.2, 0.05}) {
        SCOPED_TRACE(testing::Message() << name << ", placement " << static_cast<int>(placement) << ", " << ratio);
        SimplifySurfaceOptions options;
        options.placement = placement;
        const Surface result = simplified(surface, options, ratio).surface;
        EXPECT_LE(static_cast<double>(result.triangles.size()),
                  ratio * static_cast<double>(surface.triangles.size()));
        EXPECT_GE(static_cast<double>(result.triangles.size()),
                  ratio * static_cast<double>(surface.triangles.size()) - 2);
        EXPECT_TRUE(is_manifold(result));
        EXPECT_EQ(count_borders(result), count_borders(surface));
        EXPECT_EQ(genus(result), genus(surface));
        EXPECT_LT(distance(result, surface, 4'000).max(), 0.06);
      }
    }
  }
}

TEST(SimplifySurface, GivesTheSameForTheSameInput) {
  const Surface surface = with_checker_colour(scan(16), 4);
  const Surface first = simplified(surface, {}, 0.1).surface;
  const Surface second = simplified(surface, {}, 0.1).surface;
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.triangles, second.triangles);
  EXPECT_EQ(first.attributes[0].values, second.attributes[0].values);
}

// The cube's planes are exact: what is left has no error, and with creases marked its twelve edges stay.
TEST(SimplifySurface, KeepsACubeExactly) {
  const Surface cube = cube_with_creases(12);
  SimplifySurfaceOptions options;
  options.crease = 45;
  const Simplified result = simplified(cube, options, 0.01);
  EXPECT_EQ(result.report.feature_edges, 12U * 12);
  EXPECT_LT(distance(result.surface, cube, 4'000).max(), 1e-12);
  std::set<Point3> corners;
  for (const Point3& p : result.surface.position) {
    if (std::all_of(p.begin(), p.end(), [](double x) { return std::abs(std::abs(x) - 1) < 1e-12; }))
      corners.insert(p);
  }
  EXPECT_EQ(corners.size(), 8U);
}

TEST(SimplifySurface, EndsWhenNothingCanBeCollapsed) {
  SimplifySurfaceReport report;
  const Surface result = simplify_surface(sphere(6), {}, report);
  EXPECT_GE(result.triangles.size(), 4U);
  EXPECT_LE(result.triangles.size(), 24U);
  EXPECT_TRUE(is_closed_manifold(result));
}

TEST(SimplifySurface, HoldsTheLargestCost) {
  const Surface surface = scan(24);
  SimplifySurfaceOptions options;
  options.max_cost = 1e-5;
  SimplifySurfaceReport report;
  const Surface result = simplify_surface(surface, options, report);
  EXPECT_LT(result.triangles.size(), surface.triangles.size() * 9 / 10);
  EXPECT_LE(report.last_cost, 1e-5);
  options.max_cost = 1e-4;
  EXPECT_LT(simplify_surface(surface, options, report).triangles.size(), result.triangles.size());
}

TEST(SimplifySurface, HalfSpaceTestPreventsTurnedTrianglesAndSelfIntersections) {
  std::size_t n_turned_with = 0;
  std::size_t n_turned_without = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Surface surface = scan(40, seed);
    SimplifySurfaceOptions options;
    const Surface with = simplified(surface, options, 0.3).surface;
    options.half_space = false;
    const Surface without = simplified(surface, options, 0.3).surface;
    n_turned_with += normal_turn(with, surface).n_flipped;
    n_turned_without += normal_turn(without, surface).n_flipped;
    EXPECT_EQ(count_self_intersections(with), 0U) << seed;
    EXPECT_GT(count_self_intersections(without), 0U) << seed;
  }
  EXPECT_EQ(n_turned_with, 0U);
  EXPECT_GT(n_turned_without, 3U);
}

TEST(SimplifySurface, SubsetPlacementKeepsVerticesWithTheirAttributes) {
  const Surface surface = with_gradient_colour(scan(20));
  SimplifySurfaceOptions options;
  options.placement = Placement::kSubset;
  const Surface result = simplified(surface, options, 0.1).surface;
  using Vertex = std::pair<Point3, std::array<float, 3>>;
  const auto vertices = [](const Surface& s) {
    std::vector<Vertex> all;
    const std::vector<float>& colour = s.find(AttributeKind::kColour)->values;
    for (std::size_t v = 0; v < s.position.size(); ++v)
      all.push_back({s.position[v], {colour[3 * v], colour[3 * v + 1], colour[3 * v + 2]}});
    return all;
  };
  std::vector<Vertex> given = vertices(surface);
  for (const auto& [position, colour] : vertices(result)) {
    const bool is_given = std::any_of(
        given.begin(), given.end(),
        [&, p = position, c = colour](const Vertex& other) { return other.first == p && other.second == c; });
    EXPECT_TRUE(is_given);
  }
}

TEST(SimplifySurface, KeepsColoursInRangeAndNormalsAtUnitLength) {
  const Surface surface = with_normals(with_checker_colour(scan(24), 5));
  const Surface result = simplified(surface, {}, 0.1).surface;
  ASSERT_NE(result.find(AttributeKind::kColour), nullptr);
  ASSERT_NE(result.find(AttributeKind::kNormal), nullptr);
  for (const float x : result.find(AttributeKind::kColour)->values) EXPECT_TRUE(x >= 0 && x <= 1);
  const std::vector<float>& normals = result.find(AttributeKind::kNormal)->values;
  for (std::size_t v = 0; v < result.position.size(); ++v)
    EXPECT_NEAR(std::hypot(normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]), 1, 1e-5);
}

// One colour everywhere costs nothing and stays.
TEST(SimplifySurface, IsNotDisturbedByAConstantColour) {
  Surface surface = scan(20);
  const Surface plain = simplified(surface, {}, 0.2).surface;
  surface.attributes.push_back(
      {AttributeKind::kColour, "", std::vector<float>(3 * surface.position.size(), 0.25F)});
  const Surface coloured = simplified(surface, {}, 0.2).surface;
  EXPECT_EQ(plain.position, coloured.position);
  EXPECT_EQ(plain.triangles, coloured.triangles);
  for (const float x : coloured.attributes[0].values) EXPECT_FLOAT_EQ(x, 0.25F);
}

// Root mean squared difference of the first attribute, from points of the reference to the nearest of the surface.
double value_error(const Surface& s, const Surface& reference) {
  const auto value_at = [](const Surface& surface, const TriangleTree::Nearest& there) {
    const auto& [a, b, c] = surface.triangles[there.triangle];
    const Point3 n = doubled_area_normal(surface, surface.triangles[there.triangle]);
    const auto share = [&](std::uint32_t v, std::uint32_t w) {
      return dot(cross(minus(surface.position[v], there.point), minus(surface.position[w], there.point)), n) /
             dot(n, n);
    };
    const std::array<double, 3> weight{share(b, c), share(c, a), share(a, b)};
    const std::vector<float>& values = surface.attributes[0].values;
    const auto n_components = static_cast<std::size_t>(surface.attributes[0].components());
    Point3 value{};
    for (std::size_t k = 0; k < n_components; ++k)
      value[k] = weight[0] * values[n_components * a + k] + weight[1] * values[n_components * b + k] +
                 weight[2] * values[n_components * c + k];
    return value;
  };
  const TriangleTree tree(s);
  const TriangleTree reference_tree(reference);
  double sum = 0;
  const std::vector<Point3> points = sample_points(reference, 10'000);
  for (const Point3& p : points) {
    const Point3 off = minus(value_at(s, tree.nearest(p)), value_at(reference, reference_tree.nearest(p)));
    sum += dot(off, off);
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

// With the default form and weight the colour gains much and the geometry loses little.
TEST(SimplifySurface, KeepsColoursBetterThanGeometryAlone) {
  struct Case {
    Surface surface;
    double ratio;
    double colour;  // at most so much of the error that geometry alone gives
  };
  for (const auto& [surface, ratio, colour] :
       {Case{with_checker_colour(scan(40), 5), 0.3, 0.8}, Case{with_checker_colour(scan(60), 8), 0.03, 0.76},
        Case{with_gradient_colour(scan(40)), 0.1, 0.9},
        // Smooth shapes are off by little, and values may take little of it.
        Case{with_checker_colour(sphere(80), 8), 0.01, 0.85},
        Case{with_checker_colour(torus(150, 75), 6), 0.03, 0.85}, Case{with_gradient_colour(sphere(60)), 0.03, 0.5},
        Case{with_gradient_colour(sphere(80)), 0.01, 0.5}}) {
    SimplifySurfaceOptions options;
    const Surface with_colour = simplified(surface, options, ratio).surface;
    options.attribute_weight = 0;  // the values follow the place, nothing more
    options.quadric = QuadricForm::kSeparate;
    const Surface geometry_only = simplified(surface, options, ratio).surface;
    EXPECT_LE(value_error(with_colour, surface), colour * value_error(geometry_only, surface));
    const SurfaceDistance off = distance(with_colour, surface, 10'000);
    const SurfaceDistance alone = distance(geometry_only, surface, 10'000);
    EXPECT_LE(off.rms(), 1.1 * alone.rms());
    EXPECT_LE(off.max(), 1.1 * alone.max());
  }
}

// The quadric alone, without the fit: of a step in a scalar, beside a colour that says nothing.
TEST(SimplifySurface, SeparateQuadricsWeighScalars) {
  Surface surface = scan(40);
  SurfaceAttribute step{AttributeKind::kScalar, "step", {}};
  for (const Point3& p : surface.position) step.values.push_back(p[0] + 0.3 * p[1] > 0.2 ? 9 : 1);
  surface.attributes.push_back(step);
  surface.attributes.push_back({AttributeKind::kColour, "", std::vector<float>(3 * surface.position.size(), 0.5F)});
  for (const double ratio : {0.3, 0.1}) {
    SimplifySurfaceOptions options;
    options.quadric = QuadricForm::kSeparate;
    options.fit = false;
    const Surface with_weight = simplified(surface, options, ratio).surface;
    options.attribute_weight = 0;
    const Surface without = simplified(surface, options, ratio).surface;
    EXPECT_LE(value_error(with_weight, surface), 0.85 * value_error(without, surface));
    EXPECT_LE(distance(with_weight, surface, 10'000).rms(), 1.05 * distance(without, surface, 10'000).rms());
  }
}

TEST(SimplifySurface, EveryFormKeepsTheSurface) {
  const Surface surface = with_normals(with_checker_colour(scan(24), 5));
  for (const QuadricForm form : {QuadricForm::kSeparate, QuadricForm::kCombined, QuadricForm::kGradient}) {
    for (const Placement placement : {Placement::kOptimal, Placement::kSegment, Placement::kSubset}) {
      SimplifySurfaceOptions options;
      options.quadric = form;
      options.placement = placement;
      const Surface result = simplified(surface, options, 0.1).surface;
      EXPECT_LE(result.triangles.size(), surface.triangles.size() / 10);
      EXPECT_TRUE(is_closed_manifold(result));
      EXPECT_LT(distance(result, surface, 4'000).max(), 0.06);
    }
  }
}

TEST(SimplifySurface, CarriesScalarsOfAnyRange) {
  Surface surface = scan(24);
  SurfaceAttribute height{AttributeKind::kScalar, "height", {}};
  for (const Point3& p : surface.position) height.values.push_back(static_cast<float>(5000 + 3000 * p[2]));
  surface.attributes.push_back(height);
  const Surface result = simplified(surface, {}, 0.1).surface;
  ASSERT_EQ(result.attributes.size(), 1U);
  EXPECT_EQ(result.attributes[0].name, "height");
  for (std::size_t v = 0; v < result.position.size(); ++v)
    EXPECT_NEAR(result.attributes[0].values[v], 5000 + 3000 * result.position[v][2], 150);
}

TEST(SimplifySurface, RefusesOptionsOutOfRange) {
  SimplifySurfaceReport report;
  for (const double ratio : {0.0, -1.0, 1.5, std::nan("")}) {
    SimplifySurfaceOptions options;
    options.ratio = ratio;
    EXPECT_THROW(simplify_surface(sphere(4), options, report), UsageError);
  }
}

// Every face of the cube has its own vertices and normals, as in most files: the seams are lines, and nothing
// cracks.
Surface cube_with_face_normals(int n) {
  const Surface cube = cube_with_creases(n);
  Surface result;
  SurfaceAttribute normals{AttributeKind::kNormal, "", {}};
  std::map<std::pair<std::uint32_t, Point3>, std::uint32_t> number_of;
  for (const auto& t : cube.triangles) {
    const Point3 n2 = doubled_area_normal(cube, t);
    Point3 normal = times(n2, 1 / norm(n2));
    for (double& x : normal) x = std::round(x);
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [it, is_new] =
          number_of.try_emplace({t[k], normal}, static_cast<std::uint32_t>(result.position.size()));
      if (is_new) {
        result.position.push_back(cube.position[t[k]]);
        for (const double x : normal) normals.values.push_back(static_cast<float>(x));
      }
      triangle[k] = it->second;
    }
    result.triangles.push_back(triangle);
  }
  result.attributes.push_back(std::move(normals));
  return result;
}

TEST(SimplifySurface, SimplifiesSeamsOfAttributesInStepWithoutCracks) {
  const Surface cube = cube_with_face_normals(12);
  const Simplified result = simplified(cube, {}, 0.02);
  EXPECT_EQ(result.report.border_edges, 0U);
  EXPECT_EQ(result.report.feature_edges, 12U * 12);
  EXPECT_LE(result.surface.triangles.size(), cube.triangles.size() / 50);
  EXPECT_TRUE(is_closed_manifold(welded(result.surface)));
  EXPECT_LT(distance(result.surface, cube, 4'000).max(), 1e-12);
  // Every triangle still has its face's normal at all corners.
  const std::vector<float>& normals = result.surface.find(AttributeKind::kNormal)->values;
  for (const auto& t : result.surface.triangles) {
    const Point3 n = doubled_area_normal(result.surface, t);
    for (const std::uint32_t v : t) {
      const Point3 m{normals[3 * v], normals[3 * v + 1], normals[3 * v + 2]};
      EXPECT_GT(dot(n, m), 0.999 * norm(n));
    }
  }
}

TEST(SimplifySurface, CollapsesBordersAlongThemselves) {
  const Surface sheet = open_sheet(30);
  const Simplified result = simplified(sheet, {}, 0.05);
  EXPECT_EQ(count_borders(result.surface), 1U);
  EXPECT_LT(result.surface.position.size(), sheet.position.size() / 10);
  EXPECT_EQ(result.report.border_edges, 4U * 30);
}

TEST(SimplifySurface, KeepsEdgesGivenByTheCaller) {
  Surface sheet = open_sheet(20);
  for (Point3& p : sheet.position) p[2] = 0;
  // The row through the middle, which a plane would lose.
  SimplifySurfaceOptions options;
  std::vector<std::uint32_t> row;
  for (std::uint32_t v = 0; v < sheet.position.size(); ++v) {
    if (std::abs(sheet.position[v][1] - sheet.position[sheet.position.size() / 2][1]) < 1e-9) row.push_back(v);
  }
  std::sort(row.begin(), row.end(),
            [&](std::uint32_t a, std::uint32_t b) { return sheet.position[a] < sheet.position[b]; });
  for (std::size_t i = 1; i < row.size(); ++i) options.feature_edges.push_back({row[i - 1], row[i]});
  ASSERT_GT(row.size(), 10U);
  const Simplified result = simplified(sheet, options, 0.02);
  EXPECT_GE(result.report.feature_edges, row.size() - 1);
  const double y = sheet.position[row[0]][1];
  std::size_t n_on_row = 0;
  for (const Point3& p : result.surface.position) n_on_row += std::abs(p[1] - y) < 1e-9 ? 1 : 0;
  EXPECT_GE(n_on_row, 2U);
}

TEST(SimplifySurface, CountsThePartsOfTheInput) {
  Surface two = sphere(4);
  const auto n = static_cast<std::uint32_t>(two.position.size());
  two.position.push_back({9, 9, 9});  // belongs to no triangle
  for (const Point3& p : sphere(4).position) two.position.push_back({p[0] + 5, p[1], p[2]});
  for (const auto& [a, b, c] : sphere(4).triangles) two.triangles.push_back({a + n + 1, b + n + 1, c + n + 1});
  EXPECT_EQ(simplified(sphere(4), {}, 0.5).report.components, 1U);
  EXPECT_EQ(simplified(two, {}, 0.5).report.components, 2U);
  EXPECT_EQ(simplified(cube_with_face_normals(4), {}, 0.5).report.components, 1U) << "seams part nothing";
}

TEST(SimplifySurface, LocksWhatIsNoSurface) {
  Surface book;  // three pages at one edge
  book.position = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 1, 0}, {-1, -1, 0}};
  book.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const Simplified result = simplified(book, {}, 0.01);
  EXPECT_EQ(result.report.defects.non_manifold_edges, 1U);
  EXPECT_EQ(result.surface.triangles.size(), 3U);
}

// Iso-surfaces have vertices at one place, joined by triangles without area.
TEST(SimplifySurface, CollapsesTrianglesWithoutArea) {
  Surface surface = sphere(24);
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const auto& [a, b, c] : surface.triangles) {
    // A triangle of no size stands in the corner a, with two more without area beside it.
    const auto d = static_cast<std::uint32_t>(surface.position.size());
    const Point3 place = surface.position[a];
    surface.position.insert(surface.position.end(), 2, place);
    for (const std::array<std::uint32_t, 3>& t :
         {std::array{a, b, d}, std::array{d, b, d + 1}, std::array{d + 1, b, c}, std::array{d + 1, c, a},
          std::array{a, d, d + 1}})
      triangles.push_back(t);
  }
  surface.triangles = triangles;
  const Surface result = simplified(surface, {}, 0.1).surface;
  for (const auto& t : result.triangles) {
    const Point3 normal = doubled_area_normal(result, t);
    EXPECT_GT(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2], 0);
  }
}

TEST(SimplifySurface, RefusesTrianglesThatAreNone) {
  Surface surface;
  surface.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  surface.triangles = {{0, 1, 0}, {1, 1, 2}, {2, 2, 2}};
  SimplifySurfaceReport report;
  EXPECT_THROW(simplify_surface(surface, {}, report), InputError);
}

TEST(SimplifySurface, OfNothingIsNothing) {
  SimplifySurfaceReport report;
  EXPECT_TRUE(simplify_surface({}, {}, report).triangles.empty());
}

}  // namespace
}  // namespace tinsmith
