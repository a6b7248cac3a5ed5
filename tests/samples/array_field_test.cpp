#include "samples/array_field.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tinsmith/error.hpp"

namespace tinsmith {
namespace {

constexpr double kVoid = std::numeric_limits<double>::quiet_NaN();

TEST(ArrayField, GivesItsHeightsRowByRowAndVoidsOutside) {
  const std::array<double, 6> z{1, 2, 3, 4, kVoid, 6};
  const ArrayField field(z.data(), 3, 2);
  const HeightGrid grid = field.read({-1, -1, 5, 4});
  int n_valid = 0;
  for (int y = -1; y < 3; ++y) {
    for (int x = -1; x < 4; ++x) n_valid += grid.is_valid(x, y) ? 1 : 0;
  }
  EXPECT_EQ(n_valid, 5);
  EXPECT_EQ(grid.at(0, 0), 1);
  EXPECT_EQ(grid.at(2, 0), 3);
  EXPECT_EQ(grid.at(0, 1), 4);
  EXPECT_FALSE(grid.is_valid(1, 1));
}

TEST(ArrayField, FarAwayRectanglesAreVoid) {
  const double z = 7;
  const ArrayField field(&z, 1, 1);
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max() - 1;
  EXPECT_FALSE(field.read({kFar, kFar, 1, 1}).is_valid(kFar, kFar));
  EXPECT_TRUE(field.read({0, 0, 0, 5}).z.empty());
}

TEST(ArrayField, RefusesWhatIsNoHeight) {
  for (const double wrong : {std::numeric_limits<double>::infinity(), -1e11}) {
    const std::array<double, 2> z{0, wrong};
    EXPECT_THROW(ArrayField(z.data(), 2, 1).read({0, 0, 2, 1}), InputError);
  }
  EXPECT_THROW(ArrayField(nullptr, 2, 2), InputError);
}

}  // namespace
}  // namespace tinsmith
