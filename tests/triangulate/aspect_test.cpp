// Cells that are not square.

#include <gtest/gtest.h>

#include <cmath>

#include "samples/array_field.hpp"
#include "triangulate/triangulate.hpp"

namespace tinsmith {
namespace {

// Samples in line on a diagonal of the grid must be in line for the triangulation too.
TEST(Aspect, NoTriangleLosesItsAreaHoweverOddTheCellsAre) {
  constexpr std::int32_t kSide = 65;
  std::vector<double> z(static_cast<std::size_t>(kSide) * kSide);
  for (std::int32_t y = 0; y < kSide; ++y) {
    for (std::int32_t x = 0; x < kSide; ++x) {
      const bool is_void = (x * 7 + y * 13) % 31 == 0;
      z[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)] =
          is_void ? std::nan("") : 100 * std::sin(0.3 * x) * std::cos(0.2 * y);
    }
  }
  const ArrayField field(z.data(), kSide, kSide);
  const HeightGrid samples = field.read({-1, -1, kSide + 2, kSide + 2});
  for (const double aspect : {1e-9, 0.1, 0.618033988749, 0.7000000001, 1.4142135623, 3.3333333333, 1e9}) {
    const WindowMesh mesh = triangulate(samples, {0, 0, kSide, kSide}, {0.5, aspect});
    EXPECT_GT(mesh.origin.size(), 3000U);
    EXPECT_EQ(validate(mesh), "") << "aspect " << aspect;
  }
}

}  // namespace
}  // namespace tinsmith
