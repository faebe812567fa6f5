// Pairs that are kept, against a set of them, at every level of vector instructions.
#include "algorithms/broad_phase/dynamic_bvh/pair_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <random>
#include <set>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

class KeptPairSets : public testing::Test {
 protected:
  void TearDown() override { limit_isa(isa_of_machine()); }

  Aabb box() {
    Aabb made;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      made.min[axis] = static_cast<float>(random_() >> 40) * 0x1p-24f;
      made.max[axis] = made.min[axis] + 0.5f;
    }
    return made;
  }
  // Also that the order is the same at every level.
  void expect_written() {
    std::vector<IndexPair> truth, first;
    for (const IndexPair pair : pairs_) {
      if (overlap(boxes_[pair.a], boxes_[pair.b])) truth.push_back(pair);
    }
    for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      limit_isa(level);
      kept_.write(executor_, sink_);
      std::vector<IndexPair> found = sink_.gather();
      if (level == Isa::baseline) first = found;
      EXPECT_TRUE(found == first);
      std::ranges::sort(found);
      EXPECT_TRUE(found == truth) << found.size() << " of " << truth.size();
    }
    EXPECT_EQ(kept_.size(), pairs_.size());
    if (kept_.is_told()) {
      PairSink began, ended;
      kept_.write_changes(began, ended);
      std::vector<IndexPair> expected;
      std::ranges::set_difference(truth, told_, std::back_inserter(expected));
      EXPECT_TRUE(began.gather() == expected);
      began_ += expected.size();
      expected.clear();
      std::ranges::set_difference(told_, truth, std::back_inserter(expected));
      EXPECT_TRUE(ended.gather() == expected);
      ended_ += expected.size();
      std::vector<IndexPair> told = kept_.told();
      std::ranges::sort(told);
      EXPECT_TRUE(told == truth);
      told_ = truth;
    }
    met_ += truth.size();
    apart_ += pairs_.size() - truth.size();
  }

  void replace_half(std::uint32_t id, std::uint32_t count) {
    std::vector<std::uint32_t> others;
    for (std::uint32_t other = id < 20 ? 0 : id - 20; other < std::min(count, id + 20); ++other) {
      if (other != id && random_() % 2 == 0) others.push_back(other);
    }
    std::ranges::shuffle(others, random_);
    const std::set<IndexPair> before = pairs_;
    std::erase_if(pairs_, [&](IndexPair pair) { return pair.a == id || pair.b == id; });
    for (const std::uint32_t other : others)
      pairs_.insert({std::min(id, other), std::max(id, other)});
    std::vector<IndexPair> different;
    std::ranges::set_symmetric_difference(before, pairs_, std::back_inserter(different));
    EXPECT_EQ(kept_.replace(id, others, boxes_), different.size());
  }

  std::mt19937_64 random_{9};
  Executor executor_{2};
  PairCache kept_;
  std::set<IndexPair> pairs_;
  std::vector<Aabb> boxes_;
  PairSink sink_;
  std::vector<IndexPair> told_;
  std::size_t met_ = 0, apart_ = 0, began_ = 0, ended_ = 0;
};

TEST_F(KeptPairSets, FollowWhatComesGoesAndMoves) {
  for (const std::uint32_t count : {2u, 11u, 12u, 300u}) {
    SCOPED_TRACE(count);
    boxes_.clear();
    for (std::uint32_t i = 0; i < count; ++i) boxes_.push_back(box());
    // Some of all pairs.
    pairs_.clear();
    sink_.start(3);
    for (std::uint32_t b = 1; b < count; ++b) {
      for (std::uint32_t a = b < 20 ? 0 : b - 20; a < b; ++a) {
        pairs_.insert({a, b});
        sink_.chunk(b % 3).push(a, b);
      }
    }
    kept_.refill(executor_, sink_, count);
    kept_.test(executor_, boxes_);
    expect_written();
    kept_.tell();
    told_ = kept_.told();
    std::ranges::sort(told_);
    for (int frame = 0; frame < 200; ++frame) {
      std::set<std::uint32_t> chosen;
      while (chosen.size() < 1 + count / 50) {
        chosen.insert(static_cast<std::uint32_t>(random_() % count));
      }
      const std::vector<std::uint32_t> ids(chosen.begin(), chosen.end());
      for (const std::uint32_t id : ids) boxes_[id] = box();
      kept_.test(ids, boxes_);
      if (frame % 3 == 0) {
        kept_.remove(ids);
        std::erase_if(pairs_, [&](IndexPair pair) {
          return chosen.contains(pair.a) || chosen.contains(pair.b);
        });
        for (int i = 0; i < 30 && count > 2; ++i) {
          const auto [a, b] = std::minmax({ids[0], static_cast<std::uint32_t>(random_() % count)});
          if (a != b && pairs_.insert({a, b}).second) kept_.add({a, b}, boxes_);
        }
      } else if (frame % 3 == 1 && count > 2) {  // about half of the others, of all in turn
        for (const std::uint32_t id : ids) replace_half(id, count);
      }
      if (frame % 5 != 4) expect_written();  // otherwise changes add up
    }
  }
  EXPECT_GT(met_, 10'000u);
  EXPECT_GT(apart_, 10'000u);
  EXPECT_GT(began_, 500u);
  EXPECT_GT(ended_, 500u);
}

// What goes leaves room for what comes.
TEST_F(KeptPairSets, DoNotGrow) {
  constexpr std::uint32_t count = 500;
  boxes_.assign(count, box());
  sink_.start(1);
  for (std::uint32_t b = 1; b < count; ++b) sink_.chunk(0).push(b - 1, b);
  kept_.refill(executor_, sink_, count);
  std::size_t bytes = 0;
  for (std::uint32_t round = 0; round < 10'000; ++round) {
    const std::uint32_t id = 1 + 2 * (round % (count / 2 - 1));
    kept_.remove(std::vector<std::uint32_t>{id});
    kept_.add({id - 1, id}, boxes_);
    kept_.add({id, id + 1}, boxes_);
    if (round == 1'000) bytes = kept_.held_bytes();
  }
  EXPECT_EQ(kept_.size(), count - 1);
  EXPECT_LE(kept_.held_bytes(), bytes + bytes / 8);
}

}  // namespace
}  // namespace touchstone
