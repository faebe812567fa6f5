// What our broad phases count of their work: by hand on small scenes, and the same everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "algorithms/core/isa.h"
#include "algorithms/registry.h"
#include "tests/algorithms/broad_phase/box_sets.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

struct Counted {
  BroadPhaseWork work;
  std::size_t pairs;
};

Counted count(const std::string& name, std::span<const Aabb> boxes, int width = 1) {
  Executor executor(width);
  const auto algorithm = registry::find<BroadPhaseEntry>(name)->make(executor);
  PairSink sink;
  algorithm->build(boxes);
  EXPECT_EQ(algorithm->find_pairs(sink), Status::ok);
  return {algorithm->work(), sink.size()};
}

auto numbers(const BroadPhaseWork& work) {
  return std::tuple(work.box_tests, work.node_visits, work.candidates, work.bytes);
}

std::vector<const BroadPhaseEntry*> ours() {
  std::vector<const BroadPhaseEntry*> list;
  for (const BroadPhaseEntry& entry : registry::entries<BroadPhaseEntry>()) {
    if (entry.info.origin == Origin::ours) list.push_back(&entry);
  }
  return list;
}

class Work : public testing::Test {
 protected:
  void TearDown() override { limit_isa(isa_of_machine()); }
};

// Unit cubes on the x axis, 10 apart.
std::vector<Aabb> row_of_cubes(std::size_t count) {
  std::vector<Aabb> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const float x = 10 * static_cast<float>(i);
    boxes.push_back({{x, 0, 0}, {x + 1, 1, 1}});
  }
  return boxes;
}

TEST_F(Work, NaiveTestsEveryPairOnce) {
  Random random(1);
  for (const std::size_t n : {0u, 1u, 2u, 17u, 256u, 257u, 1'500u, 4'000u}) {
    const Counted counted = count("naive", uniform_boxes(random, n, 0.1f));
    const auto pairs = static_cast<std::int64_t>(n * (n - 1) / 2);
    EXPECT_EQ(counted.work.box_tests, pairs) << n;
    EXPECT_EQ(counted.work.candidates, pairs) << n;
    EXPECT_EQ(counted.work.node_visits, 0) << n;
  }
}

TEST_F(Work, ASweepComparesEachBoxWithTheOneThatEndsIt) {
  // Apart on x: no candidate, and each box but the last meets its neighbour, which ends its sweep.
  for (const char* name : {"sweep-one-axis", "sweep-three-axes", "sweep-and-prune"}) {
    SCOPED_TRACE(name);
    for (const std::size_t n : {1u, 2u, 15u, 16u, 17u, 40u}) {
      const Counted counted = count(name, row_of_cubes(n));
      EXPECT_EQ(counted.work.box_tests, static_cast<std::int64_t>(n - 1)) << n;
      EXPECT_EQ(counted.work.candidates, 0) << n;
      EXPECT_EQ(counted.work.node_visits, 0) << n;
    }
  }
}

TEST_F(Work, SweepsByHand) {
  // On x, the widest axis: 0 overlaps 1 and 2, and 3 ends its sweep; 1 overlaps 2, ended by 3; 2 is
  // ended by 3; 3 touches 4, and the array ends; 4 has none behind it. On y, box 1 is off 0 and 2.
  const std::vector<Aabb> boxes = {{{0, 0, 0}, {10, 1, 1}},
                                   {{2, 5, 0}, {12, 6, 1}},
                                   {{4, 0, 0}, {14, 1, 1}},
                                   {{50, 0, 0}, {60, 1, 1}},
                                   {{60, 0, 0}, {70, 1, 1}}};
  const Counted sweep = count("sweep-one-axis", boxes);
  EXPECT_EQ(sweep.pairs, 2u);
  EXPECT_EQ(sweep.work.candidates, 4);     // 01 02 12 34
  EXPECT_EQ(sweep.work.box_tests, 4 + 3);  // and 03 13 23
  // Here the list of y is the longer one: 02 03 04 23 24 34. So it sweeps x too, by places.
  const Counted sort = count("sweep-three-axes", boxes);
  EXPECT_EQ(sort.pairs, 2u);
  EXPECT_EQ(sort.work.candidates, 4);
  EXPECT_EQ(sort.work.box_tests, 4 + 3);
  const Counted kept = count("sweep-and-prune", boxes);
  EXPECT_EQ(kept.work.candidates, 4);
  EXPECT_EQ(kept.work.box_tests, 4 + 3);
}

