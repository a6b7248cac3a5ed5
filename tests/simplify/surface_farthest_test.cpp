// The farthest places come nearer, one by one, and nothing else goes as far.

#include "simplify/surface_farthest.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "simplify/surface_star.hpp"
#include "tinsmith/simplify.hpp"

namespace tinsmith {
namespace {

std::size_t at(std::int32_t i) { return static_cast<std::size_t>(i); }

// n x n vertices, flat but for the given heights; the vertices in `gone` were collapsed into a neighbour each.
struct Case {
  int n;
  std::vector<std::pair<int, double>> heights;
  std::vector<int> gone;
};

class Sheet {
 public:
  SurfaceMesh mesh;
  WedgeValues values;
  FitSamples samples;
  std::vector<std::int32_t> triangle;
  std::vector<float> squared;

  explicit Sheet(const Case& c) {
    Surface surface;
    for (int y = 0; y < c.n; ++y) {
      for (int x = 0; x < c.n; ++x) surface.position.push_back({double(x), double(y), 0});
    }
    for (const auto& [v, height] : c.heights) surface.position[static_cast<std::size_t>(v)][2] = height;
    const auto n = static_cast<std::uint32_t>(c.n);
    for (std::uint32_t y = 0; y + 1 < n; ++y) {
      for (std::uint32_t x = 0; x + 1 < n; ++x) {
        const std::uint32_t v = n * y + x;
        surface.triangles.push_back({v, v + 1, v + n + 1});
        surface.triangles.push_back({v, v + n + 1, v + n});
      }
    }
    SurfaceDefects defects;
    SimplifySurfaceReport report;
    mesh = surface_mesh_of(surface, defects);
    mark_features(mesh, {}, report);
    values = wedge_values(mesh, surface);
    samples = fit_samples(mesh, values, {});
    for (const int v : c.gone) collapse(v);
    measure();
  }

  std::int32_t vertex(int original) const {
    for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.position.size()); ++v) {
      if (mesh.original_vertex[at(samples.wedge[at(v)])] == static_cast<std::uint32_t>(original)) return v;
    }
    return kNone;
  }

  // The nearest triangle of each sample, among all.
  void measure() {
    triangle.assign(samples.place.size(), kNone);
    squared.assign(samples.place.size(), std::numeric_limits<float>::infinity());
    for (std::int32_t h = 0; h < mesh.n_halfedges(); h += 3) {
      if (mesh.origin[at(h)] == kNone) continue;
      for (std::size_t i = 0; i < samples.place.size(); ++i) {
        const auto d = static_cast<float>(squared_distance(samples.place[i], corners_of(mesh, h)));
        if (!(d < squared[i])) continue;
        squared[i] = d;
        triangle[i] = h;
      }
    }
  }

  float farthest() const { return *std::max_element(squared.begin(), squared.end()); }
  int n_triangles() const {
    return static_cast<int>(
        std::count_if(mesh.origin.begin(), mesh.origin.end(), [](auto v) { return v != kNone; }) / 3);
  }

 private:
  // Along a line where it is on one.
  void collapse(int original) {
    const std::int32_t v = vertex(original);
    std::int32_t h = mesh.out[at(v)];
    const std::int32_t kept = mesh.destination(h);
    const std::int32_t wedge = mesh.wedge[at(Halfedges::next(h))];
    for_each_out(mesh, v, [&](std::int32_t e) { mesh.wedge[at(e)] = wedge; });
    carry_feature(mesh, h);
    if (!mesh.is_border_edge(h)) carry_feature(mesh, mesh.twin[at(h)]);
    collapse_edge(mesh, h, kept);
    samples.vertex[at(v)] = kept;
    for (std::int32_t& near : samples.vertex) near = near == v ? kept : near;
  }
};

