// Tests the comparison of found pairs with true ones.
#include "harness/grade/answer_check.h"

#include <gtest/gtest.h>

#include "harness/base/hash.h"

namespace {

using namespace touchstone;

using Pairs = std::vector<IndexPair>;

TEST(PairCheck, AcceptsTheSetInAnyOrder) {
  const Pairs truth = {{0, 1}, {0, 2}, {3, 4}};
  Pairs found = {{3, 4}, {0, 1}, {0, 2}};
  EXPECT_TRUE(grade::check_pairs(found, truth, {}).none());
  Pairs nothing;
  EXPECT_TRUE(grade::check_pairs(nothing, {}, {}).none());
}

TEST(PairCheck, TellsTheKindsApart) {
  const Aabb unit{{0, 0, 0}, {1, 1, 1}};
  const Aabb away{{9, 9, 9}, {9, 9, 9}};
  // Bodies 5 and 6 overlapped in the frame before; 5 and 7 did not.
  const std::vector<Aabb> before = {away, away, away, away,
                                    away, unit, unit, {{5, 5, 5}, {6, 6, 6}}};
  const Pairs truth = {{0, 1}, {0, 2}, {3, 4}};
  Pairs found = {{5, 6}, {0, 2}, {0, 2}, {4, 3}, {5, 7}, {0, 1}};
  const grade::PairFaults faults = grade::check_pairs(found, truth, before);
  EXPECT_EQ(faults.missing, 1);    // 3-4: the pair was reported as (4, 3)
  EXPECT_EQ(faults.duplicate, 2);  // 0-2 twice, 4-3
  EXPECT_EQ(faults.stale, 1);
  EXPECT_EQ(faults.extra, 1);
  ASSERT_TRUE(faults.example);
  EXPECT_EQ(*faults.example, (IndexPair{3, 4}));
  EXPECT_EQ(to_string(faults), "1 missing, 1 stale, 1 extra, 2 duplicate (first: 3-4)");
}

TEST(PairHash, IsTheContracts) {
  // The hash is mix(1) of SplitMix64, summed over a set in any order.
  EXPECT_EQ(base::mix(0), 0xe220a8397b1dcdafu);
  const Pairs some = {{0, 1}, {2, 3}};
  const Pairs turned = {{2, 3}, {0, 1}};
  EXPECT_EQ(base::pair_hash(some), base::mix(1) + base::mix((2ull << 32) + 3));
  EXPECT_EQ(base::pair_hash(some), base::pair_hash(turned));
  EXPECT_EQ(base::to_hex(0x1f), "000000000000001f");
}

}  // namespace