TEST_F(Work, KeptEndPointsAreCountedAsTheyStand) {
  Executor executor(1);
  const auto algorithm = registry::find<BroadPhaseEntry>("sweep-and-prune")->make(executor);
  PairSink sink;
  std::vector<Aabb> boxes = row_of_cubes(20);
  algorithm->build(boxes);
  algorithm->find_pairs(sink);
  EXPECT_EQ(algorithm->work().box_tests, 19);
  // Cube 4 goes into cube 3, and a copy of cube 9 comes.
  boxes[4] = boxes[3];
  boxes.push_back(boxes[9]);
  const std::uint32_t moved[] = {4};
  const std::uint32_t inserted[] = {20};
  algorithm->update({boxes, moved, inserted, {}});
  algorithm->find_pairs(sink);
  EXPECT_EQ(sink.gather(), (std::vector<IndexPair>{{3, 4}, {9, 20}}));
  EXPECT_EQ(algorithm->work().candidates, 2);
  EXPECT_EQ(algorithm->work().box_tests, 2 + 20);
}

TEST_F(Work, KdTreeByHand) {
  // One leaf: each pair is tested.
  const Counted leaf = count("kd-tree", row_of_cubes(32));
  EXPECT_EQ(leaf.work.box_tests, 32 * 31 / 2);
  EXPECT_EQ(leaf.work.node_visits, 1);
  // Two leaves of 32, far from each other. The first one's bounds are looked at for the second, and
  // none of its cubes is.
  const Counted two = count("kd-tree", row_of_cubes(64));
  EXPECT_EQ(two.work.candidates, 2 * (32 * 31 / 2));
  EXPECT_EQ(two.work.box_tests, 2 * (32 * 31 / 2) + 1);
  EXPECT_EQ(two.work.node_visits, 3 + 1);
  // A box over all of them stays at the root.
  std::vector<Aabb> boxes = row_of_cubes(64);
  boxes.push_back({{0, 0, 0}, {640, 1, 1}});
  const Counted large = count("kd-tree", boxes);
  EXPECT_EQ(large.pairs, 64u);
  EXPECT_EQ(large.work.candidates, 2 * (32 * 31 / 2) + 64);
  EXPECT_EQ(large.work.box_tests, large.work.candidates + 1 + 2);
}

TEST_F(Work, AStackInOnePlaceHasNothingButCandidates) {
  const std::vector<Aabb> boxes(100, Aabb{{1, 2, 3}, {2, 3, 4}});
  for (const BroadPhaseEntry* entry : ours()) {
    SCOPED_TRACE(entry->info.name);
    const Counted counted = count(entry->info.name, boxes);
    EXPECT_EQ(counted.pairs, 4950u);
    EXPECT_EQ(counted.work.candidates, 4950);
    // Those with bounds of many boxes test these too, a few for each 16 boxes or against them.
    EXPECT_GE(counted.work.box_tests, 4950);
    EXPECT_LE(counted.work.box_tests, 4950 + 4950 / 4);
  }
  for (const char* name : {"naive", "sweep-one-axis", "sweep-three-axes", "uniform-grid"}) {
    EXPECT_EQ(count(name, boxes).work.box_tests, 4950) << name;
  }
}

TEST_F(Work, GridByHand) {
  // Cells have twice the size of the cubes: sides of 2, so that cube i, at 10 i, lies alone in the
  // cell of its own; nothing is tested.
  const Counted apart = count("uniform-grid", row_of_cubes(20));
  EXPECT_EQ(apart.work.box_tests, 0);
  EXPECT_EQ(apart.work.node_visits, 20);
  // The same with each cube there twice: a test a cell, and all of them are pairs.
  std::vector<Aabb> twice = row_of_cubes(20);
  twice.insert(twice.end(), twice.begin(), twice.begin() + 20);
  const Counted doubled = count("uniform-grid", twice);
  EXPECT_EQ(doubled.pairs, 20u);
  EXPECT_EQ(doubled.work.box_tests, 20);
  EXPECT_EQ(doubled.work.candidates, 20);
  EXPECT_EQ(doubled.work.node_visits, 20);
}

