// Tests the exchange of bodies in a pair and its outcome.
#include "harness/process/queries/ordered_pair.h"

#include <gtest/gtest.h>

#include <cmath>

namespace touchstone {
namespace {

TEST(OrderedPair, SwapsKindsThatComeInTheOtherOrder) {
  EXPECT_FALSE(process::needs_swap(ShapeKind::sphere, ShapeKind::box));
  EXPECT_FALSE(process::needs_swap(ShapeKind::box, ShapeKind::box));
  EXPECT_TRUE(process::needs_swap(ShapeKind::box, ShapeKind::sphere));
}

TEST(OrderedPair, TheAnswerIsTurnedBack) {
  Outcome outcome;
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  outcome.distance = 2;
  outcome.normal = Vec3d(1, 0, -1);
  outcome.witness_a = Vec3d(1, 2, 3);
  outcome.witness_b = Vec3d(4, 5, 6);
  const Outcome turned = process::swapped(outcome);
  EXPECT_EQ(turned.distance, 2);
  EXPECT_EQ(turned.normal, Vec3d(-1, 0, 1));
  EXPECT_FALSE(std::signbit(turned.normal[1]));
  EXPECT_EQ(turned.witness_a, outcome.witness_b);
  EXPECT_EQ(turned.witness_b, outcome.witness_a);
  EXPECT_TRUE(process::swapped(Outcome{}).normal.hasNaN());
}

}  // namespace
}  // namespace touchstone
