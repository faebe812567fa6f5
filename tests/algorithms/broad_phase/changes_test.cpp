// Pairs that began and ended, of every broad phase, against the difference of the true pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

// Shares of the bodies in a frame, and how far those that move do.
struct Unrest {
  std::string name;
  float moved = 0, reach = 0, teleported = 0, inserted = 0, removed = 0;
};

const Unrest unrests[] = {
    {.name = "at rest"},
    {.name = "a few move", .moved = 0.03f, .reach = 0.02f},
    {.name = "a few go far", .moved = 0.03f, .reach = 0.2f},
    {.name = "half moves", .moved = 0.5f, .reach = 0.004f},
    {.name = "all move", .moved = 1, .reach = 0.05f},
    {.name = "teleports", .moved = 0.02f, .reach = 0.01f, .teleported = 0.01f},
    {.name = "churn",
     .moved = 0.03f,
     .reach = 0.03f,
     .teleported = 0.005f,
     .inserted = 0.01f,
     .removed = 0.01f},
    {.name = "much churn", .moved = 0.1f, .reach = 0.02f, .inserted = 0.2f, .removed = 0.1f},
};

class UnrestfulBodies {
 public:
  explicit UnrestfulBodies(std::size_t count) : boxes_(uniform_boxes(random_, count, 0.15f)) {}

  std::span<const Aabb> boxes() const { return boxes_; }
  FrameChange next(const Unrest& unrest) {
    moved_.clear(), inserted_.clear(), removed_.clear();
    for (std::uint32_t id = 0; id < boxes_.size(); ++id) {
      const Aabb before = boxes_[id];
      change(boxes_[id], unrest);
      if (boxes_[id] == before) continue;
      (before.is_empty() ? inserted_ : boxes_[id].is_empty() ? removed_ : moved_).push_back(id);
    }
    if (unrest.inserted > 0) {  // and a new id
      inserted_.push_back(static_cast<std::uint32_t>(boxes_.size()));
      boxes_.push_back(uniform_boxes(random_, 1, 0.15f)[0]);
    }
    return {boxes_, moved_, inserted_, removed_};
  }

 private:
  void change(Aabb& box, const Unrest& unrest) {
    float dice = uniform(random_, 0, 1);
    if (box.is_empty()) {
      if (dice < unrest.inserted) box = uniform_boxes(random_, 1, 0.15f)[0];
    } else if ((dice -= unrest.removed) < 0) {
      box = Aabb::empty();
    } else if ((dice -= unrest.teleported) < 0) {
      box = uniform_boxes(random_, 1, 0.15f)[0];
    } else if ((dice -= unrest.moved) < 0) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float by = uniform(random_, -unrest.reach, unrest.reach);
        box.min[axis] += by;
        box.max[axis] = std::max(box.min[axis], box.max[axis] + by);
      }
    }
  }

  Random random_{61};
  std::vector<Aabb> boxes_;
  std::vector<std::uint32_t> moved_, inserted_, removed_;
};

// The true pairs of the last call, and the changes since then.
class TrueChanges {
 public:
  std::vector<IndexPair> began, ended;
  std::size_t all_began = 0, all_ended = 0;

  void call(std::span<const Aabb> boxes) {
    std::vector<IndexPair> now = true_pairs(boxes);
    began.clear(), ended.clear();
    std::ranges::set_difference(now, before_, std::back_inserter(began));
    std::ranges::set_difference(before_, now, std::back_inserter(ended));
    all_began += began.size();
    all_ended += ended.size();
    before_ = std::move(now);
  }

 private:
  std::vector<IndexPair> before_;
};

class Changes : public testing::TestWithParam<const BroadPhaseEntry*> {
 protected:
  void SetUp() override {
    if (!is_built(GetParam()->info)) GTEST_SKIP() << "not built: " << GetParam()->info.reason;
  }
  static void expect_changes(BroadPhase& algorithm, const TrueChanges& truth) {
    PairSink began, ended;
    ASSERT_EQ(algorithm.find_changes(began, ended), Status::ok);
    ASSERT_EQ(began.gather() == truth.began, true) << began.size() << " of " << truth.began.size();
    ASSERT_EQ(ended.gather() == truth.ended, true) << ended.size() << " of " << truth.ended.size();
  }
};

INSTANTIATE_TEST_SUITE_P(Registry, Changes, testing::ValuesIn([] {
                           std::vector<const BroadPhaseEntry*> list;
                           for (const BroadPhaseEntry& entry : broad_phases()) {
                             list.push_back(&entry);
                           }
                           return list;
                         }()),
                         [](const auto& param) {
                           std::string name = param.param->info.name;
                           std::ranges::replace_if(
                               name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

// Each list ascends, so two widths that are right write the same.
TEST_P(Changes, AreThoseOfTheTrueChanges) {
  for (const int width : {1, 2}) {
    Executor executor(width);
    const auto algorithm = GetParam()->make(executor);
    UnrestfulBodies bodies(400);
    TrueChanges truth;
    algorithm->build(bodies.boxes());
    truth.call(bodies.boxes());
    ASSERT_NO_FATAL_FAILURE(expect_changes(*algorithm, truth));
    EXPECT_GT(truth.began.size(), 100u);
    for (const Unrest& unrest : unrests) {
      SCOPED_TRACE(unrest.name);
      for (int frame = 0; frame < drawn(16, 5); ++frame) {
        algorithm->update(bodies.next(unrest));
        truth.call(bodies.boxes());
        ASSERT_NO_FATAL_FAILURE(expect_changes(*algorithm, truth)) << frame;
      }
    }
    EXPECT_GT(truth.all_began, 3'000u / one_in);
    EXPECT_GT(truth.all_ended, 3'000u / one_in);
  }
}

// Frames without a call add up, also over a build; find_pairs may come between.
TEST_P(Changes, AreThoseSinceTheLastCall) {
  Executor executor(2);
  const auto algorithm = GetParam()->make(executor);
  UnrestfulBodies bodies(300);
  TrueChanges truth;
  PairSink sink;
  algorithm->build(bodies.boxes());
  int step = 0, calls = 0;
  for (const Unrest& unrest : unrests) {
    SCOPED_TRACE(unrest.name);
    for (int round = 0; round < drawn(16, 5); ++round) {
      const FrameChange change = bodies.next(unrest);
      ++step;
      if (step % 37 == 0) {
        algorithm->build(bodies.boxes());
      } else {
        algorithm->update(change);
      }
      if (step % 3 != 0) {
        ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
      }
      if (step % 4 == 0 || step % 7 == 0) {
        truth.call(bodies.boxes());
        ASSERT_NO_FATAL_FAILURE(expect_changes(*algorithm, truth)) << step;
        ++calls;
        truth.call(bodies.boxes());  // nothing has changed since
        ASSERT_NO_FATAL_FAILURE(expect_changes(*algorithm, truth)) << step;
      }
      if (step % 5 == 0) {
        ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
        auto pairs = sink.gather();
        std::ranges::sort(pairs);
        ASSERT_EQ(pairs == true_pairs(bodies.boxes()), true) << step;
      }
    }
  }
  EXPECT_GT(calls, 24 / 4);
  EXPECT_GT(truth.all_began, 100u);
  EXPECT_GT(truth.all_ended, 100u);
}

}  // namespace
}  // namespace touchstone
