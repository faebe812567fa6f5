// Tests of the reference pairs of broad phases: two ways to find them, and the plain definition.
#include "harness/measure/block_input.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "harness/base/random.h"

namespace touchstone {
namespace {

std::vector<IndexPair> by_definition(const std::vector<Aabb>& boxes) {
  std::vector<IndexPair> pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a) {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b) {
      if (!boxes[a].is_empty() && !boxes[b].is_empty() && overlap(boxes[a], boxes[b])) {
        pairs.push_back({a, b});
      }
    }
  }
  return pairs;
}

void expect_right(const std::vector<Aabb>& boxes, const char* what) {
  const std::vector<IndexPair> pairs = by_definition(boxes);
  EXPECT_EQ(measure::overlapping_pairs(boxes), pairs) << what;
  EXPECT_EQ(measure::overlapping_pairs(boxes, 0), pairs) << what << ", by the tree";
}

TEST(OverlappingPairs, AreThoseOfTheDefinition) {
  std::size_t hits = 0, possible = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    base::Random random(seed);
    std::vector<Aabb> boxes;
    const std::uint64_t count = random.below(300);
    const bool on_grid = seed % 3 == 0;  // then many boxes touch exactly, and many coincide
    const double side = random.magnitude(1, 30);
    for (std::uint64_t i = 0; i < count; ++i) {
      if (random.below(20) == 0) {
        boxes.push_back(Aabb::empty());
        continue;
      }
      Aabb box;
      const double size = random.magnitude(0.01, 10);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = random.uniform(0, side);
        box.min[axis] = static_cast<float>(on_grid ? std::floor(low) : low);
        box.max[axis] = box.min[axis] + static_cast<float>(on_grid ? std::floor(size) : size);
      }
      boxes.push_back(box);
    }
    expect_right(boxes, "random");
    hits += by_definition(boxes).size();
    possible += count * (count - 1) / 2;
  }
  EXPECT_GT(hits, possible / 100);
  EXPECT_LT(hits, possible / 2);
}

TEST(OverlappingPairs, OfFewEqualAndHugeBoxes) {
  constexpr float huge = std::numeric_limits<float>::max();
  expect_right({}, "none");
  expect_right({Aabb::empty(), Aabb::empty()}, "empty ones");
  expect_right({{{0, 0, 0}, {1, 1, 1}}}, "one");
  expect_right(std::vector<Aabb>(100, Aabb{{1, 2, 3}, {1, 2, 3}}), "a hundred points in one place");
  std::vector<Aabb> boxes(50, Aabb{{-huge, -huge, -huge}, {huge, huge, huge}});
  for (int i = 0; i < 50; ++i) {
    const auto x = static_cast<float>(i);
    boxes.push_back({{x, 0.0f, -0.0f}, {x + 1, 0, 0}});
  }
  expect_right(boxes, "huge ones and a row that touches");
}

}  // namespace
}  // namespace touchstone
