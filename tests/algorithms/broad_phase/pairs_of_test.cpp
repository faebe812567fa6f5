// Pairs of some bodies and their changes, and what is done outside of the clock, of every broad
// phase, against the true pairs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <numeric>

#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/broad_phase/unrestful_bodies.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using Ids = std::vector<std::uint32_t>;
using Pairs = std::vector<IndexPair>;

Pairs true_pairs_of(const Ids& bodies, const Pairs& all) {
  Pairs pairs;
  std::ranges::copy_if(all, std::back_inserter(pairs), [&](IndexPair pair) {
    return std::ranges::binary_search(bodies, pair.a) || std::ranges::binary_search(bodies, pair.b);
  });
  return pairs;
}

Pairs without(const Pairs& from, const Pairs& what) {
  Pairs rest;
  std::ranges::set_difference(from, what, std::back_inserter(rest));
  return rest;
}

class PairsOf : public testing::TestWithParam<const BroadPhaseEntry*> {
 protected:
  void SetUp() override {
    if (!is_built(GetParam()->info)) GTEST_SKIP() << "not built: " << GetParam()->info.reason;
  }
};

INSTANTIATE_TEST_SUITE_P(Registry, PairsOf, testing::ValuesIn([] {
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

// The bodies that moved or came, few, many, none and all.
TEST_P(PairsOf, SomeBodiesAreThoseOfTheTruth) {
  for (const int width : {1, 2}) {
    Executor executor(width);
    const auto algorithm = GetParam()->make(executor);
    UnrestfulBodies bodies(400);
    PairSink sink;
    std::size_t of_fresh = 0, left_out = 0, moved_frames = 0;
    std::uint32_t step = 0;
    algorithm->build(bodies.boxes());
    const auto ask = [&](const Ids& ids, const Pairs& truth) {
      ASSERT_EQ(algorithm->find_pairs_of(ids, sink), Status::ok);
      const Pairs wanted = true_pairs_of(ids, truth);
      ASSERT_EQ(sorted(sink) == wanted, true)
          << ids.size() << " bodies: " << sink.size() << " of " << wanted.size();
      left_out += truth.size() - wanted.size();
    };
    for (const Unrest& unrest : unrests) {
      SCOPED_TRACE(unrest.name);
      for (int frame = 0; frame < drawn(6, 3); ++frame, ++step) {
        const FrameChange change = bodies.next(unrest);
        Ids fresh, some, all(change.boxes.size());
        std::ranges::merge(change.moved, change.inserted, std::back_inserter(fresh));
        std::iota(all.begin(), all.end(), 0U);
        const std::uint32_t every = step % 2 == 0 ? 3 : 40;
        for (std::uint32_t id = step % every; id < all.size(); id += every) some.push_back(id);
        algorithm->update(change);
        const Pairs truth = true_pairs(change.boxes);
        if (step % 3 == 0) {
          ASSERT_EQ(algorithm->find_pairs(sink), Status::ok);
          ASSERT_EQ(sorted(sink) == truth, true);
        }
        for (const Ids& ids : {fresh, some, Ids{}, all}) ASSERT_NO_FATAL_FAILURE(ask(ids, truth));
        of_fresh += true_pairs_of(fresh, truth).size();
        moved_frames += fresh.empty() ? 0 : 1;
      }
    }
    EXPECT_GT(moved_frames, 10u);
    EXPECT_GT(of_fresh, 1'000u / one_in);
    EXPECT_GT(left_out, 1'000u / one_in);
  }
}

// Bodies fall asleep and wake up; those of all pairs are told apart from them.
TEST_P(PairsOf, ChangesOfSomeBodiesAreThoseOfTheTruth) {
  Executor executor(2);
  const auto algorithm = GetParam()->make(executor);
  UnrestfulBodies bodies(300);
  Pairs told, told_all;
  std::size_t all_began = 0, all_ended = 0;
  std::uint32_t step = 0;
  algorithm->build(bodies.boxes());
  for (const Unrest& unrest : unrests) {
    SCOPED_TRACE(unrest.name);
    for (int frame = 0; frame < drawn(6, 3); ++frame, ++step) {
      algorithm->update(bodies.next(unrest));
      Ids awake;
      for (std::uint32_t id = 0; id < bodies.boxes().size(); ++id) {
        if ((id / 5 + step / 4) % 3 == 0) awake.push_back(id);
      }
      const Pairs truth = true_pairs(bodies.boxes());
      const Pairs now = true_pairs_of(awake, truth);
      PairSink began, ended;
      ASSERT_EQ(algorithm->find_changes_of(awake, began, ended), Status::ok);
      ASSERT_EQ(began.gather() == without(now, told), true) << step;
      ASSERT_EQ(ended.gather() == without(told, now), true) << step;
      all_began += began.size();
      all_ended += ended.size();
      told = now;
      if (step % 5 != 0) continue;
      ASSERT_EQ(algorithm->find_changes(began, ended), Status::ok);
      ASSERT_EQ(began.gather() == without(truth, told_all), true) << step;
      ASSERT_EQ(ended.gather() == without(told_all, truth), true) << step;
      told_all = truth;
    }
  }
  EXPECT_GT(all_began, 500u / one_in);
  EXPECT_GT(all_ended, 500u / one_in);
}

// After each discard there is a build; changes are told over it. A hint may be wrong.
TEST_P(PairsOf, ABuildAfterDiscardIsAsGood) {
  Executor executor(2);
  const auto algorithm = GetParam()->make(executor);
  UnrestfulBodies bodies(300);
  const Unrest& unrest = unrests[1];
  Pairs told;
  PairSink began, ended;
  algorithm->prepare(10);
  std::size_t all_ended = 0;
  for (int step = 0; step < drawn(24, 12); ++step) {
    if (step % 3 != 1) {
      bodies.next(unrest);
      algorithm->discard();
      if (step % 2 == 0) algorithm->prepare(bodies.boxes().size() + (step % 4 == 0 ? 100 : 0));
      algorithm->build(bodies.boxes());
    } else {
      algorithm->update(bodies.next(unrest));
    }
    const Pairs now = true_pairs(bodies.boxes());
    ASSERT_EQ(algorithm->find_pairs(began), Status::ok);
    ASSERT_EQ(sorted(began) == now, true) << step;
    ASSERT_EQ(algorithm->find_changes(began, ended), Status::ok);
    ASSERT_EQ(began.gather() == without(now, told), true) << step;
    ASSERT_EQ(ended.gather() == without(told, now), true) << step;
    all_ended += ended.size();
    told = now;
  }
  EXPECT_GT(told.size(), 50u);
  EXPECT_GT(all_ended, 0u);
  algorithm->discard();
}

// No boxes, and slots without a body.
TEST_P(PairsOf, EmptySlotsHaveNone) {
  Executor executor(2);
  const auto algorithm = GetParam()->make(executor);
  PairSink sink, ended;
  algorithm->build({});
  ASSERT_EQ(algorithm->find_pairs_of({}, sink), Status::ok);
  EXPECT_EQ(sink.size(), 0u);
  const Aabb unit{{0, 0, 0}, {1, 1, 1}};
  const std::vector<Aabb> boxes = {unit, Aabb::empty(), unit, Aabb::empty(), unit};
  algorithm->build(boxes);
  const Ids empty = {1, 3}, with_two = {1, 2};
  ASSERT_EQ(algorithm->find_pairs_of(empty, sink), Status::ok);
  EXPECT_EQ(sink.size(), 0u);
  ASSERT_EQ(algorithm->find_pairs_of(with_two, sink), Status::ok);
  EXPECT_EQ(sorted(sink), (Pairs{{0, 2}, {2, 4}}));
  ASSERT_EQ(algorithm->find_changes_of(with_two, sink, ended), Status::ok);
  EXPECT_EQ(sink.size(), 2u);
  ASSERT_EQ(algorithm->find_changes_of(empty, sink, ended), Status::ok);
  EXPECT_EQ(sink.size(), 0u);
  EXPECT_EQ(ended.size(), 2u);
}

}  // namespace
}  // namespace touchstone