TEST_F(Work, GridTestsALargeBoxAgainstAll) {
  // One box over all cells is kept apart: it meets each of the 200 others in its only cell.
  std::vector<Aabb> boxes = row_of_cubes(200);
  boxes.push_back({{0, 0, 0}, {2000, 1, 1}});
  const Counted counted = count("uniform-grid", boxes);
  EXPECT_EQ(counted.pairs, 200u);
  EXPECT_EQ(counted.work.box_tests, 200);
  EXPECT_EQ(counted.work.node_visits, 200);
}

TEST_F(Work, OctreeByHand) {
  // One leaf below the root.
  const std::vector<Aabb> one = {{{0, 0, 0}, {1, 1, 1}}};
  const Counted alone = count("loose-octree", one);
  EXPECT_EQ(alone.work.box_tests, 0);
  EXPECT_EQ(alone.work.node_visits, 1);
  // In a row: a leaf for each half of the root. One leaf is tested against the other, and the ten
  // boxes of each against one another.
  const Counted halves = count("loose-octree", row_of_cubes(20));
  EXPECT_EQ(halves.work.node_visits, 1);
  EXPECT_EQ(halves.work.candidates, 2 * 45);
  EXPECT_EQ(halves.work.box_tests, 2 * 45 + 1);
}

TEST_F(Work, IsTheSameAtEveryWidthAndLevel) {
  Random random(2);
  std::vector<BoxSet> sets = box_sets();
  sets.push_back({.name = "crowd", .boxes = uniform_boxes(random, drawn(4'000, 800), 0.05f)});
  std::size_t with_saving = 0;
  for (const BroadPhaseEntry* entry : ours()) {
    SCOPED_TRACE(entry->info.name);
    for (const BoxSet& set : sets) {
      SCOPED_TRACE(set.name);
      std::optional<BroadPhaseWork> first;
      for (const Isa level : isa_levels()) {
        limit_isa(level);
        for (const int width : {1, 3}) {
          const Counted counted = count(entry->info.name, set.boxes, width);
          if (!first) first = counted.work;
          EXPECT_EQ(numbers(*first), numbers(counted.work)) << to_string(level) << ' ' << width;
          EXPECT_GE(counted.work.candidates, static_cast<std::int64_t>(counted.pairs));
          EXPECT_GE(counted.work.box_tests, counted.work.candidates);
        }
      }
      const auto n = static_cast<std::int64_t>(set.boxes.size());
      with_saving += first->box_tests < n * (n - 1) / 4 ? 1 : 0;
      EXPECT_GE(first->bytes, first->candidates > 0 ? 1 : 0);
    }
  }
  EXPECT_GT(with_saving, sets.size());
}

// Numbers are of the frame at hand, also where an update has changed next to nothing.
TEST_F(Work, IsOfTheFrameAtHand) {
  for (const BroadPhaseEntry* entry : ours()) {
    SCOPED_TRACE(entry->info.name);
    Executor executor(1);
    const auto algorithm = entry->make(executor);
    PairSink sink;
    Random random(3);
    const std::vector<Aabb> many = uniform_boxes(random, 900, 0.05f);
    const std::vector<Aabb> few = uniform_boxes(random, 30, 0.2f);
    algorithm->build(many);
    algorithm->find_pairs(sink);
    const BroadPhaseWork of_many = algorithm->work();
    algorithm->update({many, {}, {}, {}});
    algorithm->find_pairs(sink);
    const std::string& name = entry->info.name;
    // Pairs are kept once it has been seen that nothing moves, and by a list where they are few.
    if (name == "verlet-list" || name == "dynamic-bvh" || name == "auto") {
      EXPECT_LT(algorithm->work().box_tests, of_many.box_tests);
    } else {
      EXPECT_EQ(algorithm->work().box_tests, of_many.box_tests);
    }
    algorithm->build(few);
    algorithm->find_pairs(sink);
    EXPECT_EQ(count(entry->info.name, few).work.box_tests, algorithm->work().box_tests);
    EXPECT_EQ(count(entry->info.name, few).work.node_visits, algorithm->work().node_visits);
    EXPECT_GE(algorithm->work().bytes, count(entry->info.name, few).work.bytes);  // it is kept
  }
}

}  // namespace
}  // namespace touchstone
