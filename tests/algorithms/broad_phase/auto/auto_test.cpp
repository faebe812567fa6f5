// What auto chooses, that it does not change its mind all the time, and that its answers do not
// show when it does.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <string>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using Ids = std::vector<std::uint32_t>;
using Pairs = std::vector<IndexPair>;

bool is_flat(const Aabb& box) {
  int axes = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) axes += box.min[axis] == box.max[axis] ? 1 : 0;
  return axes >= 2;
}

class AutomaticChoice : public testing::TestWithParam<bool> {
 protected:
  // The choice as its work and its structure give it away.
  std::string chosen() const {
    if (algorithm_->work().placed >= 0) return "dynamic-bvh";
    const auto structure = algorithm_->structure();
    if (structure.empty()) return "nothing to show";
    if (std::ranges::all_of(structure, [](const auto& each) { return is_flat(each.box); })) {
      return "sweep-and-prune";
    }
    const bool is_list =
        std::ranges::all_of(structure, [](const StructureBox& box) { return box.level == 0; });
    return is_list && structure.size() == bodies() ? "verlet-list" : "packed-rtree";
  }
  std::size_t bodies() const {
    return static_cast<std::size_t>(
        std::ranges::count_if(boxes_, [](const Aabb& box) { return !box.is_empty(); }));
  }

  void build(std::size_t count, float side) {
    boxes_ = uniform_boxes(random_, count, side);
    algorithm_->build(boxes_);
    ask();
  }

  // Frames in which this share of the bodies moves, always the same ones; returns how often the
  // choice changed.
  int play(int frames, float share, float reach = 0.0005f) {
    int changes = 0;
    for (int frame = 0; frame < frames; ++frame) {
      moved_.clear();
      const auto last = static_cast<std::uint32_t>(share * static_cast<float>(boxes_.size()));
      for (std::uint32_t id = 0; id < last; ++id) {
        if (boxes_[id].is_empty()) continue;
        moved_.push_back(id);
        for (std::size_t axis = 0; axis < 3; ++axis) {
          float by = uniform(random_, -reach, reach);
          // They stay where the others are.
          if (boxes_[id].min[axis] < 0) by = std::abs(by);
          if (boxes_[id].min[axis] > 1) by = -std::abs(by);
          boxes_[id].min[axis] += by;
          boxes_[id].max[axis] += by;
        }
      }
      changes += update({}, {}) ? 1 : 0;
    }
    return changes;
  }
  // A frame in which these come, at new places, and those go.
  void replace(const Ids& inserted, const Ids& removed) {
    moved_.clear();
    for (const std::uint32_t id : removed) boxes_[id] = Aabb::empty();
    for (const std::uint32_t id : inserted) {
      if (id >= boxes_.size()) boxes_.resize(id + 1, Aabb::empty());
      boxes_[id] = uniform_boxes(random_, 1, 0.1f)[0];
    }
    update(inserted, removed);
  }
  // Returns true if the choice has changed.
  bool update(const Ids& inserted, const Ids& removed) {
    algorithm_->update({boxes_, moved_, inserted, removed});
    ask();
    const std::string now = chosen();
    const bool is_new = now != last_;
    if (is_new) ++taken_[now];
    last_ = now;
    return is_new;
  }

  void ask() {
    const Pairs truth = true_pairs(boxes_);
    ++frame_;
    if (!asks_changes_ || frame_ % 50 == 0) {
      ASSERT_EQ(algorithm_->find_pairs(sink_), Status::ok);
      ASSERT_EQ(sorted(sink_) == truth, true) << frame_;
    }
    if (frame_ % 37 == 0) {
      Pairs of_moved;
      std::ranges::copy_if(truth, std::back_inserter(of_moved), [&](IndexPair pair) {
        return std::ranges::binary_search(moved_, pair.a) ||
               std::ranges::binary_search(moved_, pair.b);
      });
      ASSERT_EQ(algorithm_->find_pairs_of(moved_, sink_), Status::ok);
      ASSERT_EQ(sorted(sink_) == of_moved, true) << frame_;
    }
    // Now and then a frame is left out, the one in which the choice changes among them.
    if (!asks_changes_ || frame_ % 5 == 0) return;
    ASSERT_EQ(algorithm_->find_changes(sink_, ended_), Status::ok);
    Pairs began, ended;
    std::ranges::set_difference(truth, told_, std::back_inserter(began));
    std::ranges::set_difference(told_, truth, std::back_inserter(ended));
    ASSERT_EQ(sink_.gather() == began, true) << frame_;
    ASSERT_EQ(ended_.gather() == ended, true) << frame_;
    changes_ += began.size() + ended.size();
    told_ = truth;
  }

