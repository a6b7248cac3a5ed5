#include "triangulate/full_grid.hpp"

#include <gtest/gtest.h>

#include "support/random_grid.hpp"
#include "support/surface_check.hpp"

namespace tinsmith {
namespace {

using namespace test;

TEST(FullGrid, CoversTheValidCellsOfAnyWindowWithoutError) {
  for (const Mask mask : kMasks) {
    SCOPED_TRACE(name_of(mask));
    const HeightGrid grid = mountains(45, 38, 431, mask);
    for (const GridRect window : {grid.rect, GridRect{7, 5, 20, 17}}) {
      const WindowMesh mesh = full_grid(grid, window);
      EXPECT_EQ(validate(mesh), "");
      const SurfaceCheck check = check_surface(mesh, grid, window);
      EXPECT_EQ(complaints(check, 1e-9), "");
      EXPECT_EQ(soup_of(mesh).triangles.size(), 2 * check.cells);
    }
  }
}

}  // namespace
}  // namespace tinsmith
