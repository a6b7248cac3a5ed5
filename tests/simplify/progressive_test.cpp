// Progressive meshes: what was simplified comes back, step by step.

#include "tinsmith/progressive.hpp"

#include <gtest/gtest.h>

#include "support/surface_measures.hpp"
#include "support/surface_shapes.hpp"

namespace tinsmith {
namespace {

using namespace test;

bool is_same(const Surface& a, const Surface& b) {
  if (a.position != b.position || a.triangles != b.triangles || a.attributes.size() != b.attributes.size())
    return false;
  for (std::size_t i = 0; i < a.attributes.size(); ++i) {
    if (a.attributes[i].kind != b.attributes[i].kind || a.attributes[i].values != b.attributes[i].values)
      return false;
  }
  return true;
}

SimplifySurfaceOptions to_ratio(double ratio) {
  SimplifySurfaceOptions options;
  options.ratio = ratio;
  return options;
}

TEST(ProgressiveSurface, RestoredInFullIsTheInput) {
  for (const Surface& surface : {sphere(10), torus(30, 20), open_sheet(20),
                                 with_normals(with_checker_colour(scan(16), 4)), cube_with_creases(8)}) {
    SimplifySurfaceReport report;
    const ProgressiveSurface progressive = make_progressive(surface, to_ratio(0.05), report);
    EXPECT_LE(progressive.base.triangles.size(), surface.triangles.size() / 20 + 1);
    EXPECT_EQ(progressive.splits.size(), report.collapses);
    EXPECT_TRUE(is_same(restore(progressive), surface));
  }
}

TEST(ProgressiveSurface, BaseIsWhatSubsetPlacementGives) {
  const Surface surface = with_gradient_colour(scan(16));
  SimplifySurfaceReport report;
  SimplifySurfaceOptions options = to_ratio(0.1);
  const Surface base = restore(make_progressive(surface, options, report), 0);
  options.placement = Placement::kSubset;
  const Surface simplified = simplify_surface(surface, options, report);
  EXPECT_EQ(base.triangles.size(), simplified.triangles.size());
  EXPECT_LT(distance(base, simplified, 1'000).max(), 1e-12);
}

TEST(ProgressiveSurface, EveryResolutionIsAManifoldOfThatSize) {
  const Surface surface = scan(16);
  SimplifySurfaceReport report;
  const ProgressiveSurface progressive = make_progressive(surface, to_ratio(0.02), report);
  for (std::size_t n = progressive.base.triangles.size(); n <= surface.triangles.size(); n += 137) {
    const Surface restored = restore(progressive, static_cast<double>(n));
    EXPECT_LE(restored.triangles.size(), n);
    EXPECT_GE(restored.triangles.size() + 2, n);
    EXPECT_TRUE(is_closed_manifold(restored)) << n;
  }
}

}  // namespace
}  // namespace tinsmith
