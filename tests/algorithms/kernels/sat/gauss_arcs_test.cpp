#include "algorithms/kernels/sat/gauss_arcs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "algorithms/core/isa.h"

namespace touchstone {
namespace {

class GaussArcsTest : public testing::Test {
 protected:
  void TearDown() override { limit_isa(isa_of_machine()); }
};

// The middle of the paper's test, in doubles: the arc of a crosses that of b reversed. `least` is
// the smallest of the products' absolute values: how far that is from rounding.
bool crosses(const GaussArc& a, const GaussArc& b, double& least) {
  const auto product = [&](const Vec3<float>& x, const Vec3<float>& y) {
    const double value = x.cast<double>().dot(y.cast<double>());
    least = std::min(least, std::abs(value));
    return value;
  };
  const double b_left = product(b.left, a.direction), b_right = product(b.right, a.direction);
  const double a_left = product(a.left, b.direction), a_right = product(a.right, b.direction);
  return b_left * b_right < 0 && a_left * a_right < 0 && a_left * b_left > 0;
}

TEST_F(GaussArcsTest, ListsAllThatCrossAndNoneThatSurelyDoNot) {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  const auto draw = [&] {
    Vec3<float> left{normal(random), normal(random), normal(random)};
    left.normalize();
    Vec3<float> right = left + 0.7f * Vec3<float>{normal(random), normal(random), normal(random)};
    right.normalize();
    return GaussArc{left.cross(right).normalized(), left, right};
  };
  constexpr double rounding = 1e-4;
  int crossing = 0, apart = 0;
  for (const std::size_t count : {0u, 1u, 15u, 16u, 17u, 100u}) {
    std::vector<GaussArc> arcs;
    GaussArcs listed;
    for (std::size_t i = 0; i < count; ++i) {
      arcs.push_back(draw());
      listed.add(arcs.back());
    }
    EXPECT_EQ(listed.size(), count);
    for (int repeat = 0; repeat < 50; ++repeat) {
      const GaussArc arc = draw();
      std::vector<std::uint32_t> first;
      for (const Isa level : {Isa::baseline, Isa::avx2, Isa::avx512}) {
        limit_isa(level);
        std::vector<std::uint32_t> found;
        listed.list_crossing(arc, found);
        if (level == Isa::baseline) first = found;
        EXPECT_EQ(found, first) << to_string(level);
      }
      EXPECT_TRUE(std::ranges::is_sorted(first));
      for (std::size_t i = 0; i < count; ++i) {
        double least = 1;
        const bool expected = crosses(arc, arcs[i], least);
        if (least < rounding) continue;
        const auto k = static_cast<std::uint32_t>(i);
        EXPECT_EQ(std::ranges::binary_search(first, k), expected) << i << " of " << count;
        ++(expected ? crossing : apart);
      }
    }
  }
  EXPECT_GT(crossing, 200);
  EXPECT_GT(apart, 2000);
}

}  // namespace
}  // namespace touchstone
