// The choice by counts alone: which candidate which frames want, and how soon.
#include "algorithms/broad_phase/auto/choice.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/algorithms/broad_phase/box_sets.h"

namespace touchstone {
namespace {

class ChoiceByCounts : public testing::Test {
 protected:
  // A world of so many bodies, of which the first `movers` move.
  void start(std::size_t bodies, std::size_t movers) {
    boxes_ = uniform_boxes(random_, bodies, 0.1f);
    moved_.resize(movers);
    std::iota(moved_.begin(), moved_.end(), 0U);
    answers_ = {};
    answers_.is_known = true;
    answers_.pairs = 3 * bodies;
    choice_.start(Candidate::verlet_list, bodies);
  }
  // Returns the first of so many frames in which the candidate is chosen; -1 if in none.
  int frames_until(Candidate candidate, int frames, float step, std::size_t axes = 3) {
    for (int frame = 0; frame < frames; ++frame) {
      for (const std::uint32_t id : moved_) {
        for (std::size_t axis = 0; axis < axes; ++axis) {
          // To and fro, so that the world stays as it is.
          const float by = (frame + static_cast<int>(id)) % 2 == 0 ? step : -step;
          boxes_[id].min[axis] += by;
          boxes_[id].max[axis] += by;
        }
      }
      answers_.tally.listings += asks_.listings;
      answers_.tally.selections += asks_.selections;
      choice_.update({boxes_, moved_, {}, {}}, answers_);
      if (choice_.candidate() == candidate) return frame;
    }
    return -1;
  }

  static constexpr Candidate bvh = Candidate::dynamic_bvh;
  static constexpr Candidate sap = Candidate::sweep_and_prune;
  Random random_{23};
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_;
  Tally asks_;  // in each frame
  Answers answers_;
  Choice choice_;
};

TEST_F(ChoiceByCounts, OfAWorldThatNearlyRestsDependsOnHowManyEndPointsPass) {
  for (const std::uint32_t listings : {0u, 1u}) {
    SCOPED_TRACE(listings);
    start(4'000, 40);
    asks_.listings = listings;
    EXPECT_EQ(frames_until(bvh, 1, 1e-5f), 0);
    // It takes some frames, and then stays.
    EXPECT_GT(frames_until(sap, 5'000, 1e-5f, 1), 4);
    EXPECT_EQ(frames_until(bvh, 5'000, 1e-5f, 1), -1);
    EXPECT_GE(frames_until(bvh, 5'000, 0.1f), 0);
    EXPECT_EQ(frames_until(sap, 5'000, 0.1f), -1);
  }
}

TEST_F(ChoiceByCounts, TakesPairsOfSomeBodiesFromTheDynamicBvh) {
  start(4'000, 40);
  asks_.selections = 1;
  EXPECT_EQ(frames_until(bvh, 1, 1e-5f), 0);
  EXPECT_EQ(frames_until(sap, 5'000, 1e-5f, 1), -1);
  asks_.selections = 0;
  EXPECT_GT(frames_until(sap, 5'000, 1e-5f, 1), 0);
  answers_.tally.selections = 1;  // now and then does not matter
  EXPECT_EQ(frames_until(bvh, 5'000, 1e-5f, 1), -1);
  asks_.selections = 1;
  EXPECT_GE(frames_until(bvh, 5'000, 1e-5f, 1), 0);
}

// Where no more is known than the pairs of those that move, few of them want incremental sweep and
// prune, and many the dynamic BVH.
TEST_F(ChoiceByCounts, TakesPairsOfSomeBodiesForThoseOfAll) {
  for (const std::size_t found : {10, 400}) {
    SCOPED_TRACE(found);
    start(10'000, 100);
    answers_.is_known = false;
    answers_.asked_bodies = 100;
    answers_.found_pairs = found;
    EXPECT_EQ(answers_.pairs_among(10'000), 100.0 * static_cast<double>(found));
    asks_.selections = 1;
    EXPECT_EQ(frames_until(sap, 3'000, 1e-5f, 1) > 0, found == 10);
    EXPECT_EQ(choice_.candidate(), found == 10 ? sap : bvh);
  }
  answers_.is_known = true;
  EXPECT_EQ(answers_.pairs_among(10'000), 30'000);
}

// The costs are not known without the number of the pairs, and were not measured for more bodies.
TEST_F(ChoiceByCounts, StaysWhereCostsAreNotKnown) {
  start(4'000, 40);
  answers_.is_known = false;
  EXPECT_EQ(frames_until(sap, 5'000, 1e-5f, 1), -1);
  EXPECT_EQ(choice_.candidate(), bvh);
  start(100'001, 1'000);
  EXPECT_EQ(frames_until(sap, 1'000, 1e-7f, 1), -1);
  EXPECT_EQ(choice_.candidate(), bvh);
}

// A world that changes its character all the time makes it wait longer and longer.
TEST_F(ChoiceByCounts, ChangesLessAndLessOften) {
  start(2'000, 20);
  std::vector<int> waits;
  for (int change = 0; change < 4; ++change) {
    waits.push_back(frames_until(sap, 1'000'000, 1e-5f, 1));
    ASSERT_GE(waits.back(), 0) << change;
    ASSERT_GE(frames_until(bvh, 1'000'000, 0.1f), 0) << change;
  }
  EXPECT_GT(waits.back(), 4 * waits[1]);
}

TEST_F(ChoiceByCounts, OfManyThatMoveIsTheVerletList) {
  const auto wants_bvh = [&](std::size_t bodies, std::size_t movers, std::size_t pairs,
                             bool is_known = true) {
    start(bodies, movers);
    answers_.is_known = is_known;
    answers_.pairs = pairs * bodies / 2;
    const bool is_bvh = frames_until(bvh, 5, 1e-3f) == 0;
    EXPECT_EQ(choice_.candidate(), is_bvh ? bvh : Candidate::verlet_list);
    return is_bvh;
  };
  for (const std::size_t bodies : {2'000, 400'001}) {
    for (const std::size_t pairs : {1, 6, 60}) {
      EXPECT_TRUE(wants_bvh(bodies, bodies / 32, pairs));
      EXPECT_FALSE(wants_bvh(bodies, bodies / 5, pairs));
    }
    EXPECT_TRUE(wants_bvh(bodies, bodies / 10, 1));
    EXPECT_TRUE(wants_bvh(bodies, bodies / 20, 6));
    EXPECT_FALSE(wants_bvh(bodies, bodies / 10, 6));
    EXPECT_FALSE(wants_bvh(bodies, bodies / 32 + 1, 60));
    EXPECT_FALSE(wants_bvh(bodies, bodies / 10, 1, false));
  }
}

}  // namespace
}  // namespace touchstone
