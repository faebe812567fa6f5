// Casts of bodies that move without turning, against the truth by construction.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/algorithms/cast/moving_bodies.h"
#include "tests/algorithms/one_in.h"
#include "tests/algorithms/shapes.h"

namespace touchstone {
namespace {

using namespace reference;

constexpr std::array bounded_kinds = {ShapeKind::sphere,   ShapeKind::capsule, ShapeKind::box,
                                      ShapeKind::cylinder, ShapeKind::cone,    ShapeKind::ellipsoid,
                                      ShapeKind::hull};
constexpr std::array features = {ContactFeature::vertices, ContactFeature::face,
                                 ContactFeature::edges};

// The casts that must be right.
std::vector<const CastEntry*> proven_casts() {
  std::vector<const CastEntry*> all;
  for (const CastEntry& entry : casts()) {
    if (entry.info.origin != Origin::peer) all.push_back(&entry);
  }
  return all;
}

template <class Visit>
void for_each_pair_of_kinds(const Visit& visit) {
  for (const ShapeKind a : bounded_kinds) {
    for (const ShapeKind b : bounded_kinds) visit(a, b);
  }
}

class LinearCast : public testing::TestWithParam<const CastEntry*> {
 protected:
  const CastEntry& entry() const { return *GetParam(); }
  bool takes(const MovingPairCase& c) const {
    return offers(entry(), c.a.kind, c.b.kind, c.motion_a.turns() || c.motion_b.turns());
  }
  void check(const MovingPairCase& c, double tolerance) {
    if (!takes(c)) return;
    ++asked;
    CastSettings settings;
    settings.tolerance = tolerance;
    expect_true(entry(), c, solve(entry(), c, settings), tolerance, counts);
  }

  CastCounts counts;
  int asked = 0;
};

std::string name_of(const testing::TestParamInfo<const CastEntry*>& tested) {
  std::string name = tested.param->info.name;
  std::erase(name, '-');
  return name;
}

INSTANTIATE_TEST_SUITE_P(, LinearCast, testing::ValuesIn(proven_casts()), name_of);

TEST_P(LinearCast, BodiesThatMeetAreHitInTime) {
  Random random(1);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const ContactFeature feature : features) {
      for (int i = 0; i < drawn(12, 4); ++i) {
        const double toi = i == 0 ? 1 : i == 1 ? 1e-9 : random.uniform(0, 1);
        const double path = std::pow(10, random.uniform(-3, 3));
        check(meeting(a, b, feature, toi, path, random), 1e-9);
      }
    }
  });
  EXPECT_LE(counts.unknown, asked / 100);
  EXPECT_GE(counts.brackets, asked / 2);
}

TEST_P(LinearCast, BodiesThatPassAreMissed) {
  Random random(2);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const double gap : {1.0, 1e-3, 1e-6, 1e-8}) {
      for (int i = 0; i < drawn(6, 1); ++i) {
        check(passing(a, b, features[static_cast<std::size_t>(i) % 3], gap,
                      std::pow(10, random.uniform(-2, 1)), random),
              1e-9);
      }
    }
  });
  EXPECT_EQ(counts.hits, 0);
  EXPECT_LE(counts.unknown, asked / 50);
}

TEST_P(LinearCast, BodiesThatGrazeAreNeverMissed) {
  Random random(3);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const double depth : {1e-6, 1e-12, 0.0}) {
      // An exact answer tells bodies that rounding has parted.
      if (depth == 0 && entry().info.origin == Origin::oracle) continue;
      for (int i = 0; i < drawn(6, 1); ++i) {
        MovingPairCase c = passing(a, b, features[static_cast<std::size_t>(i) % 3], -depth,
                                   random.uniform(0.5, 4), random);
        // Rounding of the placement may part bodies that only touch.
        if (depth == 0) {
          c.hit = false;
          c.gap = 0;
        }
        check(c, 1e-9);
      }
    }
  });
  EXPECT_GE(counts.hits, asked * 9 / 10);
}

TEST_P(LinearCast, EveryScaleAndPath) {
  Random random(4);
  for (int i = 0; i < drawn(1500, 100); ++i) {
    const ShapeKind a = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    const ShapeKind b = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    const ContactFeature feature = features[static_cast<std::size_t>(random.below(3))];
    const double scale = std::ldexp(1, random.below(41) - 20);
    const double path = std::pow(10, random.uniform(-12, 6));
    check(scaled(meeting(a, b, feature, random.uniform(0, 1), path, random), scale),
          scale * std::max(1e-9, 1e-12 * path));
    check(scaled(passing(a, b, feature, 1e-6 + 1e-8 * path, path, random), scale),
          scale * std::max(1e-9, 1e-12 * path));
  }
  EXPECT_GE(counts.hits, asked / 3);
  EXPECT_GE(counts.misses, asked / 3);
  EXPECT_LE(counts.unknown, asked / 50);
}

