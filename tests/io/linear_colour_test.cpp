// sRGB levels and the linear shares of light that glTF stores.

#include "io/linear_colour.hpp"

#include <gtest/gtest.h>

namespace tinsmith {
namespace {

TEST(LinearColour, WholeLevelsComeBackExactlyFrom16BitsAndFromFloat32) {
  for (int level = 0; level <= 255; ++level) {
    EXPECT_EQ(level_of_share(share_of_level(level)), static_cast<float>(level));
    EXPECT_EQ(level_of_light(static_cast<double>(static_cast<float>(light_of_level(level)))), level);
  }
}

TEST(LinearColour, SharesComeBackFromTheirLevels) {
  for (std::uint32_t share = 0; share <= 65535; ++share)
    ASSERT_EQ(share_of_level(static_cast<double>(level_of_share(static_cast<std::uint16_t>(share)))), share);
}

TEST(LinearColour, IsThatOfTheStandard) {
  EXPECT_EQ(light_of_level(0), 0);
  EXPECT_EQ(light_of_level(255), 1);
  EXPECT_NEAR(light_of_level(10), 10 / 255.0 / 12.92, 1e-15) << "the straight part";
  EXPECT_NEAR(light_of_level(128), 0.21586050, 1e-8);
  EXPECT_NEAR(level_of_light(0.5), 187.5160, 1e-4);
}

TEST(LinearColour, RisesWithTheLevelAndStaysInItsRange) {
  for (int tenth = 1; tenth <= 2550; ++tenth)
    ASSERT_GT(light_of_level(tenth / 10.0), light_of_level((tenth - 1) / 10.0)) << tenth;
  EXPECT_EQ(share_of_level(-3), 0);
  EXPECT_EQ(share_of_level(300), 65535);
}

}  // namespace
}  // namespace tinsmith
