#include "render/plan_tin.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace tinsmith {
namespace {

std::array<double, 2> as_they_are(double x, double y) { return {x, y}; }

double height_by_brute_force(const Tin& tin, double x, double y) {
  for (const auto& t : tin.triangles) {
    const auto& a = tin.vertices[t[0]];
    const auto& b = tin.vertices[t[1]];
    const auto& c = tin.vertices[t[2]];
    const double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    const double wb = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area;
    const double wc = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area;
    if (wb >= -1e-9 && wc >= -1e-9 && wb + wc <= 1 + 1e-9) return a[2] + wb * (b[2] - a[2]) + wc * (c[2] - a[2]);
  }
  return std::nan("");
}

TEST(PlanTin, GivesAPlaneItsHeightAtEveryPositionAndNothingOutside) {
  const Tin tin{{{0, 0, 1}, {10, 0, 21}, {10, 8, 45}, {0, 8, 25}}, {{0, 1, 2}, {0, 2, 3}}, ""};
  const HeightGrid heights = heights_at(make_plan_tin(tin, as_they_are), {-3, -2, 20, 14});
  for (int y = -2; y < 12; ++y) {
    for (int x = -3; x < 17; ++x) {
      const bool is_inside = x >= 0 && x <= 10 && y >= 0 && y <= 8;
      ASSERT_EQ(heights.is_valid(x, y), is_inside) << x << " " << y;
      if (is_inside) ASSERT_NEAR(heights.at(x, y), 1 + 2 * x + 3 * y, 1e-12);
    }
  }
}

// A fan about a random centre, at any offset of the rectangle that is asked for.
TEST(PlanTin, AgreesWithBruteForce) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  int n_compared = 0;
  for (int round = 0; round < 100; ++round) {
    Tin tin;
    tin.vertices.push_back({20 + 10 * unit(random), 20 + 10 * unit(random), 100 * unit(random)});
    const std::uint32_t n_rim = 3 + static_cast<std::uint32_t>(8 * unit(random));
    for (std::uint32_t k = 0; k < n_rim; ++k) {
      const double angle = 2 * 3.14159265358979 * k / n_rim;
      tin.vertices.push_back({25 + 24 * std::cos(angle), 25 + 24 * std::sin(angle), 100 * unit(random)});
      tin.triangles.push_back({0, 1 + k, 1 + (k + 1) % n_rim});
    }
    const HeightGrid heights = heights_at(make_plan_tin(tin, as_they_are), {round % 40, round % 30, 20, 25});
    for (int y = heights.rect.y0; y < heights.rect.y0 + 25; ++y) {
      for (int x = heights.rect.x0; x < heights.rect.x0 + 20; ++x) {
        const double expected = height_by_brute_force(tin, x, y);
        if (std::isnan(expected)) continue;
        ++n_compared;
        ASSERT_NEAR(heights.at(x, y), expected, 1e-6) << x << " " << y << " round " << round;
      }
    }
  }
  EXPECT_GT(n_compared, 10000);
}

}  // namespace
}  // namespace tinsmith
