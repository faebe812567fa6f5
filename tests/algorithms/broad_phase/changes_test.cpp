// Pairs that began and ended, of every broad phase, against the difference of the true pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/broad_phase/unrestful_bodies.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

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
                           for (const BroadPhaseEntry& entry :
                                registry::entries<BroadPhaseEntry>()) {
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
      for (int frame = 0; frame < drawn(10, 4); ++frame) {
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
    for (int round = 0; round < drawn(10, 4); ++round) {
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
