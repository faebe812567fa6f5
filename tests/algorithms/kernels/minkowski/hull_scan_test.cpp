#include "algorithms/kernels/minkowski/hull_scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace touchstone {
namespace {

template <class Scalar>
class HullScan : public testing::Test {
 protected:
  void TearDown() override { limit_isa(isa_of_machine()); }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(HullScan, Scalars);

// Few different coordinates, so that many vertices are equally far and the first is asked for.
TYPED_TEST(HullScan, IsTheFirstOfTheFurthestAtEveryLevel) {
  using Block = hull_scan::VertexBlock<TypeParam>;
  std::mt19937 random(7);
  std::uniform_int_distribution<int> coordinate(-3, 3);
  const auto draw = [&] { return static_cast<TypeParam>(coordinate(random)); };
  int ties = 0;
  for (const std::size_t count : {1u, 2u, 3u, 4u, 5u, 12u, 16u, 17u, 40u}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::vector<Block> blocks(count);
      for (Block& block : blocks) {
        for (std::size_t i = 0; i < Block::size; ++i) {
          block.x[i] = draw();
          block.y[i] = draw();
          block.z[i] = draw();
        }
      }
      const Vec3<TypeParam> d{draw(), draw(), draw()};
      std::uint32_t best = 0;
      const auto value = [&](std::uint32_t i) {
        return d.dot(blocks[i / Block::size].vertex(i % Block::size));
      };
      for (std::uint32_t i = 1; i < count * Block::size; ++i) {
        if (value(i) > value(best)) best = i;
      }
      for (std::uint32_t i = best + 1; i < count * Block::size; ++i) {
        ties += value(i) == value(best) ? 1 : 0;
      }
      for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
        limit_isa(level);
        EXPECT_EQ(hull_scan::furthest<TypeParam>({blocks}, d), best)
            << to_string(level) << ", " << count << " blocks";
      }
    }
  }
  EXPECT_GT(ties, 100);
}

// The vertices of one hull in double and as floats.
struct BothScans {
  using Block = hull_scan::VertexBlock<double>;

  explicit BothScans(const std::vector<Vec3d>& vertices)
      : blocks(hull_scan::blocks_of<double>(vertices.size(),
                                            [&](std::size_t k) { return vertices[k]; })),
        rough(hull_scan::blocks_of<float>(vertices.size(), [&](std::size_t k) {
          return Vec3<float>(vertices[k].cast<float>());
        })) {}

  // Expects the same vertex from both scans at every level.
  void compare(const Vec3d& d) const {
    for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      limit_isa(level);
      EXPECT_EQ(hull_scan::furthest<double>({blocks, rough.data()}, d),
                hull_scan::furthest<double>({blocks}, d))
          << to_string(level) << ", " << blocks.size() << " blocks, " << d.transpose();
    }
    limit_isa(isa_of_machine());
  }

  // Whether floats have one furthest vertex, and it is another than that in double.
  bool floats_are_wrong(const Vec3d& d) const {
    return hull_scan::furthest<float>({rough}, d.cast<float>()) !=
           hull_scan::furthest<double>({blocks}, d);
  }

  std::vector<Block> blocks;
  std::vector<hull_scan::VertexBlock<float>> rough;
};

TEST(HullScanInFloats, FindsTheSameVertexAtEveryScale) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> coordinate(-1, 1), exponent(-300, 300);
  std::uniform_int_distribution<std::size_t> size(1, hull_scan::most_blocks * 16);
  int wrong_floats = 0, right_floats = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    // Every second hull has its vertices within a few roundings of floats of each other.
    const bool is_small = repeat % 2 == 0;
    std::vector<Vec3d> vertices(size(random));
    const Vec3d about{coordinate(random) / 2, coordinate(random) / 2, coordinate(random) / 2};
    for (Vec3d& v : vertices) {
      v = {coordinate(random), coordinate(random), coordinate(random)};
      if (is_small) v = about + std::pow(2, -22 - repeat % 30) * v;
    }
    const BothScans both(vertices);
    for (int k = 0; k < 8; ++k) {
      Vec3d d{coordinate(random), coordinate(random), coordinate(random)};
      if (k == 1) d = Vec3d::Unit(repeat % 3);
      if (k > 5) d *= std::pow(10, exponent(random));
      both.compare(d);
      if (k < 2) (both.floats_are_wrong(d) ? wrong_floats : right_floats) += 1;
    }
  }
  EXPECT_GT(wrong_floats, 100);
  EXPECT_GT(right_floats, 100);
}

TEST(HullScanInFloats, FindsTheSameVertexInDegenerateDirections) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Vec3d> corners;  // of a cube, many times each
  for (int k = 0; k < 100; ++k) {
    corners.push_back(
        {(k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0});
  }
  const BothScans both(corners);
  for (const Vec3d& d :
       {Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, -1, 1), Vec3d(-1, 1, -1), Vec3d(1, 1e-300, 0),
        Vec3d(1e-40, 1, -1e-17), Vec3d(5e-324, 0, 0), Vec3d(1e308, 1e308, 1e308),
        Vec3d(infinity, 1, 0), Vec3d(nan, 1, 0), Vec3d(nan, nan, nan)}) {
    both.compare(d);
  }
}

}  // namespace
}  // namespace touchstone
