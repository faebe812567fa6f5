// No frame of the dynamic BVH does much more than the others, once it keeps its pairs. What it puts
// into its structure is counted, and no time is taken.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

struct PlacedInFrames {
  std::int64_t median, most;
};

// `reach` is a share of the bodies' sides; one in a hundred of the bodies moves in a frame.
PlacedInFrames placed_in_frames(std::size_t bodies, float reach, float teleported, int frames) {
  Random random(31);
  const float side = std::cbrt(0.8f / static_cast<float>(bodies));
  std::vector<Aabb> boxes = uniform_boxes(random, bodies, side);
  Executor executor(1);
  const auto algorithm = registry::find<BroadPhaseEntry>("dynamic-bvh")->make(executor);
  PairSink sink;
  algorithm->build(boxes);
  algorithm->find_pairs(sink);
  std::vector<std::int64_t> placed;
  std::vector<std::uint32_t> moved;
  constexpr int first = 5;  // the frames before see what moves, and load fat boxes
  for (int frame = 0; frame < frames + first; ++frame) {
    moved.clear();
    for (std::uint32_t id = 0; id < bodies; ++id) {
      if (uniform(random, 0, 1) >= 0.01f) continue;
      moved.push_back(id);
      Aabb& box = boxes[id];
      if (uniform(random, 0, 1) < teleported) {
        box = uniform_boxes(random, 1, side)[0];
        continue;
      }
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float by = side * uniform(random, -reach, reach);
        box.min[axis] += by;
        box.max[axis] += by;
      }
    }
    algorithm->update({boxes, moved, {}, {}});
    EXPECT_EQ(algorithm->find_pairs(sink), Status::ok);
    if (frame >= first) placed.push_back(algorithm->work().placed);
  }
  std::ranges::sort(placed);
  return {placed[placed.size() / 2], placed.back()};
}

TEST(FramesOfTheDynamicBvh, AreAboutEquallyLong) {
  for (const std::size_t bodies : {3'000u, 20'000u / one_in}) {
    SCOPED_TRACE(bodies);
    const PlacedInFrames wild = placed_in_frames(bodies, 0.5f, 0, drawn(600, 200));
    EXPECT_GT(wild.median, static_cast<std::int64_t>(bodies / 100));
    EXPECT_LT(wild.most, 5 * wild.median);
    const PlacedInFrames leaps = placed_in_frames(bodies, 0.03f, 0.3f, drawn(600, 200));
    EXPECT_GT(leaps.median, static_cast<std::int64_t>(bodies / 200));
    EXPECT_LT(leaps.most, 5 * leaps.median);
  }
}

// Where hardly anything is placed, no frame comes near to all bodies.
TEST(FramesOfTheDynamicBvh, AreShortWhereLittleMoves) {
  const PlacedInFrames calm = placed_in_frames(20'000, 0.03f, 0, drawn(600, 60));
  EXPECT_LT(calm.median, 1'000);
  EXPECT_LT(calm.most, 2'000);
}

}  // namespace
}  // namespace touchstone
