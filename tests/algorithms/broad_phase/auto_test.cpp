// What auto chooses, and that it does not change its mind all the time.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

class AutomaticChoice : public testing::Test {
 protected:
  // The choice as its work and its structure give it away.
  std::string chosen() const {
    if (algorithm_->work().placed >= 0) return "dynamic-bvh";
    const auto structure = algorithm_->structure();
    const bool is_flat =
        std::ranges::all_of(structure, [](const StructureBox& box) { return box.level == 0; });
    return is_flat && structure.size() == boxes_.size() ? "verlet-list" : "packed-rtree";
  }
  void build(float side) {
    boxes_ = uniform_boxes(random_, 600, side);
    algorithm_->build(boxes_);
    expect_pairs();
  }
  // Frames in which this share of the bodies creeps; returns how often the choice changed.
  int play(int frames, float moved) {
    int changes = 0;
    for (int frame = 0; frame < frames; ++frame) {
      const std::string before = chosen();
      moved_.clear();
      for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
        if (uniform(random_, 0, 1) >= moved) continue;
        moved_.push_back(id);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const float by = uniform(random_, -0.0005f, 0.0005f);
          boxes_[id].min[axis] += by;
          boxes_[id].max[axis] += by;
        }
      }
      algorithm_->update({boxes_, moved_, {}, {}});
      expect_pairs();
      changes += chosen() == before ? 0 : 1;
    }
    return changes;
  }
  void expect_pairs() {
    ASSERT_EQ(algorithm_->find_pairs(sink_), Status::ok);
    auto pairs = sink_.gather();
    std::ranges::sort(pairs);
    ASSERT_EQ(pairs == true_pairs(boxes_), true);
  }

  Random random_{17};
  Executor executor_{1};
  std::unique_ptr<BroadPhase> algorithm_ = find_broad_phase("auto")->make(executor_);
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_;
  PairSink sink_;
};

TEST_F(AutomaticChoice, FollowsWhatTheFramesAreLike) {
  for (const float side : {0.05f, 0.2f}) {  // with few pairs, and with many
    SCOPED_TRACE(side);
    const bool has_few_pairs = side < 0.1f;
    build(side);
    EXPECT_EQ(chosen(), "packed-rtree");
    play(1, 0.005f);
    EXPECT_EQ(chosen(), "dynamic-bvh");
    play(24, 1);
    EXPECT_EQ(chosen(), has_few_pairs ? "verlet-list" : "packed-rtree");
    play(24, 0);
    EXPECT_EQ(chosen(), "dynamic-bvh");
  }
  build(0.05f);
  play(2, 1);
  EXPECT_EQ(chosen(), "verlet-list");
}

TEST_F(AutomaticChoice, IsMadeLessAndLessOften) {
  build(0.1f);
  int changes = 0;
  for (int round = 0; round < drawn(40, 20); ++round) {
    changes += play(5, 1);
    changes += play(5, 0);
  }
  EXPECT_GT(changes, 1);
  EXPECT_LT(changes, 8);
}

}  // namespace
}  // namespace touchstone
