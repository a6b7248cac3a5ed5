// The colours' differences do not depend on blocks, memory and threads; and colours change nothing else.

#include "judge/colour_error.hpp"

#include <gtest/gtest.h>

#include <random>

#include "io/mesh_cases.hpp"
#include "judge/scene.hpp"
#include "pipeline/measure_blocks.hpp"

namespace tinsmith {
namespace {

/// Three channels of random levels; none in some places.
class RandomColours : public ColourField {
 public:
  int n_channels() const override { return 3; }
  ColourGrid read(const GridRect& rect) const override {
    ColourGrid grid{rect, std::vector<HeightGrid>(3, HeightGrid{rect, {}})};
    for (std::int32_t y = rect.y0; y < rect.y0 + rect.height; ++y)
      for (std::int32_t x = rect.x0; x < rect.x0 + rect.width; ++x)
        for (std::int32_t c = 0; c < 3; ++c)
          grid.channels[static_cast<std::size_t>(c)].z.push_back(
              (x + 2 * y) % 11 == 0 ? kVoid : (x * 37 + y * 101 + c * 53) % 256);
    return grid;
  }
};

/// A full mesh, some of its vertices moved and triangles torn out, with a colour at each vertex.
struct ColouredScene {
  Scene scene = full_plane(40, 33);
  std::vector<VertexColour> colours;

  explicit ColouredScene(std::mt19937_64& random) {
    scene.at(7, 9) = kVoid;
    mesh_fully(scene);
    for (auto& v : scene.vertices)
      if (random() % 3 == 0) v[0] += static_cast<double>(random() % 15) / 16 - 0.4375;
    for (int n = 0; n < 9; ++n)
      scene.triangles.erase(scene.triangles.begin() +
                            static_cast<std::ptrdiff_t>(random() % scene.triangles.size()));
    for (std::size_t v = 0; v < scene.vertices.size(); ++v)
      colours.push_back({static_cast<float>(random() % 256), static_cast<float>(random() % 256), 7, 0});
  }

  Certificate judged(BlockSize block, const Budget& budget, int threads,
                     const ColourField* field_of_colours) const {
    const ArrayField field(scene.z.data(), scene.width, scene.height);
    const Samples samples{field, scene.frame, block, {}, field_of_colours};
    const BlockGrid grid(field, block);
    BlockedMesh mesh(grid, scene.frame, budget);
    const Tin tin = scene.tin();
    mesh.add_vertices(tin.vertices);
    if (field_of_colours != nullptr) mesh.add_colours(colours);
    for (const auto& [a, b, c] : tin.triangles) mesh.add_triangle({a, b, c});
    mesh.close();
    return measure_blocks(mesh, samples, threads, 1 << 20);
  }
};

TEST(ColourError, IsTheSameForAnyBlocksMemoryAndThreads) {
  const ScratchFolder folder;
  const RandomColours colours;
  std::mt19937_64 random(31);
  for (int trial = 0; trial < 10; ++trial) {
    SCOPED_TRACE(trial);
    const ColouredScene scene(random);
    const Certificate whole = scene.judged({}, {}, 1, &colours);
    const Certificate plain = scene.judged({}, {}, 1, nullptr);
    EXPECT_GT(whole.color_rmse, 50);
    EXPECT_EQ(whole.max_error, plain.max_error);
    EXPECT_EQ(whole.covered, plain.covered);
    EXPECT_EQ(plain.color_samples, 0U);
    for (const BlockSize block : {BlockSize{7, 5}, BlockSize{16, 16}})
      for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{5000}, std::uint64_t{1} << 30})
        for (const int threads : {1, 3}) {
          const Certificate parts = scene.judged(block, {bytes, bytes, folder.file("")}, threads, &colours);
          ASSERT_EQ(parts.color_samples, whole.color_samples);
          ASSERT_EQ(parts.color_rmse, whole.color_rmse);
          ASSERT_EQ(parts.color_max_error, whole.color_max_error);
          ASSERT_EQ(parts.rmse, whole.rmse);
        }
  }
}

}  // namespace
}  // namespace tinsmith
