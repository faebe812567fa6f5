#include "tests/algorithms/peers/broad_phase_frames.h"
#include "tests/algorithms/peers/peer_test.h"

namespace touchstone {
namespace {

class EmbreeBroadPhaseTest : public PeerTest<registry::find<BroadPhaseEntry>> {};

// Several threads, and instances of other widths beside it.
TEST_P(EmbreeBroadPhaseTest, FindsTheSamePairsAtEveryWidth) {
  Frames frames({.name = "moving", .count = 3000, .size = 0.8F, .speed = 0.05F}, 5);
  std::vector<std::unique_ptr<Executor>> executors;
  std::vector<std::unique_ptr<BroadPhase>> algorithms;
  for (const int width : {1, 2, 3, 1}) {
    executors.push_back(std::make_unique<Executor>(width));
    algorithms.push_back(entry_->make(*executors.back()));
  }
  for (const auto& algorithm : algorithms) algorithm->build(frames.boxes());
  for (int frame = 0; frame < 4; ++frame) {
    const std::vector<IndexPair> truth = closed_pairs(frames.boxes());
    EXPECT_GT(truth.size(), 500U);
    for (const auto& algorithm : algorithms) {
      PairSink sink;
      ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
      EXPECT_EQ(sorted_pairs(*algorithm), truth);
      EXPECT_GE(algorithm->work().candidates, static_cast<std::int64_t>(2 * truth.size()));
    }
    const FrameChange change = frames.next();
    for (const auto& algorithm : algorithms) algorithm->update(change);
  }
}

// The world grows beyond what Embree takes, and shrinks again.
TEST_P(EmbreeBroadPhaseTest, FollowsAWorldThatGrows) {
  const std::vector<Aabb> small = {{{0, 0, 0}, {1, 1, 1}}, {{1, 1, 1}, {2, 2, 2}}};
  const std::vector<Aabb> wide = {{{0, 0, 0}, {3e38F, 1, 1}}, {{2e38F, 1, 1}, {2e38F, 2, 2}}};
  const std::vector<std::uint32_t> moved = {0, 1};
  Executor executor(1);
  const auto algorithm = entry_->make(executor);
  algorithm->build(small);
  EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(small));
  for (int round = 0; round < 2; ++round) {
    algorithm->update({wide, moved, {}, {}});
    EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(wide));
    algorithm->update({small, moved, {}, {}});
    EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(small));
  }
}

INSTANTIATE_TEST_SUITE_P(Embree, EmbreeBroadPhaseTest,
                         testing::Values("embree-low", "embree-refit"), peer_test_name);

}  // namespace
}  // namespace touchstone
