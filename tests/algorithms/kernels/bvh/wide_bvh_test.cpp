#include "algorithms/kernels/bvh/wide_bvh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <random>
#include <vector>

namespace touchstone {
namespace {

constexpr float unbounded = std::numeric_limits<float>::infinity();

std::vector<Aabb> scattered(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-10, 10), length(0, 0.5F);
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random);
      box.max[axis] = box.min[axis] + length(random);
    }
  }
  return boxes;
}

Aabb child_box(const WideNode& node, std::size_t lane) {
  return {{node.planes[0][lane], node.planes[1][lane], node.planes[2][lane]},
          {node.planes[3][lane], node.planes[4][lane], node.planes[5][lane]}};
}

void grow(Aabb& box, const Aabb& by) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.min[axis] = std::min(box.min[axis], by.min[axis]);
    box.max[axis] = std::max(box.max[axis], by.max[axis]);
  }
}

// Every box is in one leaf, every leaf and every node but the root has one parent before it, each
// box of a child is the union of what is below it, and no node lies too deep.
void expect_sound(const WideBvh& tree, const std::vector<Aabb>& boxes) {
  ASSERT_EQ(tree.order.size(), boxes.size());
  std::vector<std::uint32_t> sorted = tree.order;
  std::ranges::sort(sorted);
  for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
  EXPECT_EQ(tree.nodes.empty(), boxes.empty());
  std::vector<int> parents_of_leaf(tree.leaves(), 0), parents(tree.nodes.size(), 0);
  std::vector<std::size_t> depth(tree.nodes.size(), 0);
  for (std::size_t n = 0; n < tree.nodes.size(); ++n) {
    const WideNode& node = tree.nodes[n];
    ASSERT_LE(depth[n], WideBvh::greatest_depth);
    bool ended = false;
    for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
      const std::int32_t child = node.child[lane];
      const Aabb box = child_box(node, lane);
      Aabb below = Aabb::empty();
      ended |= child == WideNode::no_child;
      ASSERT_EQ(ended, child == WideNode::no_child);
      if (ended) {
        EXPECT_EQ(box, Aabb::empty());
        continue;
      }
      if (WideNode::is_leaf(child)) {
        ASSERT_LT(WideNode::leaf(child), tree.leaves());
        ++parents_of_leaf[WideNode::leaf(child)];
        for (const std::uint32_t i : tree.leaf(WideNode::leaf(child))) grow(below, boxes[i]);
      } else {
        const auto c = static_cast<std::size_t>(child);
        ASSERT_GT(c, n);
        ASSERT_LT(c, tree.nodes.size());
        ++parents[c];
        depth[c] = depth[n] + 1;
        for (std::size_t k = 0; k < WideNode::fan; ++k) grow(below, child_box(tree.nodes[c], k));
      }
      ASSERT_EQ(box, below);
    }
  }
  EXPECT_TRUE(std::ranges::all_of(parents_of_leaf, [](int count) { return count == 1; }));
  if (!parents.empty()) {
    EXPECT_EQ(parents[0], 0);
    EXPECT_TRUE(std::all_of(parents.begin() + 1, parents.end(), [](int c) { return c == 1; }));
  }
}

bool same(const WideBvh& a, const WideBvh& b) {
  return a.order == b.order &&
         std::ranges::equal(a.nodes, b.nodes, [](const WideNode& x, const WideNode& y) {
           return x.planes == y.planes && x.child == y.child;
         });
}

TEST(WideBvh, HoldsEveryBoxOnceWhateverTheirNumber) {
  for (const std::size_t count : {0u, 1u, 7u, 8u, 9u, 16u, 17u, 63u, 64u, 65u, 1000u, 4097u}) {
    const std::vector<Aabb> boxes = scattered(count, 3);
    const WideBvh tree = build_wide_bvh(boxes);
    expect_sound(tree, boxes);
    EXPECT_TRUE(same(tree, build_wide_bvh(boxes)));
  }
}

TEST(WideBvh, TakesAnyBoxes) {
  std::vector<std::vector<Aabb>> families;
  families.emplace_back(1000, Aabb{{1, 2, 3}, {4, 5, 6}});  // the same
  families.emplace_back(100, Aabb{{1, 1, 1}, {1, 1, 1}});   // points
  families.emplace_back(100, Aabb::empty());
  families.emplace_back(
      100, Aabb{{-unbounded, -unbounded, -unbounded}, {unbounded, unbounded, unbounded}});
  auto& mixed = families.emplace_back(scattered(500, 5));
  for (std::size_t i = 0; i < mixed.size(); i += 3) mixed[i] = mixed[0];
  mixed[7] = Aabb::empty();
  mixed[11].max[1] = unbounded;
  mixed[13].min[0] = -std::numeric_limits<float>::max();
  mixed[13].max[0] = std::numeric_limits<float>::max();
  // Each box is far greater than those before it, so that each split has few on one side.
  auto& growing = families.emplace_back();
  for (int e = -120; e < 120; ++e) {
    for (int k = 0; k < 9; ++k) {
      const float x = std::ldexp(1.0F + 0.1F * static_cast<float>(k), e);
      growing.push_back({{x, 0, 0}, {x, x * 1e-3F, 0}});
    }
  }
  for (const std::vector<Aabb>& boxes : families) {
    const WideBvh tree = build_wide_bvh(boxes);
    expect_sound(tree, boxes);
    EXPECT_TRUE(same(tree, build_wide_bvh(boxes)));
  }
}

TEST(WideBvh, IsRefittedToBoxesThatMoved) {
  for (const std::size_t count : {1u, 9u, 1000u, 5001u}) {
    WideBvh tree = build_wide_bvh(scattered(count, 7));
    const std::vector<std::uint32_t> order = tree.order;
    const std::vector<Aabb> moved = scattered(count, 8);
    refit(tree, moved);
    EXPECT_EQ(tree.order, order);
    expect_sound(tree, moved);
  }
  WideBvh none = build_wide_bvh({});
  refit(none, {});
  EXPECT_TRUE(none.nodes.empty());
}

// What the splits are for: a small box meets few of the nodes.
TEST(WideBvh, ASmallBoxMeetsFewNodes) {
  const std::size_t count = 20000;
  const std::vector<Aabb> boxes = scattered(count, 9);
  const WideBvh tree = build_wide_bvh(boxes);
  std::size_t visits = 0, found = 0, expected = 0;
  const std::vector<Aabb> searched = scattered(50, 10);
  for (const Aabb& box : searched) {
    std::vector<std::size_t> open = {0};
    while (!open.empty()) {
      const WideNode& node = tree.nodes[open.back()];
      open.pop_back();
      ++visits;
      for (std::size_t lane = 0; lane < WideNode::fan; ++lane) {
        if (!overlap(box, child_box(node, lane))) continue;
        if (!WideNode::is_leaf(node.child[lane])) {
          open.push_back(static_cast<std::size_t>(node.child[lane]));
          continue;
        }
        for (const std::uint32_t i : tree.leaf(WideNode::leaf(node.child[lane]))) {
          found += overlap(box, boxes[i]) ? 1 : 0;
        }
      }
    }
    for (const Aabb& other : boxes) expected += overlap(box, other) ? 1 : 0;
  }
  EXPECT_EQ(found, expected);
  EXPECT_GT(found, 0u);
  EXPECT_LT(visits, searched.size() * 20);
}

}  // namespace
}  // namespace touchstone
