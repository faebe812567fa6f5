// Broad phases that keep their pairs from frame to frame, on long random histories.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "algorithms/broad_phase/sweep_and_prune/pair_set.h"
#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

struct History {
  std::string name;
  std::size_t bodies;
  int frames;
  float side;
  // Shares of the bodies in a frame, and how far those that move do.
  float moved, reach;
  float teleported = 0, inserted = 0, removed = 0;
  float step = 0;  // coordinates are multiples of it, so that many boxes just touch
};

class Bodies {
 public:
  Bodies(const History& history, std::uint64_t seed) : history_(history), random_(seed) {
    for (std::size_t i = 0; i < history.bodies; ++i) boxes_.push_back(fresh());
  }

  std::span<const Aabb> boxes() const { return boxes_; }

  FrameChange next() {
    moved_.clear(), inserted_.clear(), removed_.clear();
    for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
      const Aabb before = boxes_[id];
      change(boxes_[id]);
      if (boxes_[id] == before) continue;
      (before.is_empty() ? inserted_ : boxes_[id].is_empty() ? removed_ : moved_).push_back(id);
    }
    // Now and then a new id.
    if (history_.inserted > 0 && boxes_.size() < history_.bodies * 3 / 2) {
      inserted_.push_back(static_cast<std::uint32_t>(boxes_.size()));
      boxes_.push_back(fresh());
    }
    return {boxes_, moved_, inserted_, removed_};
  }

 private:
  float snap(float x) const {
    return history_.step > 0 ? history_.step * std::round(x / history_.step) : x;
  }
  Aabb fresh() {
    Aabb box = uniform_boxes(random_, 1, history_.side)[0];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = snap(box.min[axis]);
      box.max[axis] = std::max(box.min[axis], snap(box.max[axis]));
    }
    return box;
  }
  void change(Aabb& box) {
    float dice = uniform(random_, 0, 1);
    if (box.is_empty()) {
      if (dice < history_.inserted) box = fresh();
      return;
    }
    if ((dice -= history_.removed) < 0) {
      box = Aabb::empty();
    } else if ((dice -= history_.teleported) < 0) {
      box = fresh();
    } else if ((dice -= history_.moved) < 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float by = snap(uniform(random_, -history_.reach, history_.reach));
        const float size = box.max[axis] - box.min[axis];
        box.min[axis] = snap(std::clamp(box.min[axis] + by, 0.0f, 1.0f));
        box.max[axis] = std::max(box.min[axis], snap(box.min[axis] + size));
      }
    }
  }

  History history_;
  Random random_;
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

const History histories[] = {
    {.name = "walk", .bodies = 300, .frames = 300, .side = 0.2f, .moved = 1, .reach = 0.004f},
    {.name = "some walk",
     .bodies = 300,
     .frames = 300,
     .side = 0.2f,
     .moved = 0.05f,
     .reach = 0.02f},
    {.name = "few jump",
     .bodies = 300,
     .frames = 300,
     .side = 0.2f,
     .moved = 0.03f,
     .reach = 0.01f,
     .teleported = 0.01f},
    {.name = "come and go",
     .bodies = 250,
     .frames = 300,
     .side = 0.2f,
     .moved = 0.02f,
     .reach = 0.01f,
     .teleported = 0.003f,
     .inserted = 0.02f,
     .removed = 0.01f},
    {.name = "all walk, some come and go",
     .bodies = 250,
     .frames = 200,
     .side = 0.2f,
     .moved = 1,
     .reach = 0.002f,
     .inserted = 0.05f,
     .removed = 0.01f},
    {.name = "on a lattice",
     .bodies = 250,
     .frames = 300,
     .side = 0.25f,
     .moved = 0.04f,
     .reach = 0.07f,
     .teleported = 0.002f,
     .inserted = 0.02f,
     .removed = 0.01f,
     .step = 0.0625f},
    {.name = "all on a lattice",
     .bodies = 150,
     .frames = 200,
     .side = 0.25f,
     .moved = 0.5f,
     .reach = 0.04f,
     .step = 0.0625f},
    {.name = "in turns", .bodies = 200, .frames = 300, .side = 0.2f, .moved = 0.06f, .reach = 0.3f},
};

