#include <thread>

#include "tests/algorithms/peers/broad_phase_frames.h"
#include "tests/algorithms/peers/peer_test.h"

namespace touchstone {
namespace {

class OdeBroadPhaseTest : public PeerTest<registry::find<BroadPhaseEntry>> {};

// ODE aborts where the cell of a coordinate is beyond an int.
TEST_P(OdeBroadPhaseTest, BearsDustFarAway) {
  std::vector<Aabb> boxes = {{{-1e-20F, 0, 0}, {1e-20F, 1e-20F, 1e-20F}},
                             {{0, 0, 0}, {1e-20F, 1e-20F, 1e-20F}}};
  Executor executor(1);
  const auto algorithm = entry_->make(executor);
  algorithm->build(boxes);
  EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(boxes));
  std::vector<Aabb> far = boxes;
  far[1] = {{1e30F, -3e38F, 1e30F}, {1e30F, 3e38F, 1e30F}};
  far.push_back(far[1]);
  const std::vector<std::uint32_t> moved = {1};
  const std::vector<std::uint32_t> inserted = {2};
  algorithm->update({far, moved, inserted, {}});
  EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(far));
}

// ODE's hash loses pairs where the address of a cell changes sign: at any place, by the level.
TEST_P(OdeBroadPhaseTest, KeepsPairsAroundTheOrigin) {
  std::mt19937_64 random(11);
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  Executor executor(1);
  const auto algorithm = entry_->make(executor);
  std::size_t pairs = 0;
  for (const float scale : {1e-3F, 0.1F, 1.0F, 30.0F}) {
    for (const float smallest : {0.0F, 0.01F, 0.3F}) {
      std::vector<Aabb> boxes(300);
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const float side = i % 8 == 0 ? 0.5F : smallest;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          boxes[i].min[axis] = scale * between(-0.4F, 0.3F);
          boxes[i].max[axis] = boxes[i].min[axis] + scale * side;
        }
      }
      const std::vector<IndexPair> truth = closed_pairs(boxes);
      pairs += truth.size();
      algorithm->build(boxes);
      EXPECT_EQ(sorted_pairs(*algorithm) == truth, true) << scale << ' ' << smallest;
    }
  }
  EXPECT_GT(pairs, 10'000U);
}

// The library has globals.
TEST_P(OdeBroadPhaseTest, WorksInThreadsOfItsOwn) {
  std::vector<Aabb> boxes = Frames({.name = "moving", .count = 300}, 1).boxes();
  const std::vector<IndexPair> truth = closed_pairs(boxes);
  EXPECT_GT(truth.size(), 20U);
  std::vector<std::thread> threads;
  std::array<bool, 4> right{};
  for (bool& mine : right) {
    threads.emplace_back([&] {
      Executor executor(1);
      mine = true;
      for (int round = 0; round < 10; ++round) {
        const auto algorithm = entry_->make(executor);
        algorithm->build(boxes);
        mine = mine && sorted_pairs(*algorithm) == truth;
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const bool mine : right) EXPECT_TRUE(mine);
}

INSTANTIATE_TEST_SUITE_P(Ode, OdeBroadPhaseTest,
                         testing::Values("ode-hash", "ode-quadtree", "ode-sap"), peer_test_name);

// Its table of pairs has a limit, beyond which ODE aborts.
TEST(OdeHash, SaysWhatIsTooMuchForIt) {
  const BroadPhaseEntry& entry = *registry::find<BroadPhaseEntry>("ode-hash");
  if (!is_built(entry.info)) GTEST_SKIP() << entry.info.reason;
  std::vector<Aabb> boxes(std::size_t{1} << 17);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const auto at = static_cast<float>(i);
    boxes[i] = {{at, 0, 0}, {at + 0.5F, 1, 1}};
  }
  Executor executor(1);
  const auto algorithm = entry.make(executor);
  PairSink sink;
  algorithm->build(boxes);
  EXPECT_EQ(algorithm->find_pairs(sink), Status::capacity);
  const std::vector<Aabb> fewer(boxes.begin(), boxes.begin() + 100);
  algorithm->build(fewer);
  EXPECT_EQ(sorted_pairs(*algorithm), closed_pairs(fewer));
}

}  // namespace
}  // namespace touchstone
