// Extents of blocks of triangles: no triangle is left out that reaches into one, and those far beyond are.
#include "algorithms/kernels/triangles/block_extent.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "algorithms/kernels/triangles/moved_block.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

constexpr unsigned all_lanes = 0xff;

// Triangles around a point, flat to `height` along z.
TriangleBlock flat_block(reference::Random& random, const Vec3d& at, double height) {
  TriangleBlock block;
  for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3d corner = random.vector(1);
      corner[2] *= height;
      corner += at;
      for (std::size_t axis = 0; axis < 3; ++axis)
        block.at[3 * k + axis][lane] = corner[static_cast<int>(axis)];
    }
  }
  return block;
}

// The ends of one triangle along a way.
std::pair<double, double> ends_of(const TriangleBlock& block, std::size_t lane, const Vec3d& way) {
  const auto along = [&](std::size_t k) { return way.dot(block.corner(lane, k)); };
  const auto [low, high] = std::minmax({along(0), along(1), along(2)});
  return {low, high};
}

TEST(FloatBlock, MovesAsTheSameDoubles) {
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    reference::Random random(10);
    for (int i = 0; i < 50; ++i) {
      TriangleBlock block = flat_block(random, random.vector(1), 0.1);
      FloatTriangleBlock narrow;
      for (std::size_t row = 0; row < block.at.size(); ++row) {
        for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
          narrow.at[row][lane] = static_cast<float>(block.at[row][lane]);
          block.at[row][lane] = narrow.at[row][lane];
        }
      }
      TriangleBlock moved, moved_wide;
      const Pose pose = {random.rotation(), random.vector(1)};
      move(narrow, pose, moved);
      move(block, pose, moved_wide);
      EXPECT_EQ(moved.at, moved_wide.at);
    }
  }
  limit_isa(isa_of_machine());
}

TEST(BlockExtent, LeavesOutWhatIsBeyondAndNothingElse) {
  const double slack = 1e-12;
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    reference::Random random(11);
    int kept = 0, left_out = 0;
    for (int i = 0; i < 2000 / one_in; ++i) {
      const BlockExtent extent = extent_along_normal(flat_block(random, random.vector(1), 0.1));
      const TriangleBlock other = flat_block(random, random.vector(1), 0.5);
      const unsigned bits = reaching(other, extent, slack);
      for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
        const auto [low, high] = ends_of(other, lane, extent.way);
        const bool is_in = (bits >> lane & 1) != 0;
        ++(is_in ? kept : left_out);
        const double gap = std::max(low - extent.high, extent.low - high);
        if (gap <= 0) {
          EXPECT_TRUE(is_in);
        } else if (gap > 3 * slack) {
          EXPECT_FALSE(is_in);
        }
      }
    }
    EXPECT_GT(kept, 1000 / one_in);
    EXPECT_GT(left_out, 1000 / one_in);
  }
  limit_isa(isa_of_machine());
}

TEST(BlockExtent, HasTheEndsOfAllTriangles) {
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    reference::Random random(14);
    for (int i = 0; i < 500 / one_in; ++i) {
      TriangleBlock block = flat_block(random, random.vector(1), 0.5);
      const Mat3d ways = random.rotation();
      const BlockBox box = box_along(block, ways);
      for (std::size_t row = 0; row < 3; ++row) {
        const Vec3d way = ways.row(static_cast<int>(row));
        auto [low, high] = ends_of(block, 0, way);
        for (std::size_t lane = 1; lane < TriangleBlock::size; ++lane) {
          const auto ends = ends_of(block, lane, way);
          low = std::min(low, ends.first);
          high = std::max(high, ends.second);
        }
        EXPECT_NEAR(box.low[row], low, 1e-14);
        EXPECT_NEAR(box.high[row], high, 1e-14);
        const BlockExtent extent = extent_along(block, way);
        EXPECT_EQ(extent.low, box.low[row]);
        EXPECT_EQ(extent.high, box.high[row]);
      }
      // One that is not finite has no ends, wherever it is.
      block.at[static_cast<std::size_t>(i) % 9][static_cast<std::size_t>(i) % 8] =
          i % 2 == 0 ? std::numeric_limits<double>::quiet_NaN()
                     : std::numeric_limits<double>::infinity();
      const BlockBox none = box_along(block, ways);
      EXPECT_TRUE(std::isnan(none.low[0]) && std::isnan(none.high[2]));
    }
  }
  limit_isa(isa_of_machine());
}

TEST(BlockExtent, ABlockReachesIntoItsOwn) {
  reference::Random random(12);
  for (int i = 0; i < 500 / one_in; ++i) {
    const TriangleBlock block = flat_block(random, random.vector(1e6), 1e-3);
    const BlockExtent extent = extent_along_normal(block);
    EXPECT_NEAR(extent.way.norm(), 1, 1e-12);
    EXPECT_EQ(reaching(block, extent, 1e-6), all_lanes);
    EXPECT_LE(extent.low, extent.high);
  }
}

TEST(BlockExtent, WhatIsNotFiniteAlwaysReaches) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (const Isa level : isa_levels()) {
    limit_isa(level);
    reference::Random random(13);
    const BlockExtent low = extent_along_normal(flat_block(random, {0, 0, 0}, 0));
    for (const double odd : {std::nan(""), infinity, -infinity}) {
      for (std::size_t row = 0; row < 9; ++row) {
        TriangleBlock block = flat_block(random, {0, 0, 100}, 0);
        EXPECT_EQ(reaching(block, low, 0), 0u);
        block.at[row][5] = odd;
        // A way of exactly no x makes infinity times zero, which is NaN too.
        EXPECT_EQ(reaching(block, low, 0), 1u << 5);
        const BlockExtent extent = extent_along(block, {0, 0, 1});
        EXPECT_TRUE(std::isnan(extent.low));
        EXPECT_EQ(reaching(flat_block(random, {0, 0, -100}, 0), extent, 0), all_lanes);
        EXPECT_EQ(reaching(flat_block(random, {0, 0, 0}, 0), extent_along_normal(block), 0),
                  all_lanes);
      }
    }
  }
  limit_isa(isa_of_machine());
}

TEST(BlockExtent, DegenerateTrianglesHaveNoWay) {
  TriangleBlock block = {};
  const BlockExtent extent = extent_along_normal(block);
  EXPECT_EQ(extent.way, Vec3d(0, 0, 0));
  reference::Random random(14);
  EXPECT_EQ(reaching(flat_block(random, {5, 0, 0}, 1), extent, 0), all_lanes);
}

}  // namespace
}  // namespace touchstone