class LongHistories : public testing::TestWithParam<const BroadPhaseEntry*> {};

TEST_P(LongHistories, AreFollowed) {
  for (const History& history : histories) {
    SCOPED_TRACE(history.name);
    Executor narrow(1), wide(3);
    const auto algorithm = GetParam()->make(narrow);
    const auto twin = GetParam()->make(wide);
    PairSink sink, twin_sink;
    Bodies bodies(history, 11);
    algorithm->build(bodies.boxes());
    twin->build(bodies.boxes());
    std::vector<IndexPair> before;
    std::size_t came = 0, went = 0;
    for (int frame = 0; frame < drawn(history.frames, 30); ++frame) {
      if (frame > 0) {
        const FrameChange change = bodies.next();
        algorithm->update(change);
        twin->update(change);
      }
      ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
      ASSERT_EQ(twin->find_pairs(twin_sink), Status::ok);
      const auto truth = true_pairs(bodies.boxes());
      ASSERT_EQ(sorted(sink) == truth, true) << frame;
      ASSERT_EQ(sink.gather() == twin_sink.gather(), true) << frame;
      std::vector<IndexPair> difference;
      std::ranges::set_difference(truth, before, std::back_inserter(difference));
      came += difference.size();
      const std::size_t new_ones = difference.size();
      std::ranges::set_difference(before, truth, std::back_inserter(difference));
      went += difference.size() - new_ones;
      before = truth;
    }
    EXPECT_GT(came, 500u / one_in);
    EXPECT_GT(went, 250u / one_in);
  }
}

std::vector<const BroadPhaseEntry*> keepers() {
  std::vector<const BroadPhaseEntry*> list;
  for (const char* name : {"sweep-and-prune", "kd-tree"}) {
    list.push_back(registry::find<BroadPhaseEntry>(name));
  }
  return list;
}
INSTANTIATE_TEST_SUITE_P(Registry, LongHistories, testing::ValuesIn(keepers()),
                         [](const auto& param) {
                           std::string name = param.param->info.name;
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST(PairSet, IsASet) {
  Random random(5);
  PairSet set;
  std::set<IndexPair> truth;
  std::size_t inserted = 0, repeated = 0, erased = 0, missed = 0;
  for (int step = 0; step < 60'000; ++step) {
    // It grows first, and shrinks then.
    const bool grows = uniform(random, 0, 1) < (step < 30'000 ? 0.6f : 0.35f);
    const auto a = static_cast<std::uint32_t>(uniform(random, 0, 120));
    const auto b = static_cast<std::uint32_t>(uniform(random, 121, 240));
    if (grows) {
      (truth.insert({a, b}).second ? inserted : repeated) += 1;
      set.insert({a, b});
    } else {
      (truth.erase({a, b}) == 1 ? erased : missed) += 1;
      set.erase({a, b});
    }
    if (step % 5'000 == 0) {
      std::vector<IndexPair> found(set.pairs().begin(), set.pairs().end());
      std::ranges::sort(found);
      EXPECT_TRUE(std::ranges::equal(found, truth)) << step;
      const auto odd = [](IndexPair pair) { return (pair.a * 7 + pair.b) % 5 == 0; };
      set.erase_if(odd);
      std::erase_if(truth, odd);
      EXPECT_EQ(set.pairs().size(), truth.size());
    }
  }
  for (const std::size_t often : {inserted, repeated, erased, missed}) EXPECT_GT(often, 2'000u);
  // Filled from outside, the table is made anew.
  const std::vector<IndexPair> fresh = {{1, 2}, {3, 4}, {5, 6}};
  std::ranges::copy(fresh, set.refill(3).begin());
  set.erase({1, 2});
  set.insert({3, 4});
  EXPECT_EQ(set.pairs().size(), 2u);
  EXPECT_EQ(set.pairs()[0], (IndexPair{5, 6}));
}

}  // namespace
}  // namespace touchstone