  Random random_{17};
  Executor executor_{1};
  std::unique_ptr<BroadPhase> algorithm_ = registry::find<BroadPhaseEntry>("auto")->make(executor_);
  std::vector<Aabb> boxes_;
  Ids moved_;
  PairSink sink_, ended_;
  bool asks_changes_ = GetParam();
  Pairs told_;
  std::size_t changes_ = 0;
  int frame_ = 0;
  std::string last_;
  std::map<std::string, int> taken_;  // how often each took over
};

INSTANTIATE_TEST_SUITE_P(Asked, AutomaticChoice, testing::Bool(),
                         [](const auto& param) { return param.param ? "changes" : "pairs"; });

TEST_P(AutomaticChoice, FollowsWhatTheFramesAreLike) {
  for (const float side : {0.05f, 0.2f}) {  // with few pairs, and with many
    SCOPED_TRACE(side);
    const bool has_few_pairs = side < 0.1f;
    build(600, side);
    play(1, 0.005f);
    EXPECT_EQ(chosen(), "dynamic-bvh");
    play(24, 1);
    EXPECT_EQ(chosen(), has_few_pairs ? "verlet-list" : "packed-rtree");
    play(24, 0);
    EXPECT_EQ(chosen(), "dynamic-bvh");
  }
}

TEST_P(AutomaticChoice, IsMadeLessAndLessOften) {
  build(600, 0.1f);
  int changes = 0;
  for (int round = 0; round < drawn(40, 20); ++round) {
    changes += play(5, 1);
    changes += play(5, 0);
  }
  EXPECT_GT(changes, 1);
  EXPECT_LT(changes, 8);
}

// End points that pass few others want sweep and prune, and those that pass many the
// dynamic BVH.
TEST_P(AutomaticChoice, FollowsHowFarBodiesMove) {
  build(600, 0.15f);
  play(500, 0.02f);
  EXPECT_EQ(chosen(), "sweep-and-prune");
  play(400, 0.02f, 0.3f);
  EXPECT_EQ(chosen(), "dynamic-bvh");
  EXPECT_EQ(taken_["sweep-and-prune"], 1);
}

TEST_P(AutomaticChoice, DoesNotShowInTheAnswers) {
  build(500, 0.2f);
  for (int round = 0; round < 2; ++round) {
    play(400, 0.02f);
    play(20, 1, 0.01f);
    Ids come, go;
    const auto slots = static_cast<std::uint32_t>(boxes_.size());
    for (std::uint32_t id = slots; id < slots + 40; ++id) come.push_back(id);
    replace(come, {});
    play(40, 0.02f);
    for (std::uint32_t id = 20; id < slots; id += 3) go.push_back(id);
    replace({}, go);
    play(40, 0.02f);
    replace(go, {});
    play(400, 0.02f, 0.002f);
    Ids all(boxes_.size());
    std::iota(all.begin(), all.end(), 0U);
    replace({}, all);
    play(3, 0.02f);
    replace(all, {});
    play(10, 1, 0.01f);
  }
  EXPECT_GT(taken_["sweep-and-prune"], 1);
  EXPECT_GT(taken_["dynamic-bvh"], 1);
  EXPECT_GT(taken_["packed-rtree"] + taken_["verlet-list"], 1);
  EXPECT_EQ(changes_ > 2'000, asks_changes_);
}

}  // namespace
}  // namespace touchstone
