#include "algorithms/manifold/clipped_faces/manifold_reduction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

namespace touchstone {
namespace {

using Corners = std::vector<PolygonCorner<double>>;

double area(const Corners& corners, const std::array<std::uint32_t, 4>& four) {
  double doubled = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    const auto &p = corners[four[k]], &q = corners[four[(k + 1) % 4]];
    doubled += p.x * q.y - p.y * q.x;
  }
  return doubled / 2;
}

// Of all choices of four that hold one as deep as the deepest.
double greatest_area(const Corners& corners) {
  double depth = 0, best = -1;
  for (const auto& corner : corners) depth = std::max(depth, corner.depth);
  const auto n = static_cast<std::uint32_t>(corners.size());
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = i + 1; j < n; ++j) {
      for (std::uint32_t k = j + 1; k < n; ++k) {
        for (std::uint32_t l = k + 1; l < n; ++l) {
          const std::array<std::uint32_t, 4> four = {i, j, k, l};
          const bool deep = std::ranges::any_of(
              four, [&](std::uint32_t c) { return corners[c].depth >= depth - 1e-12; });
          if (deep) best = std::max(best, area(corners, four));
        }
      }
    }
  }
  return best;
}

TEST(FourPoints, AreTheGreatestWithTheDeepest) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> unit(0, 1);
  int level = 0, all_level = 0;
  for (int round = 0; round < 3000; ++round) {
    const int count = 5 + round % 11;
    std::set<double> angles;
    while (static_cast<int>(angles.size()) < count) {
      angles.insert(2 * std::numbers::pi *
                    (round % 3 == 0 ? std::floor(64 * unit(engine)) / 64 : unit(engine)));
    }
    const double width = std::pow(10.0, -6 * unit(engine));
    Corners corners;
    for (const double angle : angles) {
      PolygonCorner<double> corner{};
      corner.x = std::cos(angle);
      corner.y = width * std::sin(angle);
      corner.depth = round % 2 == 0 ? 1 : std::floor(3 * unit(engine));
      corners.push_back(corner);
    }
    const auto four = choose_four(corners, 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(four));
    const double best = greatest_area(corners);
    EXPECT_GE(area(corners, four), best * (1 - 1e-12)) << round;
    const auto deepest = std::ranges::max_element(
        corners, [](const auto& p, const auto& q) { return p.depth < q.depth; });
    EXPECT_TRUE(std::ranges::any_of(
        four, [&](std::uint32_t k) { return corners[k].depth == deepest->depth; }));
    ++(round % 2 == 0 ? all_level : level);
  }
  EXPECT_GT(level, 1000);
  EXPECT_GT(all_level, 1000);
}

}  // namespace
}  // namespace touchstone
