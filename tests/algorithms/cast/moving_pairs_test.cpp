// Tests of the broad phase of motion: the same pairs for every broad phase, cut and width, and those of
// all pairs of moving boxes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "algorithms/kernels/motion/moving_boxes.h"
#include "algorithms/moving_pairs.h"
#include "algorithms/registry.h"
#include "harness/families/draws.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

// Unit cubes that move by up to `motion`, spread so that each overlaps about one at rest.
std::vector<MovingBox> cubes(std::size_t count, double motion, unsigned seed) {
  families::RandomDraws random(seed);
  const double side = std::cbrt(8.0 * static_cast<double>(count));
  std::vector<MovingBox> bodies(count);
  for (MovingBox& body : bodies) {
    const Vec3d place = random.vector(side / 2), move = motion * random.direction();
    for (std::size_t k = 0; k < 3; ++k) {
      body.box.min[k] = static_cast<float>(place[static_cast<int>(k)]);
      body.box.max[k] = body.box.min[k] + 1;
      body.displacement[k] = static_cast<float>(move[static_cast<int>(k)]);
    }
  }
  return bodies;
}

std::vector<IndexPair> all_meeting(const std::vector<MovingBox>& bodies) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    for (std::uint32_t j = i + 1; j < bodies.size(); ++j) {
      if (moving_boxes_meet(bodies[i], bodies[j])) pairs.push_back({i, j});
    }
  }
  return pairs;
}

std::vector<IndexPair> sorted(std::vector<IndexPair> pairs) {
  std::ranges::sort(pairs);
  return pairs;
}

TEST(MovingPairs, AreThoseOfAllPairsForEveryBroadPhaseAndCut) {
  // Three threads search parts of their own, and the last of 8 or 16 parts have threads to spare.
  Executor alone(1), crew(3);
  for (const double motion : {0.0, 1.0, 30.0}) {
    const auto bodies = cubes(static_cast<std::size_t>(drawn(300, 120)), motion, 1);
    const std::vector<IndexPair> expected = all_meeting(bodies);
    ASSERT_GT(expected.size(), bodies.size() / 4);
    for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
      if (!is_built(entry.info)) continue;
      const bool is_tried_most = entry.info.name == "linear-bvh";
      for (const int parts : is_tried_most ? std::vector{0, 1, 2, 16, 64} : std::vector{1, 8}) {
        std::vector<std::vector<IndexPair>> found;
        for (Executor* executor : {&alone, &crew}) {
          MovingPairs moving(entry, *executor, parts);
          std::vector<IndexPair>& pairs = found.emplace_back();
          ASSERT_EQ(moving.find_pairs(bodies, pairs), Status::ok) << entry.info.name;
          EXPECT_EQ(sorted(pairs), expected) << entry.info.name << ", " << parts << " parts";
          EXPECT_TRUE(parts == 0 || moving.parts() == parts);
        }
        // Embree's threads write in any order.
        EXPECT_TRUE(found[0] == found[1] || entry.info.origin == Origin::peer) << entry.info.name;
      }
    }
  }
}

TEST(MovingPairs, HaveAnOrderThatDoesNotDependOnTheThreads) {
  const auto bodies = cubes(static_cast<std::size_t>(drawn(6000, 1000)), 20, 2);
  std::vector<IndexPair> alone, two;
  Executor one(1), crew(2);
  const auto find = [&](Executor& executor, std::vector<IndexPair>& pairs) {
    MovingPairs moving(*registry::find<BroadPhaseEntry>("linear-bvh"), executor);
    EXPECT_EQ(moving.find_pairs(bodies, pairs), Status::ok);
    EXPECT_GT(moving.parts(), 1);
    EXPECT_GE(moving.candidates(), pairs.size());
  };
  find(one, alone);
  find(crew, two);
  EXPECT_EQ(alone, two);
}

TEST(MovingPairs, AreTheSameWhereTheSweptBoxesAreKnown) {
  Executor executor(2);
  MovingPairs moving(*registry::find<BroadPhaseEntry>("linear-bvh"), executor);
  for (const double motion : {0.5, 20.0}) {
    const auto bodies = cubes(900, motion, 5);
    std::vector<Aabb> swept;
    for (const MovingBox& body : bodies) swept.push_back(swept_box(body));
    std::vector<IndexPair> pairs, others;
    ASSERT_EQ(moving.find_pairs(bodies, pairs), Status::ok);
    const int parts = moving.parts();
    EXPECT_EQ(parts > 1, motion > 1);
    ASSERT_EQ(moving.find_pairs(bodies, swept, others), Status::ok);
    EXPECT_EQ(moving.parts(), parts);
    EXPECT_EQ(pairs, others);
    EXPECT_FALSE(pairs.empty());
  }
}

TEST(MovingPairs, AreCutWhereBoxesSweepMuch) {
  Executor executor(1);
  const BroadPhaseEntry& broad = *registry::find<BroadPhaseEntry>("linear-bvh");
  MovingPairs chosen(broad, executor), whole(broad, executor, 1);
  std::vector<IndexPair> pairs, others;
  const std::size_t count = 3000;
  ASSERT_EQ(chosen.find_pairs(cubes(count, 0.5, 3), pairs), Status::ok);
  EXPECT_EQ(chosen.parts(), 1);
  const auto fast = cubes(count, 20, 3);
  ASSERT_EQ(chosen.find_pairs(fast, pairs), Status::ok);
  ASSERT_EQ(whole.find_pairs(fast, others), Status::ok);
  EXPECT_GT(chosen.parts(), 1);
  EXPECT_LT(chosen.candidates(), whole.candidates() / 2);
  EXPECT_EQ(sorted(pairs), sorted(others));
}

TEST(MovingPairs, OfNothingAndOfEmptySlots) {
  Executor executor(1);
  MovingPairs moving(*registry::find<BroadPhaseEntry>("sweep-one-axis"), executor);
  std::vector<IndexPair> pairs = {{0, 1}};
  EXPECT_EQ(moving.find_pairs({}, pairs), Status::ok);
  EXPECT_TRUE(pairs.empty());
  std::vector<MovingBox> bodies = cubes(3, 0, 4);
  bodies[1] = {Aabb::empty(), {0, 0, 0}, 0};
  bodies[2].box = bodies[0].box;
  EXPECT_EQ(moving.find_pairs(bodies, pairs), Status::ok);
  EXPECT_THAT(pairs, testing::ElementsAre(IndexPair{0, 2}));
}

// Far and fast boxes whose sweeps leave the range of floats.
TEST(MovingPairs, OfHugeMotions) {
  Executor executor(1);
  MovingPairs moving(*registry::find<BroadPhaseEntry>("linear-bvh"), executor);
  constexpr float far = 3e38F;
  std::vector<MovingBox> bodies(3);
  bodies[0] = {{{-far, 0, 0}, {-far, 1, 1}}, {far, 0, 0}, 0};
  bodies[1] = {{{far, 0, 0}, {far, 1, 1}}, {-far, 0, 0}, 0};
  bodies[2] = {{{far, 5, 0}, {far, 6, 1}}, {far, 0, 0}, 0};
  std::vector<IndexPair> pairs;
  EXPECT_EQ(moving.find_pairs(bodies, pairs), Status::ok);
  EXPECT_THAT(pairs, testing::ElementsAre(IndexPair{0, 1}));
}

}  // namespace
}  // namespace touchstone
