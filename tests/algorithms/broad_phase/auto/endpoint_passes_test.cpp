// Estimated passes of end points against counted ones.
#include "algorithms/broad_phase/auto/endpoint_passes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>

#include "tests/algorithms/broad_phase/box_sets.h"

namespace touchstone {
namespace {

using Ids = std::vector<std::uint32_t>;

Ids all_of(std::span<const Aabb> boxes) {
  Ids ids(boxes.size());
  std::iota(ids.begin(), ids.end(), 0U);
  return ids;
}

std::vector<Aabb> shifted(std::vector<Aabb> boxes, Random& random, float reach) {
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float by = uniform(random, -reach, reach);
      box.min[axis] += by;
      box.max[axis] += by;
    }
  }
  return boxes;
}

// The other end points of `before` that those of a body pass, in the mean over all bodies.
double counted(std::span<const Aabb> before, std::span<const Aabb> after) {
  double passed = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<float> points;
    for (const Aabb& box : before) points.insert(points.end(), {box.min[axis], box.max[axis]});
    std::ranges::sort(points);
    const auto below = [&](float x) {
      return static_cast<double>(std::ranges::lower_bound(points, x) - points.begin());
    };
    const auto passed_by = [&](float then, float now) {
      const double own = now > then ? 1 : 0;
      return std::abs(below(now) - below(then)) - own;
    };
    for (std::size_t id = 0; id < before.size(); ++id) {
      passed += passed_by(before[id].min[axis], after[id].min[axis]) +
                passed_by(before[id].max[axis], after[id].max[axis]);
    }
  }
  return passed / static_cast<double>(before.size());
}

TEST(EndpointPasses, AreAboutAsManyAsCounted) {
  Random random(5);
  int near = 0, far = 0;
  for (const std::size_t bodies : {300u, 5'000u}) {
    for (const float reach : {0.0001f, 0.003f, 0.05f, 0.8f}) {
      SCOPED_TRACE(testing::Message() << bodies << " bodies, reach " << reach);
      const std::vector<Aabb> before = uniform_boxes(random, bodies, 0.1f);
      const std::vector<Aabb> after = shifted(before, random, reach);
      EndpointPasses passes;
      passes.sample(before);
      passes.note(before, all_of(before));
      const auto motion = passes.motion(after, bodies);
      ASSERT_TRUE(motion);
      const double truth = counted(before, after);
      EXPECT_GT(motion->passes, truth / 2);
      EXPECT_LT(motion->passes, truth * 2);
      EXPECT_EQ(motion->axes, 3);
      (truth < 2 ? near : far) += 1;
    }
  }
  EXPECT_GT(near, 0);
  EXPECT_GT(far, 3);
}

TEST(EndpointPasses, AreThoseOfBodiesThatHaveMoved) {
  Random random(6);
  const std::vector<Aabb> before = uniform_boxes(random, 400, 0.1f);
  EndpointPasses passes;
  passes.sample(before);
  EXPECT_FALSE(passes.motion(before, 400));  // none is noted
  passes.note(before, {});
  EXPECT_FALSE(passes.motion(before, 400));
  passes.note(before, Ids{7, 9});
  EXPECT_FALSE(passes.motion(before, 400));  // none has moved
  std::vector<Aabb> after = before;
  after[7].max[1] += 0.25f;
  const auto one = passes.motion(after, 400);
  ASSERT_TRUE(one);
  EXPECT_GT(one->passes, 0);
  EXPECT_EQ(one->axes, 1);
  EXPECT_EQ(one->leaving, 1);
  after[9] = Aabb::empty();  // it has gone
  const auto still_one = passes.motion(after, 400);
  ASSERT_TRUE(still_one);
  EXPECT_EQ(still_one->passes, one->passes);
  after[7] = Aabb::empty();
  EXPECT_FALSE(passes.motion(after, 400));
}

// A box that moves by a twentieth of its side leaves a margin of a tenth in every other frame.
TEST(EndpointPasses, ComeWithHowOftenBodiesLeaveABoxAroundThem) {
  const std::vector<Aabb> boxes = {{{0, 0, 0}, {1, 2, 4}}, {{0, 0, 0}, {0, 0, 0}}};
  EndpointPasses passes;
  passes.sample(boxes);
  const auto leaving = [&](std::uint32_t id, float way) {
    passes.note(boxes, Ids{id});
    std::vector<Aabb> after = boxes;
    after[id].min[0] += way;
    after[id].max[0] += way;
    return passes.motion(after, 2)->leaving;
  };
  EXPECT_NEAR(leaving(0, 0.2f), 0.5, 1e-6);
  EXPECT_NEAR(leaving(0, -0.2f), 0.5, 1e-6);
  EXPECT_EQ(leaving(0, 0.0001f), 0.125);
  EXPECT_EQ(leaving(0, 3), 1);
  EXPECT_EQ(leaving(1, 0.0001f), 1);
}

TEST(EndpointPasses, BearAnyBoxes) {
  constexpr float most = std::numeric_limits<float>::max();
  const Aabb all{{-most, -most, -most}, {most, most, most}};
  const Aabb point{{1, 1, 1}, {1, 1, 1}};
  const std::vector<std::vector<Aabb>> sets = {
      {},
      {Aabb::empty(), Aabb::empty()},
      {point},
      std::vector<Aabb>(500, point),
      {all, point, all, Aabb::empty()},
  };
  for (const std::vector<Aabb>& boxes : sets) {
    SCOPED_TRACE(boxes.size());
    EndpointPasses passes;
    passes.sample(boxes);
    EXPECT_GE(passes.overlapping(), 0);
    EXPECT_LE(passes.overlapping(), 1);
    Ids present;
    for (std::uint32_t id = 0; id < boxes.size(); ++id) {
      if (!boxes[id].is_empty()) present.push_back(id);
    }
    passes.note(boxes, present);
    EXPECT_FALSE(passes.motion(boxes, boxes.size()));
    const std::vector<Aabb> moved(boxes.size(), Aabb{{-2, 0, 1}, {-1, 2, most}});
    const auto motion = passes.motion(moved, boxes.size());
    ASSERT_EQ(motion.has_value(), !present.empty());
    if (!motion) continue;
    EXPECT_GE(motion->passes, 0);
    EXPECT_LE(motion->passes, 12 * static_cast<double>(boxes.size()));
    EXPECT_GE(motion->leaving, 0.125);
    EXPECT_LE(motion->leaving, 1);
  }
}

TEST(EndpointPasses, TakeTheShareOfPairsThatOverlapOnTheBestAxis) {
  Random random(7);
  std::vector<Aabb> boxes = uniform_boxes(random, 2'000, 0.1f);
  EndpointPasses passes;
  passes.sample(boxes);
  // Two intervals of lengths up to a tenth overlap where their minima are no further apart.
  EXPECT_GT(passes.overlapping(), 0.04);
  EXPECT_LT(passes.overlapping(), 0.16);
  for (Aabb& box : boxes) box.min[0] = box.min[1] = 0, box.max[0] = box.max[1] = 1;
  passes.sample(boxes);
  EXPECT_LT(passes.overlapping(), 0.16);
  for (Aabb& box : boxes) box.min[2] = 0, box.max[2] = 1;
  passes.sample(boxes);
  EXPECT_EQ(passes.overlapping(), 1);
}

}  // namespace
}  // namespace touchstone
