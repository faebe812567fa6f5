#include "algorithms/core/pair_history.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <set>

namespace touchstone {
namespace {

TEST(PairHistory, TellsWhatBeganAndEnded) {
  std::mt19937_64 random(3);
  PairHistory history;
  std::set<IndexPair> before;
  std::size_t all_began = 0, all_ended = 0;
  for (const std::uint32_t bodies : {1u, 2u, 50u, 3u, 400u, 0u, 40u}) {
    std::set<IndexPair> now;
    PairSink sink, began, ended;
    sink.start(3);
    for (std::uint32_t i = 0; bodies > 1 && i < 4 * bodies; ++i) {
      const auto a = static_cast<std::uint32_t>(random() % bodies);
      const auto b = static_cast<std::uint32_t>(random() % bodies);
      if (a == b || !now.insert({std::min(a, b), std::max(a, b)}).second) continue;
      sink.chunk(i % 3).push(a, b);
    }
    history.compare(sink, began, ended);
    std::vector<IndexPair> expected;
    std::ranges::set_difference(now, before, std::back_inserter(expected));
    EXPECT_EQ(began.gather(), expected);
    all_began += expected.size();
    expected.clear();
    std::ranges::set_difference(before, now, std::back_inserter(expected));
    EXPECT_EQ(ended.gather(), expected);
    all_ended += expected.size();
    // Set anew in another order, it is the same.
    std::vector<IndexPair> shuffled(now.begin(), now.end());
    std::ranges::shuffle(shuffled, random);
    history.set(shuffled);
    history.compare(sink, began, ended);
    EXPECT_EQ(began.size() + ended.size(), 0u);
    before = now;
  }
  EXPECT_GT(all_began, 1'000u);
  EXPECT_GT(all_ended, 1'000u);
}

TEST(PairHistory, DifferenceOfListsInAnyOrder) {
  std::vector<IndexPair> now = {{5, 9}, {1, 2}, {5, 6}};
  std::vector<IndexPair> before = {{5, 6}, {0, 7}};
  PairSink began, ended;
  write_difference(now, before, began, ended);
  EXPECT_EQ(began.gather(), (std::vector<IndexPair>{{1, 2}, {5, 9}}));
  EXPECT_EQ(ended.gather(), (std::vector<IndexPair>{{0, 7}}));
  // One came twice and went once; one came once and went twice; one did both once.
  now = {{1, 2}, {3, 4}, {1, 2}, {5, 6}};
  before = {{3, 4}, {1, 2}, {3, 4}, {5, 6}};
  write_difference(now, before, began, ended);
  EXPECT_EQ(began.gather(), (std::vector<IndexPair>{{1, 2}}));
  EXPECT_EQ(ended.gather(), (std::vector<IndexPair>{{3, 4}}));
}

}  // namespace
}  // namespace touchstone