// The kinds with closed forms, by themselves.
TEST_P(LinearCast, BallsAndCapsules) {
  Random random(41);
  for (int i = 0; i < drawn(2000, 200); ++i) {
    const ShapeKind a = ShapeKind::sphere;
    const ShapeKind b = i % 2 == 0 ? ShapeKind::sphere : ShapeKind::capsule;
    const double scale = std::ldexp(1, random.below(41) - 20);
    const double path = std::pow(10, random.uniform(-6, 4));
    const double gap = std::pow(10, random.uniform(-7, 0)) + 1e-8 * path;
    check(
        scaled(meeting(a, b, ContactFeature::vertices, random.uniform(0, 1), path, random), scale),
        scale * 1e-9);
    check(scaled(passing(a, b, ContactFeature::face, gap, path, random), scale), scale * 1e-9);
    check(scaled(passing(a, b, ContactFeature::face, -gap, path, random), scale), scale * 1e-9);
  }
  EXPECT_GE(counts.hits, asked / 2);
  EXPECT_GE(counts.misses, asked / 4);
  EXPECT_EQ(counts.unknown, 0);
}

TEST_P(LinearCast, BodiesThatMoveAlikeOrNotAtAll) {
  Random random(5);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const double gap : {1e-6, 0.3, -1e-6, -0.2}) {
      MovingPairCase c = passing(a, b, ContactFeature::face, gap, 0, random);
      c.motion_a = c.motion_b = {};
      c.toi = 0;
      check(c, 1e-9);
      check(drifting(c, random.vector(10)), 1e-9);
    }
  });
  EXPECT_GE(counts.hits, asked * 2 / 5);
  EXPECT_GE(counts.misses, asked * 2 / 5);
}

TEST_P(LinearCast, ThinPlatesStopBullets) {
  Random random(6);
  const Shape plate = make_box(1, 1, 1e-4);
  for (int i = 0; i < drawn(200, 20); ++i) {
    MovingPairCase c;
    c.what = "a bullet through a plate";
    c.a = plate;
    c.b = i % 2 == 0 ? make_sphere(0.01) : make_box(0.01, 0.01, 0.01);
    c.pose_b.translation = {random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), 1};
    c.motion_b.displacement = {0, 0, random.uniform(-40, -2)};
    c.hit = true;
    c.speed = -c.motion_b.displacement.z();
    c.toi = (1 - 0.01 - 1e-4) / c.speed;
    c.doubt = 1e-13;
    check(c, 1e-9);
  }
  EXPECT_EQ(counts.hits, asked);
}

TEST_P(LinearCast, HalfSpaces) {
  Random random(7);
  for (const ShapeKind kind : bounded_kinds) {
    for (int i = 0; i < drawn(60, 5); ++i) {
      MovingPairCase c;
      c.what = "a half-space and a " + std::string(to_string(kind));
      c.a = random_shape(kind, random);
      c.pose_a = {random.rotation(), random.vector(2)};
      const Vec3d normal = random.direction();
      c.b = make_halfspace(3 * normal, 3 * random.uniform(-1, 1));
      const Vec3d low = support_point(c.a, c.pose_a, -normal);
      const double gap = random.uniform(0.01, 1);
      c.pose_b.translation = (normal.dot(low) - c.b.offset / 3 - gap) * normal;
      const double speed =
          i % 2 == 0 ? random.uniform(1.01, 9) * gap : random.uniform(-3, 0.99) * gap;
      c.motion_a.displacement = -speed * normal + normal.cross(random.vector(5));
      c.hit = speed > gap;
      c.speed = speed;
      c.toi = gap / speed;
      c.gap = gap - std::max(speed, 0.0);
      c.doubt = 1e-13 / gap;
      check(c, 1e-9);
    }
  }
  if (asked > 0) {
    EXPECT_GT(counts.hits, asked / 3);
    EXPECT_GT(counts.misses, asked / 3);
  }
}

