#include "tests/algorithms/peers/broad_phase_frames.h"
#include "tests/algorithms/peers/peer_test.h"

namespace touchstone {
namespace {

// Few changes at a time go into the tree as it is, and in the end it is loaded anew.
TEST(BoostRtree, FollowsFewChangesForLong) {
  const BroadPhaseEntry& entry = *registry::find<BroadPhaseEntry>("boost-rtree");
  if (!is_built(entry.info)) GTEST_SKIP() << entry.info.reason;
  Frames frames({.name = "few", .count = 400, .moving = 0.01, .churn = 0.01}, 3);
  Executor executor(1);
  const auto algorithm = entry.make(executor);
  algorithm->build(frames.boxes());
  EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(frames.boxes()));
  for (int frame = 0; frame < 60; ++frame) {
    SCOPED_TRACE(frame);
    const FrameChange change = frames.next();
    algorithm->update(change);
    EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(frames.boxes()));
  }
}

}  // namespace
}  // namespace touchstone
