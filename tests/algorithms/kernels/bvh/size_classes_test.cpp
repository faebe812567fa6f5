#include "algorithms/kernels/bvh/size_classes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

constexpr std::array all_levels{Isa::baseline, Isa::avx2, Isa::avx512};

class SizeClassesTest : public testing::Test {
 protected:
  ~SizeClassesTest() override { limit_isa(isa_of_machine()); }

  Aabb box_of_side(float side) {
    std::uniform_real_distribution<float> place(-100, 100);
    std::uniform_real_distribution<float> part(0, 1);
    Aabb box;
    const std::size_t longest = random_() % 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.min[axis] = place(random_);
      box.max[axis] = box.min[axis] + (axis == longest ? side : side * part(random_));
    }
    return box;
  }
  // Many small boxes, some large ones, few giants, and empty ones.
  std::vector<Aabb> mixed(std::size_t count) {
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < count; ++i) {
      boxes.push_back(i % 7 == 3     ? Aabb::empty()
                      : i % 100 == 1 ? box_of_side(500)
                      : i % 20 == 2  ? box_of_side(100)
                                     : box_of_side(1));
    }
    return boxes;
  }
  static float side_of(const Aabb& box) {
    return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1], box.max[2] - box.min[2]});
  }

  std::mt19937 random_{11};
};

TEST_F(SizeClassesTest, SamplesTheSameAtEveryLevel) {
  for (const std::size_t count : {1u, 15u, 16u, 33u, 1000u, 5000u}) {
    const std::vector<Aabb> boxes = mixed(count);
    for (const std::size_t stride : {1u, 3u}) {
      CentreRegion region;
      std::size_t bodies = 0;
      for (std::size_t i = 0; i < count; i += stride) {
        if (boxes[i].is_empty()) continue;
        region.add(boxes[i]);
        ++bodies;
      }
      for (const Isa level : all_levels) {
        limit_isa(level);
        const SizeSample sample(boxes, stride);
        EXPECT_EQ(sample.region.low, region.low);
        EXPECT_EQ(sample.region.high, region.high);
        std::size_t members = 0;
        for (const std::uint32_t some : sample.members) members += some;
        EXPECT_EQ(members, bodies);
        EXPECT_EQ(sample.empty(), bodies == 0);
      }
    }
  }
}

TEST_F(SizeClassesTest, NoBoxOfASmallerClassIsLarger) {
  for (const std::size_t count : {20u, 1000u, 5001u}) {
    const std::vector<Aabb> boxes = mixed(count);
    const SizeSample sample = take_sample(boxes);
    const SizeClasses classes(sample);
    if (count >= 1000) {
      EXPECT_GE(classes.count(), 2u);
    }
    std::vector<std::uint32_t> first(count);
    limit_isa(Isa::baseline);
    classes.of(boxes, first.data());
    for (const Isa level : all_levels) {
      limit_isa(level);
      std::vector<std::uint32_t> own(count);
      classes.of(boxes, own.data());
      EXPECT_EQ(own, first);
    }
    std::vector<float> least(classes.count(), std::numeric_limits<float>::infinity());
    std::vector<float> greatest(classes.count(), 0);
    for (std::size_t i = 0; i < count; ++i) {
      if (boxes[i].is_empty()) {
        EXPECT_EQ(first[i], classes.count());
      } else {
        ASSERT_LT(first[i], classes.count());
        least[first[i]] = std::min(least[first[i]], side_of(boxes[i]));
        greatest[first[i]] = std::max(greatest[first[i]], side_of(boxes[i]));
      }
    }
    float before = 0;
    for (std::size_t at = 0; at < classes.count(); ++at) {
      EXPECT_LE(before, least[at]);
      before = std::max(before, greatest[at]);
    }
  }
}

// Points, whose sides may be negative zeros, and boxes whose sides overflow have a class.
TEST_F(SizeClassesTest, ExtremeBoxesHaveAClass) {
  constexpr float most = std::numeric_limits<float>::max();
  std::vector<Aabb> boxes(100, Aabb{{0.0f, 0.0f, 0.0f}, {-0.0f, -0.0f, -0.0f}});
  boxes[3] = {{-most, -most, -most}, {most, most, most}};
  for (const Isa level : all_levels) {
    limit_isa(level);
    const SizeClasses classes(take_sample(boxes));
    std::vector<std::uint32_t> own(boxes.size());
    classes.of(boxes, own.data());
    EXPECT_LT(own[3], classes.count());
    EXPECT_GT(own[3], own[0]);
    EXPECT_EQ(std::ranges::count(own, 0u), 99);
  }
}

}  // namespace
}  // namespace touchstone
