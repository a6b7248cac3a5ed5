#include "geometry/quadric.hpp"

#include <gtest/gtest.h>

#include <random>

#include "geometry/half_space_test.hpp"

namespace tinsmith {
namespace {

// Tables 1 and 2 of the paper, from the types themselves.
TEST(Quadric, StoresAsManyCoefficientsAsThePaperSays) {
  static_assert(Quadric<3>::kCoefficients == 10);  // geometry
  static_assert(Quadric<6>::kCoefficients == 28);  // geometry with colour, or with normal, in one
  static_assert(2 * Quadric<3>::kCoefficients == 20);
  EXPECT_EQ(sizeof(Quadric<3>), 10 * sizeof(double));
  EXPECT_EQ(sizeof(Quadric<6>), 28 * sizeof(double));
}

template <std::size_t N>
Vec<N> draw(std::mt19937_64& random) {
  Vec<N> v;
  for (double& x : v) x = static_cast<double>(random() % 2000) / 1000 - 1;
  return v;
}

TEST(Quadric, OfAPlaneIsTheSquaredDistanceFromIt) {
  std::mt19937_64 random(501);
  for (int i = 0; i < 200; ++i) {
    Vec<3> n = draw<3>(random);
    const double length = std::sqrt(dot(n, n));
    if (length < 0.1) continue;
    for (double& x : n) x /= length;
    const Vec<3> p = draw<3>(random);
    const Vec<3> v = draw<3>(random);
    Quadric<3> quadric;
    quadric.add_plane(n, p, 2.5);
    const double distance = dot(n, v - p);
    EXPECT_NEAR(quadric.at(v), 2.5 * distance * distance, 1e-12) << "seed 501, case " << i;
  }
}

// In three dimensions the flat of a triangle is its plane; in six its error is that from the nearest point of the
// flat.
TEST(Quadric, OfAFlatVanishesOnItAndGrowsAcross) {
  std::mt19937_64 random(502);
  for (int i = 0; i < 200; ++i) {
    const Vec<6> p = draw<6>(random);
    const Vec<6> q = draw<6>(random);
    const Vec<6> r = draw<6>(random);
    const auto [e1, e2] = directions_of(p, q, r, 1e-9);
    Quadric<6> quadric;
    quadric.add_flat(p, e1, e2, 3);
    for (const Vec<6>& corner : {p, q, r}) EXPECT_NEAR(quadric.at(corner), 0, 1e-9) << "seed 502, case " << i;
    // One step along a direction orthogonal to both.
    Vec<6> n = draw<6>(random);
    for (const Vec<6>& e : {e1, e2}) {
      const double part = dot(n, e);
      for (std::size_t k = 0; k < 6; ++k) n[k] -= part * e[k];
    }
    Vec<6> v = q;
    for (std::size_t k = 0; k < 6; ++k) v[k] += n[k];
    EXPECT_NEAR(quadric.at(v), 3 * dot(n, n), 1e-9) << "seed 502, case " << i;
  }
}

TEST(Quadric, MinimumIsWhereThreePlanesMeetAndNoneWhereTheyAreOne) {
  Quadric<3> quadric;
  const Vec<3> p{0.25, -3, 1e3};
  for (const Vec<3>& n : {Vec<3>{1, 0, 0}, Vec<3>{0, 0.6, 0.8}, Vec<3>{0, -0.8, 0.6}}) quadric.add_plane(n, p, 2);
  Vec<3> v{};
  ASSERT_TRUE(minimum(quadric, v));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(v[i], p[i], 1e-9);
  // The rank does not depend on the scale.
  for (double& q : quadric.q) q *= 1e-30;
  EXPECT_TRUE(minimum(quadric, v));
  Quadric<3> flat;
  for (int i = 0; i < 5; ++i) flat.add_plane({0, 0, 1}, {static_cast<double>(i), 1, 0}, 1e6);
  EXPECT_FALSE(minimum(flat, v));
}

TEST(Quadric, OfThreeEqualValuesIsThatOfAPoint) {
  const Vec<3> value{0.2, 0.4, 0.8};
  const auto [e1, e2] = directions_of(value, value, value, 1e-3);
  Quadric<3> quadric;
  quadric.add_flat(value, e1, e2, 1);
  EXPECT_NEAR(quadric.at({0.2, 0.4, 1.8}), 1, 1e-12);  // eq. 28
}

// Eq. 28 too: from a line the distance counts, along it nothing does.
TEST(Quadric, OfThreeValuesOnALineIsThatOfTheLine) {
  const Vec<3> first{0.2, 0.4, 0.8};
  const Vec<3> last{0.5, 0.8, 0.8};  // half a unit along (0.6, 0.8, 0)
  const Vec<3> between{0.32, 0.56, 0.8};
  for (const auto& [p, q, r] : {std::array{first, last, between}, {between, first, last}, {first, first, last}}) {
    const auto [e1, e2] = directions_of(p, q, r, 1e-3);
    EXPECT_EQ(e2, Vec<3>{});
    Quadric<3> quadric;
    quadric.add_flat(p, e1, e2, 2);
    for (const Vec<3>& on_it : {first, last, between, Vec<3>{-2.8, -3.6, 0.8}})
      EXPECT_NEAR(quadric.at(on_it), 0, 1e-12);
    EXPECT_NEAR(quadric.at({0.5, 0.8, 1.1}), 2 * 0.09, 1e-12);
    EXPECT_NEAR(quadric.at({0.5 - 0.8, 0.8 + 0.6, 0.8}), 2, 1e-12);
  }
}

// A square link in the plane z = 0.
std::vector<LinkSide> square() {
  const std::array<Vec<3>, 4> p{Vec<3>{1, 1, 0}, Vec<3>{-1, 1, 0}, Vec<3>{-1, -1, 0}, Vec<3>{1, -1, 0}};
  std::vector<LinkSide> link;
  for (std::size_t i = 0; i < 4; ++i) link.push_back({p[i], p[(i + 1) % 4], {0, 0, 0}});
  return link;
}

TEST(HalfSpaceTest, AllowsTheInsideOfTheLinkOnly) {
  EXPECT_TRUE(is_inside_half_spaces(square(), {0, 0, 0}));
  EXPECT_TRUE(is_inside_half_spaces(square(), {0.9, -0.9, 0.1}));
  EXPECT_FALSE(is_inside_half_spaces(square(), {1, 0, 0}));  // strictly
  EXPECT_FALSE(is_inside_half_spaces(square(), {1.1, 0, 0}));
}

// A triangle that lay wrong before may stay so, but must not turn over.
TEST(HalfSpaceTest, ExcusesWhatLayWrongBefore) {
  std::vector<LinkSide> link = square();
  EXPECT_FALSE(is_inside_half_spaces(link, {1.1, 0, 0}));
  link[3].before = {1.2, 0, 0};  // the right side
  EXPECT_TRUE(is_inside_half_spaces(link, {1.1, 0, 0}));
  EXPECT_FALSE(is_inside_half_spaces(link, {0, 1.1, 0}));  // the upper side is not excused
}

// At a border the link is an open chain: what lies beyond the missing sides is allowed.
TEST(HalfSpaceTest, LeavesOutTheBorder) {
  std::vector<LinkSide> link = square();
  link.resize(2);  // the upper and the left side
  EXPECT_TRUE(is_inside_half_spaces(link, {5, -5, 0}));
  EXPECT_FALSE(is_inside_half_spaces(link, {0, 1.5, 0}));
}

}  // namespace
}  // namespace tinsmith
