// A plane that bodies carry says that they are apart only if they are.
#include "algorithms/kernels/gjk/carried_plane.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/kernels/gjk/placed_pair.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using namespace reference;

Shape shape_of(Random& random, double size) {
  switch (random.below(5)) {
    case 0: return make_sphere(size);
    case 1: return make_capsule(0.3 * size, 0.7 * size);
    case 2: return make_cone(0.6 * size, 0.5 * size);
    case 3: return hull_somewhere(random, size, 8);
    default: return make_box(size, 0.5 * size, 1e-3 * size);
  }
}

// Greatest distance of a point from the origin.
double radius_of(const Shape& shape) {
  switch (shape.kind) {
    case ShapeKind::sphere: return shape.radius;
    case ShapeKind::capsule: return shape.radius + shape.half_length;
    case ShapeKind::cone: return std::hypot(shape.radius, shape.half_length);
    case ShapeKind::box: return shape.half_extents.norm();
    default: {
      double radius = 0;
      for (const Vec3d& v : shape.hull->vertices) radius = std::max(radius, v.norm());
      return radius;
    }
  }
}

void turn(Random& random, double most, Pose& pose) {
  const double angle = most * random.uniform(-1, 1);
  pose.rotation = Eigen::AngleAxisd(angle, random.direction()).toRotationMatrix() * pose.rotation;
}

struct Pair : PlacedPair {
  CarriedPlane plane(const Vec3d& normal, double gap) const {
    return CarriedPlane::make(normal, gap, radius_of(a), pose_a, radius_of(b), pose_b);
  }
  bool part(const CarriedPlane& plane) const { return plane.parts(pose_a, pose_b); }
};

// A pair that is apart by `share` of its size.
Pair pair_apart(Random& random, double size, double share, oracle::Oracle& oracle) {
  Pair pair{{shape_of(random, size), shape_of(random, size * std::pow(10, random.uniform(-2, 0)))}};
  pair.place(random, size, share * size, oracle);
  return pair;
}

TEST(CarriedPlane, PartsOnlyWhatIsApart) {
  Random random(5);
  oracle::Oracle oracle;
  int still = 0, lost = 0, met = 0, unmoved = 0;
  for (int n = 0; n < drawn(3000, 300); ++n) {
    const double size = std::pow(10, random.uniform(-6, 6));
    const double share = std::pow(10, random.uniform(-4, 0));
    Pair pair = pair_apart(random, size, share, oracle);
    const oracle::Measure before = pair.measure(oracle);
    ASSERT_GT(before.lower, 0);
    const CarriedPlane plane = pair.plane(before.normal, before.lower * (1 - 1e-9));
    unmoved += pair.part(plane);
    const double most = share * std::pow(10, random.uniform(-2, 0.5));
    for (int frame = 0; frame < 6; ++frame) {
      // The pair turns as a whole, and either body by itself.
      const Pose whole{random.rotation(), random.vector(5 * size)};
      for (Pose* pose : {&pair.pose_a, &pair.pose_b}) {
        *pose = {whole.rotation * pose->rotation, whole(pose->translation)};
        turn(random, most, *pose);
        pose->translation += random.vector(most * size / 3);
      }
      const bool apart = pair.measure(oracle).lower > 0;
      const bool part = pair.part(plane);
      EXPECT_TRUE(apart || !part) << n << ", frame " << frame;
      ++(part ? still : apart ? lost : met);
    }
  }
  const int all = drawn(3000, 300);
  EXPECT_GT(unmoved, all * 4 / 5);
  EXPECT_GT(still, all);
  EXPECT_GT(lost, all / 2);
  EXPECT_GT(met, all / 10);
}

TEST(CarriedPlane, CarriesADirectionAlone) {
  Pair pair{{make_sphere(1), make_sphere(1)}};
  pair.pose_b.translation = {3, 0, 0};
  const Vec3d x = Vec3d::UnitX();
  EXPECT_TRUE(pair.part(pair.plane(x, 1)));
  EXPECT_FALSE(pair.part(pair.plane(x, 0)));
  EXPECT_NEAR(pair.plane(x, 0).normal(pair.pose_a, pair.pose_b).x(), 1, 1e-6);
  EXPECT_TRUE(CarriedPlane{}.normal(pair.pose_a, pair.pose_b).isZero(0));
  EXPECT_FALSE(pair.part(CarriedPlane{}));
}

TEST(CarriedPlane, IsEmptyBeyondTheRangeOfItsNumbers) {
  for (const double size : {1e39, 1e200, std::numeric_limits<double>::infinity()}) {
    Pair pair{{make_sphere(size), make_sphere(size)}};
    pair.pose_b.translation = {3 * size, 0, 0};
    EXPECT_FALSE(pair.part(pair.plane(Vec3d::UnitX(), size))) << size;
  }
  // Lengths below the least float are rounded up to it, and prove nothing.
  Pair pair{{make_sphere(1e-60), make_sphere(1e-60)}};
  pair.pose_b.translation = {3e-60, 0, 0};
  EXPECT_FALSE(pair.part(pair.plane(Vec3d::UnitX(), 1e-60)));
}

// A matrix that stretches makes a body reach further than it did.
TEST(CarriedPlane, HeedsMatricesThatStretch) {
  Pair pair{{make_box(1, 1, 1), make_box(1, 1, 1)}};
  pair.pose_b.translation = {2.5, 0, 0};
  const CarriedPlane plane = pair.plane(Vec3d::UnitX(), 0.4);
  EXPECT_TRUE(pair.part(plane));
  for (const double factor : {1.6, 3.0, 1e3, 1e9}) {
    Pair stretched = pair;
    stretched.pose_a.rotation *= factor;
    EXPECT_FALSE(stretched.part(plane)) << factor;
    stretched = pair;
    stretched.pose_b.rotation *= factor;
    EXPECT_FALSE(stretched.part(plane)) << factor;
    stretched = pair;
    stretched.pose_b.rotation(0, 1) += factor;
    EXPECT_FALSE(stretched.part(plane)) << factor;
  }
}

// Changes one bit, or two if they are not the same.
CarriedPlane with_bits_changed(const CarriedPlane& plane, std::size_t one, std::size_t other) {
  std::array<unsigned char, sizeof plane> bytes;
  std::memcpy(bytes.data(), &plane, sizeof plane);
  bytes[one / 8] ^= static_cast<unsigned char>(1u << one % 8);
  if (other != one) bytes[other / 8] ^= static_cast<unsigned char>(1u << other % 8);
  CarriedPlane changed;
  std::memcpy(&changed, bytes.data(), sizeof changed);
  return changed;
}

// Whatever is changed in memory, it is not believed.
TEST(CarriedPlane, BelievesOnlyWhatItWrote) {
  Random random(6);
  Pair pair{{make_sphere(1), make_sphere(1)}};
  pair.pose_b.translation = {3, 0, 0};
  const CarriedPlane plane = pair.plane(Vec3d::UnitX(), 1);
  EXPECT_TRUE(pair.part(plane));
  constexpr std::size_t bits = 8 * sizeof plane;
  for (std::size_t one = 0; one < bits; ++one) {
    EXPECT_FALSE(pair.part(with_bits_changed(plane, one, one))) << one;
    for (std::size_t other = one; other < bits; ++other) {
      EXPECT_FALSE(with_bits_changed(plane, one, other).is_own()) << one << ", " << other;
    }
  }
}

}  // namespace
}  // namespace touchstone
