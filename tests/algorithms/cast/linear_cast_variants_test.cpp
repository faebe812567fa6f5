// Casts of bodies that move without turning: contact at the start, the oracle, and the same question put
// differently.
#include <gtest/gtest.h>

#include <cmath>

#include "algorithms/oracle/oracle.h"
#include "tests/algorithms/cast/linear_cast.h"
#include "tests/algorithms/one_in.h"

namespace touchstone {
namespace {

using namespace reference;

class LinearCastVariants : public LinearCast {};

INSTANTIATE_TEST_SUITE_P(, LinearCastVariants, testing::ValuesIn(proven_casts()), name_of);

// Whether contact at time 0 counts.
TEST_P(LinearCastVariants, TouchingAtTheStart) {
  Random random(8);
  if (!entry().approach) return;
  CastSettings approach;
  approach.start = StartContact::approach;
  approach.tolerance = 1e-9;
  CastSettings always;
  always.tolerance = 1e-9;
  oracle::Oracle oracle;
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
        // The exact one sees what rounding left between them.
        const bool is_exact = entry().info.origin == Origin::oracle;
        if (!is_exact || oracle.verdict({oracle::Solid(c.a), c.pose_a},
                                        {oracle::Solid(c.b), c.pose_b}) == Answer::overlapping) {
          EXPECT_EQ(solve(entry(), c, always).answer, CastAnswer::hit) << c.what;
        }
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
TEST_P(LinearCastVariants, AgreesWithTheOracle) {
  const CastEntry& exact = *registry::find<CastEntry>("exact");
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
TEST_P(LinearCastVariants, MetamorphicVariants) {
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