// Whether contact at time 0 counts.
TEST_P(LinearCast, TouchingAtTheStart) {
  Random random(8);
  if (!entry().approach) return;
  CastSettings approach;
  approach.start = StartContact::approach;
  approach.tolerance = 1e-9;
  CastSettings always;
  always.tolerance = 1e-9;
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const ContactFeature feature : features) {
      for (const double depth : {0.0, 1e-12, 1e-10, 0.1}) {
        MovingPairCase c = passing(a, b, feature, -depth, 0, random);
        if (!offers(entry(), a, b, false)) continue;
        if (depth < 1e-3) {
          EXPECT_EQ(solve(entry(), c, approach).answer, CastAnswer::miss) << c.what << ": at rest";
        } else {
          EXPECT_EQ(solve(entry(), c, approach).answer, CastAnswer::hit) << c.what << ": deep";
        }
        EXPECT_EQ(solve(entry(), c, always).answer, CastAnswer::hit) << c.what;
        if (depth > 1e-3) continue;
        c.motion_b.displacement = c.normal;
        EXPECT_EQ(solve(entry(), c, approach).answer, CastAnswer::miss) << c.what << ": apart";
        c.motion_b.displacement = 0.5 * c.inward;
        EXPECT_EQ(solve(entry(), c, approach).answer, CastAnswer::hit) << c.what << ": into";
      }
    }
  });
}

// Pairs that were not made to meet: the brackets of an algorithm and of the oracle share the truth.
TEST_P(LinearCast, AgreesWithTheOracle) {
  const CastEntry& exact = *find_cast("exact");
  if (&entry() == &exact) return;
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::hull};
  Random random(10);
  for (int i = 0; i < drawn(400, 40); ++i) {
    MovingPairCase c;
    c.a = random_shape(kinds[static_cast<std::size_t>(random.below(4))], random);
    c.b = random_shape(kinds[static_cast<std::size_t>(random.below(4))], random);
    c.pose_a.rotation = random.rotation();
    c.pose_b = {random.rotation(), random.uniform(1, 5) * random.direction()};
    c.motion_a.displacement = random.vector(1);
    c.motion_b.displacement = random.vector(3) - 0.7 * c.pose_b.translation;
    if (!takes(c)) continue;
    ++asked;
    const CastOutcome ours = solve(entry(), c), truth = solve(exact, c);
    ASSERT_EQ(truth.status, Status::ok);
    if (ours.answer == CastAnswer::unknown) {
      ++counts.unknown;
      continue;
    }
    EXPECT_EQ(ours.answer, truth.answer) << "number " << i;
    if (truth.answer == CastAnswer::hit) {
      ++counts.hits;
      EXPECT_LE(ours.lower, truth.upper) << "number " << i;
      EXPECT_FALSE(ours.upper < truth.lower) << "number " << i;
    } else {
      ++counts.misses;
    }
  }
  EXPECT_GE(counts.hits, asked / 5);
  EXPECT_GE(counts.misses, asked / 5);
  EXPECT_LE(counts.unknown, asked / 100);
}

// The same question put differently.
TEST_P(LinearCast, MetamorphicVariants) {
  Random random(9);
  for (int i = 0; i < drawn(600, 60); ++i) {
    const ShapeKind a = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    const ShapeKind b = bounded_kinds[static_cast<std::size_t>(random.below(7))];
    MovingPairCase c = i % 2 == 0 ? meeting(a, b, ContactFeature::vertices, random.uniform(0, 1),
                                            random.uniform(0.5, 4), random)
                                  : passing(a, b, ContactFeature::face, 1e-4, 2, random);
    if (!takes(c) || !c.squarely) continue;
    ++asked;
    const CastOutcome first = solve(entry(), c);
    const CastOutcome other = solve(entry(), reference::swapped(c));
    EXPECT_EQ(first.answer, other.answer) << c.what;
    const CastOutcome large = solve(entry(), scaled(c, 0x1p30));
    EXPECT_EQ(first.answer, large.answer) << c.what;
    // Backwards: a miss stays one.
    MovingPairCase back = c;
    back.pose_a.translation += c.motion_a.displacement;
    back.pose_b.translation += c.motion_b.displacement;
    back.motion_a.displacement *= -1;
    back.motion_b.displacement *= -1;
    EXPECT_EQ(first.answer, solve(entry(), back).answer) << c.what;
    // Only the first half, and only the second.
    MovingPairCase early = c, late = c;
    for (Motion* m : {&early.motion_a, &early.motion_b}) m->displacement *= 0.5;
    late.motion_a = early.motion_a;
    late.motion_b = early.motion_b;
    late.pose_a.translation += early.motion_a.displacement;
    late.pose_b.translation += early.motion_b.displacement;
    const bool either = solve(entry(), early).answer == CastAnswer::hit ||
                        solve(entry(), late).answer == CastAnswer::hit;
    EXPECT_EQ(first.answer == CastAnswer::hit, either) << c.what;
    if (first.answer != CastAnswer::hit) continue;
    EXPECT_NEAR(first.toi, other.toi, 1e-8 / c.speed) << c.what;
    EXPECT_NEAR(first.toi, large.toi, 1e-8 / c.speed) << c.what;
    ++counts.hits;
  }
  EXPECT_GE(counts.hits, asked / 5);
}

}  // namespace
}  // namespace touchstone
