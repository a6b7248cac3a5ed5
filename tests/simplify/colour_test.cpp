#include <gtest/gtest.h>

#include "simplify/simplify.hpp"
#include "stitch/kinds.hpp"
#include "support/colours.hpp"
#include "support/mesh_drawings.hpp"
#include "support/random_grid.hpp"
#include "support/surface_check.hpp"

namespace tinsmith {
namespace {

using namespace test;

struct Draped {
  WindowMesh mesh;
  SimplifyCounts counts;
};

Draped drape(const HeightGrid& grid, const ColourGrid& colours, const SimplifyOptions& options) {
  Draped result{full_mesh(grid), {}};
  paint(result.mesh, colours);
  const HeightGrid samples = around(grid, grid.rect);
  set_kinds(result.mesh, samples);
  result.counts = simplify(result.mesh, samples, options, &colours);
  return result;
}

SimplifyOptions options_of(double tolerance, double colour_tolerance) {
  return {tolerance, Placement::kOptimal, labour_of(Effort::kDefault), false, {colour_tolerance, 1}};
}

TEST(Colour, HoldsToleranceOfHeightsAndInvariantsOverAllVoids) {
  std::uint64_t refused_colour = 0;
  std::uint64_t collapses = 0;
  for (const Mask mask : kMasks) {
    for (const double tolerance : {0.5, 10.0, 80.0}) {
      for (const Placement placement : {Placement::kOptimal, Placement::kSegment, Placement::kSubset}) {
        SCOPED_TRACE(testing::Message() << name_of(mask) << ", tolerance " << tolerance << ", placement "
                                        << static_cast<int>(placement));
        const HeightGrid grid = mountains(40, 33, 401, mask);
        SimplifyOptions options = options_of(tolerance, 60);
        options.placement = placement;
        const Draped result =
            drape(grid, colours_of(around(grid, grid.rect).rect, 3, tolerance < 1 ? noise : checker), options);
        EXPECT_EQ(validate(result.mesh), "");
        EXPECT_EQ(complaints(check_surface(result.mesh, grid), tolerance + 1e-9), "");
        refused_colour += result.counts.refused_colour;
        collapses += result.counts.collapses;
      }
    }
  }
  EXPECT_GT(refused_colour, 1000U);
  EXPECT_GT(collapses, 5000U);
}

TEST(Colour, CheckerOnAPlaneKeepsItsEdges) {
  const HeightGrid plane = grid_of(97, 97, [](std::int32_t x, std::int32_t y) { return 0.5 * x - 0.25 * y; });
  const ColourGrid colours = colours_of(around(plane, plane.rect).rect, 3, checker);
  const Draped kept = drape(plane, colours, options_of(1, 12));
  const Draped lost = drape(plane, colours, options_of(1, 1e6));
  EXPECT_LT(colour_rmse(soup_of(kept.mesh), kept.mesh.colour, colours), 12);
  EXPECT_GT(colour_rmse(soup_of(lost.mesh), lost.mesh.colour, colours), 50);
  EXPECT_LT(n_triangles(kept.mesh), 97 * 97 * 2 / 3);
}

TEST(Colour, PlaneOfOneColourEndsAsTwoTriangles) {
  const HeightGrid plane = grid_of(33, 33, [](std::int32_t x, std::int32_t) { return 2.0 * x; });
  const ColourGrid colours = colours_of(around(plane, plane.rect).rect, 4, [](std::int32_t, std::int32_t) {
    return Levels{7, 80, 200, 255};
  });
  const Draped result = drape(plane, colours, options_of(1, 12));
  EXPECT_EQ(n_triangles(result.mesh), 2);
  EXPECT_LT(colour_rmse(soup_of(result.mesh), result.mesh.colour, colours), 1e-3);
}

TEST(Colour, LockedVerticesKeepTheirColour) {
  const HeightGrid grid = mountains(40, 33, 402, Mask::kNone);
  const ColourGrid colours = colours_of(around(grid, grid.rect).rect, 3, checker);
  WindowMesh mesh = full_mesh(grid);
  paint(mesh, colours);
  const HeightGrid samples = around(grid, grid.rect);
  set_kinds(mesh, samples);
  for (std::size_t v = 0; v < mesh.position.size(); v += 9) mesh.kind[v] = VertexKind::kLocked;
  const WindowMesh before = mesh;
  EXPECT_GT(simplify(mesh, samples, options_of(80, 80), &colours).collapses, 100U);
  for (std::size_t v = 0; v < mesh.position.size(); v += 9) {
    EXPECT_TRUE(mesh.is_alive(static_cast<std::int32_t>(v)));
    EXPECT_EQ(mesh.colour[v], before.colour[v]);
    EXPECT_EQ(mesh.position[v], before.position[v]);
  }
}

TEST(ColourFit, FindsTheLeastSquaresColourOnEveryMachine) {
  const ColourGrid colours = colours_of({0, 0, 24, 24}, 3, noise);
  const ColourStar star{{{16 * 20, 16 * 2}, {16 * 19, 16 * 21}, {9, 90, 200, 0}, {250, 3, 77, 0}},
                        {{16 * 19, 16 * 21}, {16 * 2, 16 * 12}, {250, 3, 77, 0}, {1, 2, 3, 0}},
                        {{16 * 2, 16 * 12}, {16 * 20, 16 * 2}, {1, 2, 3, 0}, {9, 90, 200, 0}}};
  const LatticePoint p{16 * 13 + 5, 16 * 11 + 9};
  const ColourFit fit = fit_colour(star, colours, p);
  const ColourFit portable = fit_colour_portable(star, colours, p);
  EXPECT_EQ(fit.sum_ww, portable.sum_ww);
  EXPECT_EQ(fit.sum_wr, portable.sum_wr);
  EXPECT_EQ(fit.sum_rr, portable.sum_rr);
  const Levels best = fit.best({});
  for (std::size_t c = 0; c < 3; ++c) {
    for (const float step : {-1.0F, 1.0F}) {
      Levels other = best;
      other[c] += step;
      EXPECT_GT(fit.squared_error(other), fit.squared_error(best));
    }
  }
}

}  // namespace
}  // namespace tinsmith
