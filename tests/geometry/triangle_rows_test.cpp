#include "geometry/triangle_rows.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>

namespace tinsmith {
namespace {

using Triangle = std::array<LatticePoint, 3>;

// What a batch of triangles really tested.
struct Tally {
  std::int64_t triangles = 0;
  std::int64_t rows = 0;
  std::int64_t empty_rows = 0;  // between the rows of a triangle, without a sample
  std::int64_t samples_on_side = 0;
};

// The exact answer: no sample is on the wrong side of a side. Rows are convex, so the two ends and what lies just
// beyond them tell for the whole row.
class Exact {
 public:
  explicit Exact(const Triangle& t) : t_(t) {}
  bool contains(std::int32_t x, std::int32_t y) const { return least(x, y) >= 0; }
  bool is_on_side(std::int32_t x, std::int32_t y) const { return least(x, y) == 0; }

 private:
  std::int64_t least(std::int32_t x, std::int32_t y) const {
    const LatticePoint p{x * kLatticePerCell, y * kLatticePerCell};
    return std::min({orient(t_[0], t_[1], p), orient(t_[1], t_[2], p), orient(t_[2], t_[0], p)});
  }
  const Triangle& t_;
};

::testing::AssertionResult covers_exactly(const Triangle& t, Tally& tally) {
  const TriangleRows rows(t[0], t[1], t[2]);
  const Exact exact(t);
  const auto wrong = [&](std::int32_t x, std::int32_t y) {
    return ::testing::AssertionFailure()
           << "sample (" << x << ", " << y << ") of the triangle (" << t[0].x << ", " << t[0].y << ") (" << t[1].x
           << ", " << t[1].y << ") (" << t[2].x << ", " << t[2].y << ")";
  };
  ++tally.triangles;
  for (std::int32_t y = rows.first_row; y <= rows.last_row; ++y) {
    const auto [first, last] = rows.columns(y);
    ++tally.rows;
    if (first > last) ++tally.empty_rows;
    for (const std::int32_t x : {first - 1, first, last, last + 1}) {
      const bool is_listed = first <= x && x <= last;
      if (exact.contains(x, y) != is_listed) return wrong(x, y);
      if (is_listed && exact.is_on_side(x, y)) ++tally.samples_on_side;
    }
  }
  return ::testing::AssertionSuccess();
}

// Counter-clockwise, or nothing.
template <class Draw>
void test_triangles(std::uint64_t seed, int n, Draw&& draw, Tally& tally) {
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < n; ++i) {
    Triangle t = draw(random);
    if (orient(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
    if (orient(t[0], t[1], t[2]) == 0) continue;
    ASSERT_TRUE(covers_exactly(t, tally));
  }
}

LatticePoint draw_point(std::mt19937_64& random, std::int32_t side, LatticePoint origin = {}) {
  std::uniform_int_distribution<std::int32_t> within(-side, side);
  const std::int32_t x = within(random);
  return {origin.x + x, origin.y + within(random)};
}

TEST(TriangleRows, CoverExactlyTheSamplesOfSmallTriangles) {
  Tally tally;
  const auto draw = [](std::mt19937_64& r) {
    return Triangle{draw_point(r, 90), draw_point(r, 90), draw_point(r, 90)};
  };
  test_triangles(11, 200'000, draw, tally);
  EXPECT_GT(tally.triangles, 190'000);
  EXPECT_GT(tally.samples_on_side, 10'000);
  EXPECT_GT(tally.empty_rows, 20'000);
}

TEST(TriangleRows, CoverExactlyTheSamplesOfTrianglesOverSamples) {
  Tally tally;
  const auto at_sample = [](std::mt19937_64& r) {
    const LatticePoint p = draw_point(r, 40);
    return LatticePoint{p.x * kLatticePerCell, p.y * kLatticePerCell};
  };
  test_triangles(
      12, 50'000,
      [&](std::mt19937_64& r) {
        return Triangle{at_sample(r), at_sample(r), at_sample(r)};
      },
      tally);
  EXPECT_GT(tally.samples_on_side, tally.triangles);
}

TEST(TriangleRows, CoverExactlyTheSamplesOfTrianglesWithAxisParallelSides) {
  Tally tally;
  const auto draw = [](std::mt19937_64& r) {
    Triangle t{draw_point(r, 200), draw_point(r, 200), draw_point(r, 200)};
    const bool along_row = r() % 2 == 0;
    (along_row ? t[1].y : t[1].x) = along_row ? t[0].y : t[0].x;
    if (r() % 2 == 0) (along_row ? t[2].x : t[2].y) = along_row ? t[0].x : t[0].y;  // both sides
    if (r() % 2 == 0) {  // on a row and a column of samples
      for (LatticePoint& p : t)
        p = {p.x / kLatticePerCell * kLatticePerCell, p.y / kLatticePerCell * kLatticePerCell};
    }
    return t;
  };
  test_triangles(13, 50'000, draw, tally);
  EXPECT_GT(tally.samples_on_side, tally.triangles);
}

// One lattice unit wide at most, up to 2000 cells long.
TEST(TriangleRows, CoverExactlyTheSamplesOfSlivers) {
  Tally tally;
  const auto draw = [](std::mt19937_64& r) {
    const LatticePoint a = draw_point(r, 16'000);
    const LatticePoint b = draw_point(r, 16'000);
    const std::int64_t t = static_cast<std::int64_t>(r() % 1000);
    const LatticePoint near{static_cast<std::int32_t>(a.x + (b.x - a.x) * t / 1000),
                            static_cast<std::int32_t>(a.y + (b.y - a.y) * t / 1000)};
    return Triangle{a, b, draw_point(r, 1, near)};
  };
  test_triangles(14, 3'000, draw, tally);
  EXPECT_GT(tally.empty_rows, tally.rows / 2);
  EXPECT_GT(tally.rows, 1'000'000);
}

// A raster of a hundred million columns ends the lattice's range; windows there are as small as everywhere.
TEST(TriangleRows, CoverExactlyTheSamplesFarFromTheOrigin) {
  Tally tally;
  const auto draw = [](std::mt19937_64& r) {
    const LatticePoint far{r() % 2 == 0 ? 1'600'000'000 : -1'600'000'000,
                           r() % 2 == 0 ? 1'600'000'000 : -1'600'000'000};
    return Triangle{draw_point(r, 8'000, far), draw_point(r, 8'000, far), draw_point(r, 8'000, far)};
  };
  test_triangles(15, 3'000, draw, tally);
  EXPECT_GT(tally.rows, 500'000);
}

TEST(TriangleRows, HaveNoRowWhereTheTriangleLiesBetweenRows) {
  const TriangleRows rows({3, 1}, {40, 2}, {20, 15});
  EXPECT_GT(rows.first_row, rows.last_row);
}

TEST(PlaneThrough, GivesTheHeightsOfItsPointsAndBetweenThem) {
  std::mt19937_64 random(16);
  std::uniform_real_distribution<double> height(-5000, 9000);
  int tested = 0;
  for (int i = 0; i < 10'000; ++i) {
    const Triangle t{draw_point(random, 3000), draw_point(random, 3000), draw_point(random, 3000)};
    if (std::abs(orient(t[0], t[1], t[2])) < 3000) continue;
    ++tested;
    const std::array<double, 3> z{height(random), height(random), height(random)};
    const Plane plane = plane_through({t[0], z[0]}, {t[1], z[1]}, {t[2], z[2]});
    double mean_x = 0;
    double mean_y = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = t[k].x / 16.0;
      const double y = t[k].y / 16.0;
      EXPECT_NEAR(plane.at(x, y), z[k], 1e-6);
      mean_x += x / 3;
      mean_y += y / 3;
    }
    EXPECT_NEAR(plane.at(mean_x, mean_y), (z[0] + z[1] + z[2]) / 3, 1e-6);
  }
  EXPECT_GT(tested, 9'000) << "seed 16";
}

TEST(Lattice, OrientIsExactAtTheEndsOfItsRange) {
  constexpr std::int32_t kFar = 1'000'000'000;
  EXPECT_EQ(orient({-kFar, -kFar}, {kFar, kFar - 1}, {kFar, kFar}), 2'000'000'000);
  EXPECT_EQ(orient({-kFar, -kFar}, {0, 0}, {kFar, kFar}), 0);
  EXPECT_EQ(orient({-kFar, -kFar}, {0, 1}, {kFar, kFar}), -2'000'000'000);
}

TEST(Lattice, CellsOfNegativeCoordinatesRoundDownAndUp) {
  EXPECT_EQ(floor_cell(-1), -1);
  EXPECT_EQ(ceil_cell(-1), 0);
  EXPECT_EQ(floor_cell(-16), -1);
  EXPECT_EQ(ceil_cell(-16), -1);
  EXPECT_EQ(floor_cell(31), 1);
  EXPECT_EQ(ceil_cell(17), 2);
}

}  // namespace
}  // namespace tinsmith
