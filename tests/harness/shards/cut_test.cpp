// Tests that units are cut into shards of nearly the least greatest cost.
#include "harness/shards/shard_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

namespace touchstone {
namespace {

using base::UnitRange;

double greatest(const shards::Costs& costs, const std::vector<UnitRange>& ranges) {
  double most = 0;
  for (const UnitRange& range : ranges) most = std::max(most, costs.of(range));
  return most;
}

// The least greatest cost, by trying every cut.
double least_greatest(const std::vector<double>& costs, std::int64_t shards) {
  const std::size_t n = costs.size();
  const double none = std::numeric_limits<double>::infinity();
  std::vector<double> best(n + 1, none);  // of the first units, with the shards so far
  best[0] = 0;
  for (std::int64_t shard = 0; shard < shards; ++shard) {
    std::vector<double> next(n + 1, none);
    for (std::size_t from = 0; from < n; ++from) {
      double sum = 0;
      for (std::size_t to = from; to < n; ++to) {
        sum += costs[to];
        next[to + 1] = std::min(next[to + 1], std::max(best[from], sum));
      }
    }
    best = next;
  }
  return best[n];
}

void expect_whole(const std::vector<UnitRange>& ranges, std::int64_t units, std::int64_t shards) {
  ASSERT_EQ(std::ssize(ranges), shards);
  std::int64_t next = 0;
  for (const UnitRange& range : ranges) {
    EXPECT_EQ(range.first, next);
    EXPECT_FALSE(range.empty());
    next = range.end;
  }
  EXPECT_EQ(next, units);
}

TEST(Cut, IsAsEvenAsAnyCut) {
  std::mt19937_64 random(1);
  int uneven = 0;
  for (int round = 0; round < 300; ++round) {
    const std::int64_t units = 1 + static_cast<std::int64_t>(random() % 14);
    const std::int64_t shards = 1 + static_cast<std::int64_t>(random() % units);
    std::vector<double> costs;
    for (std::int64_t i = 0; i < units; ++i)
      costs.push_back(std::exp2(static_cast<double>(random() % 120) / 10 - 6));
    const shards::Costs sums(costs, units);
    const std::vector<UnitRange> ranges = cut(sums, shards);
    expect_whole(ranges, units, shards);
    const double least = least_greatest(costs, shards);
    EXPECT_LE(greatest(sums, ranges), least * (1 + 1e-5));
    uneven += greatest(sums, ranges) > 1.5 * sums.of({0, units}) / static_cast<double>(shards);
  }
  EXPECT_GT(uneven, 20);  // both even and uneven cuts were among them
  EXPECT_LT(uneven, 280);
}

TEST(Cut, MoreUnitsThanMemoryHoldsAreAPeriodRepeated) {
  constexpr std::int64_t units = 1'000'000'007, shards = 1000;
  const shards::Costs costs({1, 2, 4, 1e-3}, units);
  const std::vector<UnitRange> ranges = cut(costs, shards);
  expect_whole(ranges, units, shards);
  const double whole = costs.of({0, units});
  EXPECT_NEAR(whole, 250'000'001.0 * 7.001 + 7, 7.1);
  EXPECT_LE(greatest(costs, ranges), whole / shards * 1.001);
}

TEST(Cut, AUnitThatCostsMoreThanAllOthersStandsAlone) {
  const shards::Costs costs({1, 1, 100, 1, 1}, 5);
  const std::vector<UnitRange> ranges = cut(costs, 3);
  EXPECT_EQ(greatest(costs, ranges), 100);
  EXPECT_EQ(ranges, (std::vector<UnitRange>{{0, 2}, {2, 3}, {3, 5}}));
}

}  // namespace
}  // namespace touchstone
