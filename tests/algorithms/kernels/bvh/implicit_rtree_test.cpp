#include "algorithms/kernels/bvh/implicit_rtree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "algorithms/broad_phase/verlet_list/pair_tests.h"
#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

std::vector<Aabb> random_boxes(std::size_t count, float side) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> place(0, 10);
  std::uniform_real_distribution<float> length(0, side);
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = box.min[axis] + length(random);
    }
  }
  return boxes;
}

TEST(ImplicitRTree, ListsWhatABoxOverlaps) {
  Executor executor(1);
  for (const std::size_t count : {1u, 15u, 16u, 17u, 256u, 257u, 5000u}) {
    const std::vector<Aabb> boxes = random_boxes(count, 3);
    ImplicitRTree tree;
    tree.fit(executor, count, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        tree.boxes().set(i, boxes[i], static_cast<std::uint32_t>(i));
      }
    });
    RTreeScratch scratch;
    std::size_t hits = 0;
    for (const Aabb& box : random_boxes(50, 2)) {
      std::vector<std::uint32_t> expected;
      for (std::uint32_t i = 0; i < count; ++i) {
        if (overlap(boxes[i], box)) expected.push_back(i);
      }
      for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
        limit_isa(level);
        const std::size_t found = list_overlaps(tree, box, scratch);
        EXPECT_EQ(std::vector(scratch.children.begin(),
                              scratch.children.begin() + static_cast<std::ptrdiff_t>(found)),
                  expected);
      }
      limit_isa(isa_of_machine());
      hits += expected.size();
    }
    if (count > 200) {
      EXPECT_GT(hits, 50u);
      EXPECT_LT(hits, count * 50 / 2);
    }
  }
}

// Sparse boxes; some of which a group has more near ones than are tested at once; and those that all
// overlap each other.
TEST(ImplicitRTree, PairsAreThoseThatOverlapInOneOrderAtEveryLevel) {
  Executor executor(1);
  for (const std::size_t count : {1u, 15u, 17u, 256u, 257u, 1500u}) {
    for (const float side : {0.5f, 5.0f, 0.0f}) {
      std::vector<Aabb> boxes = random_boxes(count, side);
      if (side == 0) std::ranges::fill(boxes, Aabb{{0, 0, 0}, {1, 1, 1}});
      for (std::size_t i = 40; i < count; i += 41) boxes[i] = Aabb::empty();
      ImplicitRTree tree;
      tree.fit(executor, count, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
          tree.boxes().set(i, boxes[i], static_cast<std::uint32_t>(i));
        }
      });
      std::vector<IndexPair> expected;
      for (std::uint32_t a = 0; a < count; ++a) {
        for (std::uint32_t b = a + 1; b < count; ++b) {
          if (overlap(boxes[a], boxes[b])) expected.push_back({a, b});
        }
      }
      if (count > 200) {
        EXPECT_FALSE(expected.empty());
      }
      std::vector<IndexPair> first;
      std::int64_t first_tests = 0;
      for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
        limit_isa(level);
        PairBuffer out;
        RTreeScratch scratch;
        for (std::size_t group = 0; group < tree.groups(); ++group) {
          pair_group(tree, group, scratch, out);
        }
        std::vector<IndexPair> pairs(out.pairs().begin(), out.pairs().end());
        if (level == Isa::baseline) {
          first = pairs;
          first_tests = scratch.work.box_tests;
        }
        EXPECT_EQ(pairs, first);
        EXPECT_EQ(scratch.work.box_tests, first_tests);
        std::ranges::sort(pairs);
        EXPECT_TRUE(pairs == expected) << count << " boxes, side " << side;
      }
      limit_isa(isa_of_machine());
    }
  }
}

TEST(PairTests, AgreeWithOverlap) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  constexpr float tiny = std::numeric_limits<float>::denorm_min();
  const std::vector<float> values{
      -std::numeric_limits<float>::max(), -1, -tiny, -0.0f, 0.0f, tiny, 1,
      std::numeric_limits<float>::max()};
  std::mt19937 random(5);
  std::vector<Aabb> boxes{Aabb::empty(), {{-inf, -inf, -inf}, {inf, inf, inf}}};
  while (boxes.size() < 300) {
    Aabb box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float x = values[random() % values.size()];
      const float y = values[random() % values.size()];
      box.min[axis] = std::min(x, y);
      box.max[axis] = std::max(x, y);
    }
    boxes.push_back(box);
  }
  std::vector<IndexPair> all;
  std::vector<IndexPair> expected;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      ASSERT_EQ(overlap_at_once(boxes[a], boxes[b]), overlap(boxes[a], boxes[b])) << a << ' ' << b;
      all.push_back({a, b});
      if (overlap(boxes[a], boxes[b]) && a % 2 == 0) expected.push_back({a, b});
    }
  }
  EXPECT_GT(expected.size(), all.size() / 8);
  EXPECT_LT(expected.size(), all.size() * 3 / 8);
  PairBuffer out;
  write_overlapping(
      boxes, all, [](IndexPair pair) { return pair.a % 2 == 0; }, out);
  EXPECT_TRUE(std::ranges::equal(out.pairs(), expected));
}

}  // namespace
}  // namespace touchstone
