// How many facets have to be remembered.

#include "judge/shared_parts.hpp"

#include <gtest/gtest.h>

#include "samples/array_field.hpp"

namespace tinsmith {
namespace {

constexpr int kSide = 64;  // samples
constexpr int kBlock = 4;

/// A strip of facets along a row, each across the border of two blocks or more.
Facet across(std::uint32_t number, double x, double y) {
  Facet facet;
  facet.position = {PlanPoint{x - 0.5, y}, PlanPoint{x + 0.5, y}, PlanPoint{x, y + 0.5}};
  facet.number = number;
  return facet;
}

TEST(SharedParts, AreCountedOnceAndFacetsForgottenWhenAllTheirBlocksHaveTold) {
  const std::vector<double> z(kSide * kSide, 0);
  const ArrayField field(z.data(), kSide, kSide);
  const BlockGrid grid(field, {kBlock, kBlock});
  SharedParts parts;
  constexpr std::uint32_t kFacets = kSide / kBlock - 1;  // one on each border between the blocks of a row
  std::vector<Facet> facets;
  for (std::uint32_t i = 0; i < kFacets; ++i) facets.push_back(across(i, (i + 1) * double{kBlock}, 1));
  const auto see = [&](const std::vector<SharedParts::Member>& members) { parts.add(grid, facets, members); };
  see({{0, 7}});
  for (std::uint32_t block = 1; block < kFacets; ++block) {
    see({{block - 1, 5}, {block, block % 2 == 0 ? 5U : 6U}});  // not connected in every other block
    EXPECT_EQ(parts.n_waiting(), 1U);
  }
  see({{kFacets - 1, 1}});
  EXPECT_EQ(parts.n_waiting(), 0U);
  EXPECT_EQ(parts.count(), (kFacets + 1) / 2);
}

}  // namespace
}  // namespace tinsmith
