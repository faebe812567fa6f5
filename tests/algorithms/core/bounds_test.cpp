#include "algorithms/core/bounds.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "algorithms/core/isa.h"

namespace {

using namespace touchstone;

// Uniform in [low, high).
double uniform(std::mt19937_64& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

Vec3d direction(std::mt19937_64& random) {
  for (;;) {
    const Vec3d v(uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

Mat3d rotation(std::mt19937_64& random) {
  return Eigen::AngleAxisd(uniform(random, -3, 3), direction(random)).toRotationMatrix();
}

Shape shape_of(ShapeKind kind, std::mt19937_64& random) {
  Shape shape;
  shape.kind = kind;
  shape.radius = uniform(random, 0, 2);
  shape.half_length = uniform(random, 0, 2);
  for (int i = 0; i < 3; ++i) {
    shape.half_extents[i] = uniform(random, 0, 2);
    shape.radii[i] = uniform(random, 0, 2);
  }
  if (kind == ShapeKind::hull) {
    auto hull = std::make_shared<Hull>();
    for (int i = 0; i < 12; ++i) hull->vertices.push_back(2 * direction(random));
    shape.hull = hull;
  }
  return shape;
}

// The farthest point of the shape in a direction of its own frame, in long double.
Vec3<long double> farthest(const Shape& s, const Vec3<long double>& d) {
  using Vec = Vec3<long double>;
  const auto sign = [](long double x) { return x < 0 ? -1.0L : 1.0L; };
  const Vec disc = [&] {
    const long double length = std::hypot(d.x(), d.y());
    return length > 0 ? Vec(s.radius * d.x() / length, s.radius * d.y() / length, 0) : Vec(0, 0, 0);
  }();
  const Vec top(0, 0, s.half_length);
  switch (s.kind) {
    case ShapeKind::sphere: return d.normalized() * s.radius;
    case ShapeKind::capsule: return sign(d.z()) * top + d.normalized() * s.radius;
    case ShapeKind::box:
      return {sign(d.x()) * s.half_extents.x(), sign(d.y()) * s.half_extents.y(),
              sign(d.z()) * s.half_extents.z()};
    case ShapeKind::cylinder: return disc + sign(d.z()) * top;
    case ShapeKind::cone: return d.dot(top) > d.dot(disc - top) ? top : Vec(disc - top);
    case ShapeKind::ellipsoid: {
      const Vec r = s.radii.cast<long double>();
      const Vec q = r.cwiseProduct(d);
      return q.norm() > 0 ? Vec(r.cwiseProduct(q) / q.norm()) : Vec(0, 0, 0);
    }
    case ShapeKind::hull: {
      Vec best = s.hull->vertices[0].cast<long double>();
      for (const Vec3d& v : s.hull->vertices) {
        if (v.cast<long double>().dot(d) > best.dot(d)) best = v.cast<long double>();
      }
      return best;
    }
    case ShapeKind::halfspace: break;
  }
  return Vec::Zero();
}

class BoxOf : public testing::TestWithParam<ShapeKind> {};

TEST_P(BoxOf, HoldsTheBodyAndIsTightAboutIt) {
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Shape shape = shape_of(GetParam(), random);
    const double far = std::pow(10, uniform(random, -3, 6));
    Pose pose;
    pose.rotation = i % 10 == 0 ? Mat3d::Identity() : rotation(random);
    pose.translation = far * direction(random);
    const Aabb tight = tight_box(shape, pose);
    const Aabb loose = loose_box(loose_reach(shape, pose.rotation), pose.translation);
    const Mat3<long double> m = pose.rotation.cast<long double>();
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {-1, 1}) {
        const Vec3<long double> d = m.row(axis).transpose() * side;
        // A sphere's ball is not deformed by the rotation, so its point is sought in the world.
        const bool round = shape.kind == ShapeKind::sphere;
        const long double extent =
            round ? side * static_cast<long double>(shape.radius) : (m * farthest(shape, d))[axis];
        const long double exact = pose.translation[axis] + extent;
        const float face = side > 0 ? tight.max[axis] : tight.min[axis];
        const float loose_face = side > 0 ? loose.max[axis] : loose.min[axis];
        const long double room = side * (static_cast<long double>(face) - exact);
        // The capsule's ball is handled like the sphere's, up to the rounding of the rotation.
        EXPECT_GE(room, shape.kind == ShapeKind::capsule ? -1e-15L * (1 + far) : 0.0L);
        const float ulp = std::nextafter(std::abs(face), 1e30f) - std::abs(face);
        EXPECT_LE(room, 2 * ulp + 1e-12L * (1 + far));
        EXPECT_GE(static_cast<float>(side) * (loose_face - face), -2 * ulp);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(EveryKind, BoxOf,
                         testing::Values(ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                         ShapeKind::cylinder, ShapeKind::cone, ShapeKind::ellipsoid,
                                         ShapeKind::hull),
                         [](const auto& kind) { return std::string(to_string(kind.param)); });

TEST(LooseBox, StaysValidWhileTheBodyTurns) {
  std::mt19937_64 random(11);
  for (int i = 0; i < 300; ++i) {
    const Shape shape = shape_of(ShapeKind::hull, random);
    const Vec3d at = 3 * direction(random);
    const Aabb loose = loose_box(loose_reach(shape, Mat3d::Identity()), at);
    for (int turn = 0; turn < 10; ++turn) {
      const Aabb tight = tight_box(shape, {rotation(random), at});
      for (int axis = 0; axis < 3; ++axis) {
        EXPECT_LE(loose.min[axis], std::nextafter(tight.min[axis], 1e30f));
        EXPECT_GE(loose.max[axis], std::nextafter(tight.max[axis], -1e30f));
      }
    }
  }
}

TEST(TightBox, OfAHalfSpaceIsCutOnlyAlongItsNormalsAxis) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  Shape ground;
  ground.kind = ShapeKind::halfspace;
  ground.normal = {0, 0, 2};
  ground.offset = 3;
  Pose pose;
  pose.translation = {5, 6, 7};
  const Aabb box = tight_box(ground, pose);
  EXPECT_EQ(box.min, (std::array{-inf, -inf, -inf}));
  EXPECT_EQ(box.max[0], inf);
  EXPECT_GE(box.max[2], 8.5f);
  EXPECT_LE(box.max[2], std::nextafter(8.5f, 9.0f));
  ground.normal = {1, 0, 1};
  EXPECT_EQ(tight_box(ground, pose).max, (std::array{inf, inf, inf}));
  // Along x the turned normal is 2^-104, which rounding loses.
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  ground.normal = {1 + epsilon, 1 + 2 * epsilon, 1};
  pose.rotation << 1 + epsilon, -1, 0, 0, 0, 0, 0, 0, 1;
  EXPECT_EQ(tight_box(ground, pose).max, (std::array{inf, inf, inf}));
  // A matrix that shears turns the plane, and one that scales moves it.
  ground.normal = {1, 0, 0};
  pose.rotation << 1, 1e-17, 0, 0, 1, 0, 0, 0, 1;
  EXPECT_EQ(tight_box(ground, pose).max, (std::array{inf, inf, inf}));
  pose.rotation = 1.5 * Mat3d::Identity();
  EXPECT_GE(tight_box(ground, pose).max[0], 9.5f);
  EXPECT_LE(tight_box(ground, pose).max[0], std::nextafter(9.5f, 10.0f));
  pose.rotation << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  EXPECT_EQ(tight_box(ground, pose).max, (std::array{inf, inf, std::nextafter(10.0f, 11.0f)}));
  ground.normal = {0, 0, 2};
  EXPECT_EQ(tight_box(ground, pose).max, (std::array{inf, inf, inf}));
  EXPECT_LE(tight_box(ground, pose).min[0], 3.5f);
  EXPECT_GE(tight_box(ground, pose).min[0], std::nextafter(3.5f, 3.0f));
}

TEST(Rounding, IsOutwardAndExactWhereItCanBe) {
  EXPECT_EQ(round_down(0.5), 0.5f);
  EXPECT_EQ(round_up(0.5), 0.5f);
  EXPECT_LT(static_cast<double>(round_down(0.1)), 0.1);
  EXPECT_GT(static_cast<double>(round_up(0.1)), 0.1);
  EXPECT_EQ(std::nextafter(round_down(0.1), 1.0f), round_up(0.1));
  EXPECT_EQ(round_up(1e300), std::numeric_limits<float>::infinity());
  EXPECT_EQ(round_down(1e300), std::numeric_limits<float>::max());
  EXPECT_EQ(round_up(1e-300), std::numeric_limits<float>::denorm_min());
}

// Numbers of every size down to those that floats do not have, floats among them.
TEST(Rounding, IsThatOfTheNextFloat) {
  std::mt19937_64 random(7);
  constexpr float infinite = std::numeric_limits<float>::infinity();
  int lowered = 0, kept = 0;
  const auto expect = [&](double x) {
    const auto f = static_cast<float>(x);
    const bool is_above = static_cast<double>(f) > x;
    const float down = is_above ? std::nextafter(f, -infinite) : f;
    EXPECT_EQ(round_down(x), down) << x;
    EXPECT_EQ(round_up(-x), -down) << x;
    EXPECT_EQ(std::signbit(round_down(x)), std::signbit(down)) << x;
    ++(is_above ? lowered : kept);
  };
  for (int round = 0; round < 20'000; ++round) {
    const double x = std::ldexp(uniform(random, -1, 1), static_cast<int>(random() % 330) - 190);
    expect(x);
    expect(static_cast<double>(static_cast<float>(x)));
  }
  for (const double x :
       {0.0, 1e-60, 0x1p-150, 0x1p-149, 0x1.8p-149, 0x1p-126, 0x1.fffffefp-127, 0x1.fffffep127,
        0x1.fffffefp127, 0x1p128, 1e300, std::numeric_limits<double>::denorm_min(),
        std::numeric_limits<double>::infinity()}) {
    expect(x);
    expect(-x);
  }
  EXPECT_GT(lowered, 5'000);
  EXPECT_GT(kept, 20'000);
}

TEST(Overlap, IsClosedAndTheEmptyBoxOverlapsNothing) {
  const Aabb a{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(overlap(a, {{1, 1, 1}, {2, 2, 2}}));
  EXPECT_FALSE(overlap(a, {{std::nextafter(1.0f, 2.0f), 0, 0}, {2, 1, 1}}));
  EXPECT_TRUE(overlap({{-0.0f, 0, 0}, {-0.0f, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}));
  EXPECT_FALSE(overlap(Aabb::empty(), a));
  EXPECT_FALSE(overlap(Aabb::empty(), Aabb::empty()));
  EXPECT_TRUE(Aabb::empty().is_empty());
}

TEST(Isa, CanBeHeldDownButNotUp) {
  const Isa best = isa_of_machine();
  limit_isa(Isa::baseline);
  EXPECT_EQ(isa(), Isa::baseline);
  limit_isa(Isa::avx512);
  EXPECT_EQ(isa(), best);
}

}  // namespace
