#include "algorithms/kernels/minkowski/hull_scan.h"

#include <gtest/gtest.h>

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
        EXPECT_EQ(hull_scan::furthest(std::span<const Block>(blocks), d), best)
            << to_string(level) << ", " << count << " blocks";
      }
    }
  }
  EXPECT_GT(ties, 100);
}

}  // namespace
}  // namespace touchstone
