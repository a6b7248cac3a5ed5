#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "support/surface_shapes.hpp"
#include "tinsmith/error.hpp"
#include "tinsmith/progressive.hpp"

namespace tinsmith {
namespace {

using namespace test;

class ProgressiveFile : public testing::Test {
 protected:
  ~ProgressiveFile() override { std::filesystem::remove(path_); }

  std::string path_ =
      testing::TempDir() + "progressive_" + testing::UnitTest::GetInstance()->current_test_info()->name() + ".tspm";
};

ProgressiveSurface progressive_of(const Surface& surface) {
  SimplifySurfaceOptions options;
  options.ratio = 0.05;
  SimplifySurfaceReport report;
  return make_progressive(surface, options, report);
}

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST_F(ProgressiveFile, ComesBackInFullAndInPart) {
  const Surface surface = with_normals(with_checker_colour(scan(16), 4));
  write_progressive(path_, progressive_of(surface));
  const Surface full = restore(read_progressive(path_));
  EXPECT_EQ(full.position, surface.position);
  EXPECT_EQ(full.triangles, surface.triangles);
  ASSERT_EQ(full.attributes.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ(full.attributes[i].values, surface.attributes[i].values);
  const ProgressiveSurface part = read_progressive(path_, 1000);
  EXPECT_LE(part.splits.size(), 500U);
  const Surface restored = restore(part, 1000);
  EXPECT_EQ(restored.triangles, restore(read_progressive(path_), 1000).triangles);
  EXPECT_LE(restored.triangles.size(), 1000U);
  EXPECT_GE(restored.triangles.size(), 998U);
}

TEST_F(ProgressiveFile, DamageIsFoundOrHarmless) {
  write_progressive(path_, progressive_of(with_gradient_colour(sphere(4))));
  const std::string whole = bytes_of(path_);
  std::mt19937_64 random(601);
  int n_found = 0;
  constexpr int kRounds = 600;
  for (int i = 0; i < kRounds; ++i) {
    std::string damaged = whole;
    if (i % 3 == 0) {
      damaged.resize(random() % whole.size());
    } else {
      damaged[random() % whole.size()] ^= static_cast<char>(1U << (random() % 8));
    }
    std::ofstream(path_, std::ios::binary) << damaged;
    try {
      restore(read_progressive(path_));
    } catch (const InputError&) {
      ++n_found;
    }
  }
  EXPECT_EQ(n_found, kRounds);
}

TEST_F(ProgressiveFile, ValuesThatNoSurfaceHasAreRefused) {
  const ProgressiveSurface sound = progressive_of(with_gradient_colour(sphere(4)));
  const auto expect_refused = [&](ProgressiveSurface unsound) {
    write_progressive(path_, unsound);
    EXPECT_THROW(read_progressive(path_), InputError);
  };
  ProgressiveSurface changed = sound;
  changed.base.attributes[0].values[1] = 1.5F;
  expect_refused(changed);
  changed = sound;
  changed.splits.back().vertices.at(0).values[2] = std::nanf("");
  expect_refused(changed);
  changed = sound;
  changed.base.attributes.push_back(changed.base.attributes[0]);  // a second colour
  for (VertexSplit& split : changed.splits) {
    for (VertexSplit::Vertex& vertex : split.vertices) vertex.values.resize(6);
  }
  expect_refused(changed);
}

TEST_F(ProgressiveFile, OtherFilesAreRefused) {
  std::ofstream(path_) << "ply\nformat ascii 1.0\nend_header\n";
  EXPECT_THROW(read_progressive(path_), InputError);
}

}  // namespace
}  // namespace tinsmith
