// A tetrahedron that is said to have the origin inside has it there wherever rounding may have put
// its corners.
#include "algorithms/kernels/gjk/gjk_iteration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace touchstone {
namespace {

using Exact = Vec3<long double>;

// Returns true if the determinants of the corners by threes keep their signs when all are moved by
// `off` against the sign of each.
template <class Scalar>
bool keeps_signs(const Simplex<Scalar>& simplex, long double off) {
  std::array<Exact, 4> w;
  for (int i = 0; i < 4; ++i) {
    w[static_cast<std::size_t>(i)] =
        simplex.points[static_cast<std::size_t>(i)].difference.template cast<long double>();
  }
  constexpr int faces[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  int positive = 0, negative = 0;
  for (const auto& face : faces) {
    const Exact p = w[static_cast<std::size_t>(face[0])], q = w[static_cast<std::size_t>(face[1])],
                s = w[static_cast<std::size_t>(face[2])];
    const long double before = p.dot(q.cross(s));
    const long double sign = before > 0 ? -off : off;
    const Exact p2 = p + sign * q.cross(s).normalized(), q2 = q + sign * s.cross(p).normalized(),
                s2 = s + sign * p.cross(q).normalized();
    const long double after = p2.dot(q2.cross(s2));
    ++(after > 0 ? positive : negative);
    if ((before > 0) != (after > 0)) return false;
  }
  return positive == 4 || negative == 4;
}

template <class Scalar>
class SurelyInside : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(SurelyInside, Scalars);

TYPED_TEST(SurelyInside, HoldsForCornersThatAreOff) {
  using Scalar = TypeParam;
  constexpr long double u = std::numeric_limits<Scalar>::epsilon() / 2;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto draw = [&] { return Vec3d(unit(random), unit(random), unit(random)); };
  int sure = 0, close = 0, unsure = 0;
  for (int repeat = 0; repeat < 60000; ++repeat) {
    // A face through a place near the origin, of corners near and far; the last one behind it.
    const double size = std::pow(10, -3 * std::abs(unit(random)));
    const Vec3d p = size * std::pow(10, -4 * std::abs(unit(random))) * draw(), q = size * draw();
    const double share = std::abs(unit(random));
    const Vec3d s = -(share * p + (1 - share) * q) * (1 + std::abs(unit(random)));
    const Vec3d normal = p.cross(q).normalized();
    const double height = size * static_cast<double>(u) * std::pow(10, 6 * std::abs(unit(random)));
    Simplex<Scalar> simplex;
    simplex.size = 4;
    const std::array<Vec3d, 4> corners = {p, q, s, size * (draw() + 2 * normal)};
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec3d corner = i < 3 ? Vec3d(corners[i] - height * normal) : corners[i];
      simplex.points[i].difference = corner.template cast<Scalar>();
    }
    std::shuffle(simplex.points.begin(), simplex.points.end(), random);
    if (is_surely_inside(simplex)) {
      ++sure;
      ASSERT_TRUE(keeps_signs(simplex, 107 * u)) << repeat;
      // The quick test alone would leave these open.
      if (!keeps_signs(simplex, 1000 * u)) ++close;
    } else {
      ++unsure;
    }
  }
  EXPECT_GT(sure, 1000);
  EXPECT_GT(close, 100);
  EXPECT_GT(unsure, 1000);
}

}  // namespace
}  // namespace touchstone
