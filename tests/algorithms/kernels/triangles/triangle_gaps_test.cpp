// Gaps of triangles in lanes, against distances of one pair at a time.
#include "algorithms/kernels/triangles/triangle_gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algorithms/kernels/triangles/triangle_distance.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/random.h"

namespace touchstone {
namespace {

TriangleCorners corners_in(const TriangleBlock& block, std::size_t lane) {
  return {block.corner(lane, 0), block.corner(lane, 1), block.corner(lane, 2)};
}

TriangleBlock drawn_block(reference::Random& random, double away) {
  TriangleBlock block;
  for (std::size_t lane = 0; lane < TriangleBlock::size; ++lane) {
    const Vec3d centre = random.vector(1);
    // One triangle is a point, and one lies in a plane of the axes.
    const double size = lane == 6 ? 0 : 0.5;
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3d corner = centre + random.vector(size) + Vec3d(away, 0, 0);
      if (lane == 7) corner[1] = 0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        block.at[3 * k + axis][lane] = corner[static_cast<int>(axis)];
      }
    }
  }
  return block;
}

TEST(TriangleGaps, OfPairsAreMostlyTheirDistances) {
  reference::Random random(1);
  int reached = 0, all = 0;
  const int count = drawn(300, 30);
  for (int round = 0; round < count; ++round) {
    const TriangleBlock a = drawn_block(random, 0), b = drawn_block(random, round % 3);
    std::array<double, TriangleBlock::size> gap;
    gaps_of_pairs(a, b, gap);
    for (std::size_t lane = 0; lane < gap.size(); ++lane) {
      const double distance = triangle_distance(corners_in(a, lane), corners_in(b, lane)).distance;
      if (std::isnan(gap[lane])) continue;
      EXPECT_LE(gap[lane], distance + 1e-14);
      ++all;
      reached += gap[lane] >= distance - 1e-12;
    }
  }
  EXPECT_GT(reached, all / 2);
}

TEST(TriangleGaps, LeaveAllThatAreNear) {
  reference::Random random(2);
  int near_ones = 0, far_ones = 0;
  const int count = drawn(300, 30);
  for (int round = 0; round < count; ++round) {
    const TriangleBlock a = drawn_block(random, 0), b = drawn_block(random, round % 3);
    const Vec3d way = round % 2 == 0 ? random.direction() : Vec3d(Vec3d::Zero());
    const double limit = random.uniform(0, 1);
    const NearTriangles near = near_triangles(a, 8, b, 7, way, limit);
    for (std::size_t i = 0; i < near.size(); ++i) {
      EXPECT_EQ(near[i] >> 7, 0);
      for (std::size_t j = 0; j < 7; ++j) {
        const bool is_near = (near[i] >> j & 1) != 0;
        ++(is_near ? near_ones : far_ones);
        const double distance = triangle_distance(corners_in(a, i), corners_in(b, j)).distance;
        if (!is_near) {
          EXPECT_GE(distance, limit);
        }
      }
    }
  }
  EXPECT_GT(near_ones, 0);
  EXPECT_GT(far_ones, 0);
}

TEST(TriangleGaps, LeaveWhatIsNoNumber) {
  reference::Random random(3);
  TriangleBlock a = drawn_block(random, 0);
  const TriangleBlock b = drawn_block(random, 9);
  a.at[4][2] = std::numeric_limits<double>::quiet_NaN();
  const NearTriangles near = near_triangles(a, 8, b, 8, Vec3d::Zero(), 1);
  EXPECT_EQ(near[1], 0);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const std::uint8_t bits : near_triangles(a, 8, b, 8, Vec3d::Zero(), infinity)) {
    EXPECT_EQ(bits, 0xff);
  }
}

}  // namespace
}  // namespace touchstone
