#include "algorithms/kernels/bvh/hilbert_sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "algorithms/kernels/bvh/implicit_rtree.h"

namespace touchstone {
namespace {

class CurveOrderTest : public testing::Test {
 protected:
  Aabb cube(float x, float y, float z, float side) {
    return {{x, y, z}, {x + side, y + side, z + side}};
  }
  Aabb anywhere(float width, float side) {
    std::uniform_real_distribution<float> place(0, width);
    const float x = place(random_);
    const float y = place(random_);
    return cube(x, y, place(random_), side);
  }
  AabbSoA ordered(const std::vector<Aabb>& boxes, int width = 1) {
    Executor executor(width);
    HilbertSort order;
    AabbSoA arrays;
    order.make(executor, boxes);
    EXPECT_FALSE(order.empty());
    arrays.resize(order.places());
    for_each_block(executor, order.places(), 512,
                   [&](std::size_t, std::size_t first, std::size_t last) {
                     order.gather(boxes, first, last, arrays);
                   });
    return arrays;
  }
  static bool is_free(const AabbSoA& arrays, std::size_t place) {
    return arrays.min(0)[place] > arrays.max(0)[place];
  }
  // The bodies in order; that each place has its body's box.
  static std::vector<std::uint32_t> bodies(const AabbSoA& arrays, const std::vector<Aabb>& boxes) {
    std::vector<std::uint32_t> ids;
    for (std::size_t i = 0; i < arrays.size(); ++i) {
      if (is_free(arrays, i)) continue;
      const std::uint32_t id = arrays.ids()[i];
      EXPECT_EQ(arrays.min(1)[i], boxes[id].min[1]);
      EXPECT_EQ(arrays.max(2)[i], boxes[id].max[2]);
      ids.push_back(id);
    }
    return ids;
  }
  static double spread(const AabbSoA& arrays) {
    Executor executor(1);
    ImplicitRTree tree;
    tree.fit(executor, arrays.size(), [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) {
        tree.boxes().set(i, arrays.box(i), arrays.ids()[i]);
      }
    });
    return tree.spread();
  }

  std::mt19937 random_{7};
};

TEST_F(CurveOrderTest, HoldsEachBodyOnceAndNoEmptyBox) {
  for (const std::size_t count : {1u, 2u, 15u, 16u, 17u, 1000u, 20000u}) {
    std::vector<Aabb> boxes;
    std::vector<std::uint32_t> expected;
    for (std::size_t i = 0; i < count; ++i) {
      const bool empty = i % 3 == 1;
      boxes.push_back(empty ? Aabb::empty() : anywhere(100, i % 100 == 0 ? 50.0f : 1.0f));
      if (!empty) expected.push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<std::uint32_t> ids = bodies(ordered(boxes), boxes);
    EXPECT_EQ(bodies(ordered(boxes, 2), boxes), ids);
    std::ranges::sort(ids);
    EXPECT_EQ(ids, expected) << count;
  }
}

TEST_F(CurveOrderTest, NothingIsEmpty) {
  Executor executor(1);
  HilbertSort order;
  order.make(executor, {});
  EXPECT_TRUE(order.empty());
  order.make(executor, std::vector<Aabb>(5000, Aabb::empty()));
  EXPECT_TRUE(order.empty());
  // A single body among slots that a sample would miss.
  std::vector<Aabb> boxes(5000, Aabb::empty());
  boxes[4321] = cube(0, 0, 0, 1);
  order.make(executor, boxes);
  EXPECT_FALSE(order.empty());
}

TEST_F(CurveOrderTest, GiantsComeLastAndApart) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 3000; ++i) boxes.push_back(anywhere(50, 1));
  boxes[17] = cube(0, 0, 0, 50);
  boxes[1234] = cube(0, 0, 0, 40);
  const AabbSoA arrays = ordered(boxes);
  const std::vector<std::uint32_t> ids = bodies(arrays, boxes);
  EXPECT_TRUE((ids[2998] == 17 && ids[2999] == 1234) || (ids[2998] == 1234 && ids[2999] == 17));
  EXPECT_EQ(arrays.size(), 3072u + 2u);  // 12 groups of 256, then the two
}

// Far bodies leave the others a few cells of the curve: these are gone through again.
TEST_F(CurveOrderTest, FarBodiesDoNotSpoilTheOrder) {
  std::vector<Aabb> boxes;
  for (int i = 0; i < 4096; ++i) boxes.push_back(anywhere(30, 1));
  const double near = spread(ordered(boxes));
  std::vector<Aabb> shuffled = boxes;
  AabbSoA unordered;
  unordered.resize(boxes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    unordered.set(i, boxes[i], static_cast<std::uint32_t>(i));
  }
  EXPECT_GT(spread(unordered), 4 * near);
  // A second crowd beside the first, a thousand times as far as they are wide.
  for (int i = 0; i < 4096; ++i) {
    Aabb box = anywhere(30, 1);
    box.min[0] += 30000;
    box.max[0] += 30000;
    boxes.push_back(box);
  }
  EXPECT_LT(spread(ordered(boxes)), 4 * near);
}

// Clumps of all sizes, each in one cell of the curve of all, are each in about as good an order as
// if it were alone. Within a clump there is a denser one.
TEST_F(CurveOrderTest, FarClumpsAreEachInOrder) {
  std::vector<Aabb> boxes;
  double alone = 0;
  float at = 0;
  for (const int count : {48, 208, 704, 3'008, 20'000}) {  // no block of 16 is in two clumps
    const float width = std::cbrt(static_cast<float>(count));
    std::vector<Aabb> clump;
    for (int i = 0; i < count; ++i)
      clump.push_back(anywhere(i % 4 == 0 ? width : width / 50, 0.1f));
    alone += spread(ordered(clump));
    at += 1e5f;
    for (Aabb& box : clump) {
      box.min[1] += at;
      box.max[1] += at;
      boxes.push_back(box);
    }
  }
  std::ranges::shuffle(boxes, random_);
  const AabbSoA arrays = ordered(boxes);
  EXPECT_LT(spread(arrays), 1.3 * alone);
  std::vector<std::uint32_t> ids = bodies(arrays, boxes);
  EXPECT_EQ(bodies(ordered(boxes, 2), boxes), ids);
  std::ranges::sort(ids);
  for (std::uint32_t id = 0; id < boxes.size(); ++id) ASSERT_EQ(ids[id], id);
}

}  // namespace
}  // namespace touchstone
