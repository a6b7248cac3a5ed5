// What memory does not hold comes back from the file, in order.

#include "judge/block_bins.hpp"

#include <gtest/gtest.h>

#include <random>

namespace tinsmith {
namespace {

constexpr std::uint64_t kPlenty = 1 << 20;
constexpr std::uint64_t kLittle = 4096;

using Elements = std::map<BlockNumber, std::vector<int>>;

Elements fill(BlockBins<int>& bins) {
  Elements expected;
  std::mt19937 random(1);
  for (int i = 0; i < 10000; ++i) {
    const BlockNumber block = random() % 50;
    bins.put(block, i);
    expected[block].push_back(i);
  }
  return expected;
}

TEST(BlockBins, GiveBackTheElementsOfABlockInTheirOrderForAnyMemory) {
  for (const std::uint64_t memory : {kPlenty, kLittle, std::uint64_t{0}}) {
    for (const bool is_finished : {false, true}) {
      BlockBins<int> bins(memory, testing::TempDir());
      const Elements expected = fill(bins);
      if (is_finished) bins.finish();
      for (const auto& [block, elements] : expected) {
        EXPECT_EQ(bins.count(block), elements.size());
        EXPECT_EQ(bins.take(block), elements) << "block " << block << ", memory " << memory;
      }
    }
  }
}

TEST(BlockBins, HoldNothingOnceSomeAreInTheFileAndNoMoreCome) {
  BlockBins<int> few(kPlenty, testing::TempDir());
  fill(few);
  few.finish();
  EXPECT_GE(few.held(), 10000 * sizeof(int)) << "all fit";
  BlockBins<int> many(kLittle, testing::TempDir());
  fill(many);
  EXPECT_LE(many.held(), kLittle);
  many.finish();
  EXPECT_EQ(many.held(), 0U);
}

}  // namespace
}  // namespace tinsmith
