// How far cores reach along a direction, without the point that does.
#include <gtest/gtest.h>

#include "algorithms/kernels/minkowski/posed_shape.h"
#include "harness/base/random.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

TEST(SupportValue, IsThatOfTheSupportPoint) {
  base::Random random(3);
  const std::array shapes = {make_sphere(0.5),
                             make_capsule(0.25, 0.5),
                             make_cylinder(0.25, 0.5),
                             make_cone(0.25, 0.5),
                             make_box(0.25, 0.5, 0.75),
                             make_ellipsoid(0.25, 0.5, 0.75),
                             make_hull({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})};
  for (const Shape& shape : shapes) {
    const SupportShape<double> support(shape);
    for (int i = 0; i < 20; ++i) {
      PosedShape<double> posed(support, random.rotation(), 2);
      const Vec3d direction = random.uniform(0.1, 2) * random.on_sphere();
      const double value = posed.support_value(direction);
      EXPECT_NEAR(value, direction.dot(posed.support(direction)), 1e-15) << to_string(shape.kind);
      // No other point reaches further.
      EXPECT_GE(value, direction.dot(posed.support(random.on_sphere())) - 1e-15);
    }
  }
}

}  // namespace
}  // namespace touchstone
