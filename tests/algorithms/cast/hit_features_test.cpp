// What a hit of a cast tells besides its time: the normal and the point, and contact at the start of bodies
// that turn.
#include <gtest/gtest.h>

#include "algorithms/oracle/cast/prove_cast.h"
#include "algorithms/oracle/certificates/cast_certificate_check.h"
#include "harness/families/grid_touches.h"
#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using namespace reference;

class HitFeatures : public LinearCast {
 protected:
  // How far a point is from a body at a time.
  double away(const Shape& shape, const Pose& pose, const Motion& motion, double time,
              const Vec3d& point) {
    const Shape spot = families::round_shape(ShapeKind::sphere, 0, 0);
    const oracle::Solid solid(shape), of_spot(spot);
    Pose there;
    there.translation = point;
    return oracle_.measure({solid, pose_at(pose, motion, time)}, {of_spot, there}).lower;
  }

  // Asks for the cast and checks what it tells of a hit that is not in the middle of an overlap.
  void check_features(const MovingPairCase& c) {
    if (!takes(c)) return;
    const CastOutcome outcome = solve(entry(), c);
    if (outcome.answer != CastAnswer::hit || outcome.status != Status::ok) return;
    ++counts.hits;
    EXPECT_NEAR(outcome.normal.norm(), 1, 1e-9) << c.what;
    const auto [a, b] = std::minmax(c.a.kind, c.b.kind);
    if (entry().lacks_point != nullptr && entry().lacks_point(a, b) && outcome.point.hasNaN()) {
      ++counts.unknown;
      return;
    }
    constexpr double near = 1e-6;
    EXPECT_LE(away(c.a, c.pose_a, c.motion_a, outcome.toi, outcome.point), near) << c.what;
    EXPECT_LE(away(c.b, c.pose_b, c.motion_b, outcome.toi, outcome.point), near) << c.what;
  }

  oracle::Oracle oracle_;
};

INSTANTIATE_TEST_SUITE_P(, HitFeatures, testing::ValuesIn(proven_casts()), name_of);

TEST_P(HitFeatures, OfBodiesThatMoveWithoutTurning) {
  Random random(51);
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (const ContactFeature feature : features) {
      for (int i = 0; i < drawn(3, 1); ++i) {
        check_features(
            meeting(a, b, feature, random.uniform(0.1, 0.9), random.uniform(0.5, 4), random));
      }
    }
  });
  EXPECT_GT(counts.hits, 0);
  // Not all of those that may lack a point do.
  EXPECT_LT(counts.unknown, counts.hits);
}

// At time 0 a point may be unknown. One that is told is in both bodies, however deep and unlike they are.
TEST_P(HitFeatures, OfBodiesThatOverlapAtTheStart) {
  Random random(54);
  int told = 0;
  for_each_pair_of_kinds([&](ShapeKind a, ShapeKind b) {
    for (int i = 0; i < drawn(6, 2); ++i) {
      MovingPairCase c = meeting(a, b, ContactFeature::vertices, 0.5, 2, random);
      // The bodies' origins come near each other, or all but meet.
      c.pose_b.translation = c.pose_a.translation + random.vector(i % 2 == 0 ? 0.3 : 1e-3);
      if (i % 3 == 0) {
        c.a.radius *= 4;
        c.a.half_extents *= 4;
        c.a.radii *= 4;
      }
      if (!takes(c)) continue;
      const CastOutcome outcome = solve(entry(), c);
      const bool is_at_start = outcome.answer == CastAnswer::hit && !(outcome.toi > 0);
      if (!is_at_start || outcome.status != Status::ok || outcome.point.hasNaN()) continue;
      ++told;
      EXPECT_LE(away(c.a, c.pose_a, c.motion_a, 0, outcome.point), 1e-6) << c.what << ' ' << i;
      EXPECT_LE(away(c.b, c.pose_b, c.motion_b, 0, outcome.point), 1e-6) << c.what << ' ' << i;
    }
  });
  EXPECT_GT(told, 0);
}

TEST_P(HitFeatures, OfBodiesThatTurn) {
  if (!entry().rotation) return;
  constexpr std::array kinds = {ShapeKind::sphere, ShapeKind::capsule, ShapeKind::box,
                                ShapeKind::hull};
  Random random(52);
  for (int i = 0; i < drawn(48, 16); ++i) {
    MovingPairCase c =
        meeting(kinds[static_cast<std::size_t>(i) % 4], kinds[static_cast<std::size_t>(i) / 4 % 4],
                ContactFeature::vertices, random.uniform(0.2, 0.8), 2, random);
    c.motion_a.rotation_vector = random.vector(0.3);
    c.motion_b.rotation_vector = random.vector(0.3);
    check_features(c);
  }
  EXPECT_GT(counts.hits, drawn(24, 8));
}

// However a body turns after it: the poses of the start are given, so that a touch there is exact.
TEST(ExactCastAtTheStart, IsAHitOfBodiesThatTouchAndTurn) {
  Random random(53);
  oracle::Oracle oracle;
  int touches = 0, others = 0;
  for (int i = 0; i < drawn(80, 20); ++i) {
    MovingPairCase c = families::touching_on_grid(static_cast<families::AfterTouch>(i % 4), random);
    c.motion_b.rotation_vector = random.vector(1);
    if (i % 5 == 0) c.pose_b.translation += 0x1p-40 * c.normal;
    const oracle::Solid a(c.a), b(c.b);
    const bool touch = oracle.verdict({a, c.pose_a}, {b, c.pose_b}) == Answer::touching;
    const CastOutcome outcome = solve(*registry::find<CastEntry>("exact"), c);
    ++(touch ? touches : others);
    if (!touch) {
      EXPECT_FALSE(outcome.upper <= 0) << c.what << " " << i;
      continue;
    }
    EXPECT_EQ(outcome.status, Status::ok) << c.what << " " << i;
    EXPECT_EQ(outcome.answer, CastAnswer::hit) << c.what << " " << i;
    EXPECT_EQ(outcome.upper, 0) << c.what << " " << i;
    EXPECT_FALSE(outcome.point.hasNaN()) << c.what << " " << i;
    oracle::CastCertificate certificate;
    oracle::prove_cast(oracle, oracle::enclosed(c.a, a, c.pose_a, c.motion_a),
                       oracle::enclosed(c.b, b, c.pose_b, c.motion_b), 1e-9, certificate);
    EXPECT_EQ(oracle::fault(certificate, {{a, c.pose_a}, c.motion_a}, {{b, c.pose_b}, c.motion_b}),
              "")
        << c.what << " " << i;
  }
  EXPECT_GT(touches, drawn(20, 5));
  EXPECT_GT(others, drawn(8, 2));
}

}  // namespace
}  // namespace touchstone