TEST(BringInFarthest, GivesTheFarthestSampleAVertex) {
  Sheet sheet({5, {{12, 0.5}}, {12}});  // the middle is raised, and gone
  const std::int32_t top = sheet.vertex(12);
  const int n_before = sheet.n_triangles();
  EXPECT_EQ(std::max_element(sheet.squared.begin(), sheet.squared.end()) - sheet.squared.begin(), top);
  const auto added =
      bring_in_farthest(sheet.mesh, sheet.values, sheet.samples, {sheet.triangle, sheet.squared}, {2, 20});
  ASSERT_EQ(added.size(), 1U);
  EXPECT_EQ(added[0].vertex, top);
  EXPECT_EQ(sheet.mesh.position[at(top)], sheet.samples.place[at(top)]);
  EXPECT_EQ(sheet.n_triangles(), n_before + 2);
  const std::vector<float> told = sheet.squared;
  sheet.measure();
  EXPECT_EQ(sheet.squared[at(top)], 0);
  for (std::size_t i = 0; i < told.size(); ++i) EXPECT_GE(told[i], sheet.squared[i] * 0.9999F) << i;
}

TEST(BringInFarthest, GivesABorderAVertexOfTheBorder) {
  Sheet sheet({5, {{2, 0.5}}, {2}});
  const std::int32_t top = sheet.vertex(2);
  const int n_before = sheet.n_triangles();
  const auto added =
      bring_in_farthest(sheet.mesh, sheet.values, sheet.samples, {sheet.triangle, sheet.squared}, {2, 20});
  ASSERT_EQ(added.size(), 1U);
  EXPECT_EQ(added[0].vertex, top);
  EXPECT_TRUE(sheet.mesh.is_border_vertex(top));
  EXPECT_EQ(sheet.n_triangles(), n_before + 1);
}

TEST(BringInFarthest, DrawsAVertexIn) {
  Sheet sheet({5, {}, {6}});
  const std::int32_t v = sheet.vertex(12);
  sheet.mesh.position[at(v)][2] += 0.1;
  sheet.measure();
  const double before = sheet.mesh.position[at(v)][2];
  bring_in_farthest(sheet.mesh, sheet.values, sheet.samples, {sheet.triangle, sheet.squared}, {2, 20});
  EXPECT_LT(sheet.mesh.position[at(v)][2] - sheet.samples.place[at(v)][2], 0.5 * 0.1);
  EXPECT_LT(sheet.mesh.position[at(v)][2], before);
}

// Which is why no vertex comes where the surface is the input already.
TEST(BringInFarthest, AddsNothingToWhatIsNotOff) {
  Sheet sheet({5, {}, {12, 6}});
  const int n_before = sheet.n_triangles();
  EXPECT_TRUE(bring_in_farthest(sheet.mesh, sheet.values, sheet.samples, {sheet.triangle, sheet.squared}, {10, 100})
                  .empty());
  EXPECT_EQ(sheet.n_triangles(), n_before);
}

// Random hills, most of them gone: the more vertices come the nearer is the farthest.
TEST(BringInFarthest, NothingGoesAsFarAsTheFarthestWas) {
  std::uint32_t random = 1;
  for (int i = 0; i < 20; ++i) {
    Case c{9, {}, {}};
    for (int v = 0; v < 81; ++v) {
      random = random * 1664525 + 1013904223;
      c.heights.emplace_back(v, static_cast<double>(random >> 8U) / (1U << 24U));
    }
    for (const int v : {10, 12, 14, 16, 30, 32, 34, 48, 50, 52, 64, 66, 68, 70}) c.gone.push_back(v);
    Sheet sheet(c);
    SCOPED_TRACE(i);
    float farthest = sheet.farthest();
    std::size_t n_added = 0;
    for (int step = 0; step < 4; ++step) {
      n_added +=
          bring_in_farthest(sheet.mesh, sheet.values, sheet.samples, {sheet.triangle, sheet.squared}, {4, 40})
              .size();
      sheet.measure();
      EXPECT_LE(sheet.farthest(), farthest * 1.0001F);
      farthest = sheet.farthest();
    }
    EXPECT_GT(n_added, 0U);
  }
}

}  // namespace
}  // namespace tinsmith
