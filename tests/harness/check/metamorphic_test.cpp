// Tests that variants keep the exact answer, and map outcomes back exactly.
#include "harness/kinds/pair/metamorphic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <string>

#include "algorithms/hull/convex_hull.h"
#include "harness/kinds/pair/regimes/regimes.h"
#include "tests/harness/check/exact_answer.h"

namespace touchstone {
namespace {

using oracle::SignedRoot;

SignedRoot scaled(SignedRoot root, int exponent) {
  const int shift = 2 * std::abs(exponent);
  (exponent > 0 ? root.numerator : root.denominator) <<= shift;
  return root;
}

bool is_curved(const Shape& shape) {
  return shape.kind == ShapeKind::cylinder || shape.kind == ShapeKind::cone ||
         shape.kind == ShapeKind::ellipsoid;
}

TEST(SignedPermutation, IsEachRotationOfTheCubeOnce) {
  std::set<std::string> names;
  for (const geometry::SignedPermutation& turn : geometry::signed_permutations()) {
    EXPECT_TRUE(names.insert(turn.name()).second);
    EXPECT_EQ(turn.matrix().determinant(), 1);
    const Vec3d v(1, 2, 3);
    EXPECT_EQ(turn(v), turn.matrix() * v);
    EXPECT_EQ(turn.inverse()(turn(v)), v);
    EXPECT_FALSE(std::signbit(turn(Vec3d(0, 0, 0)).sum()));
  }
  EXPECT_EQ(names.size(), 24u);
  EXPECT_EQ(geometry::signed_permutations().front().matrix(), Mat3d::Identity());
}

// The exact answers of all variants are the original's, to the last bit.
TEST(Metamorphic, VariantsHaveTheSameExactAnswer) {
  oracle::Oracle oracle;
  std::map<std::string, int> kinds;
  std::map<Answer, int> answers;
  for (const kinds::Regime& regime : kinds::regimes()) {
    for (std::uint64_t i = 0; i < 8; ++i) {
      const files::Case c = make(regime, 21, i);
      const oracle::ExactMeasure exact = exact_measure(oracle, c);
      ++answers[exact.answer];
      base::Random random(5, i);
      for (const kinds::Variant& variant : kinds::variants(c, random)) {
        ++kinds[variant.name.substr(0, 5)];
        const oracle::ExactMeasure measure = exact_measure(oracle, variant.transformed);
        const std::string& id = variant.transformed.id;
        EXPECT_EQ(id, c.id + "/" + variant.name);
        if (!exact.exact || !measure.exact) {
          // Curved cores have enclosures of one number, which may differ.
          EXPECT_TRUE(is_curved(c.shape_a) || is_curved(c.shape_b)) << id;
          EXPECT_LE(std::ldexp(measure.lower, -variant.exponent), exact.upper) << id;
          EXPECT_GE(std::ldexp(measure.upper, -variant.exponent), exact.lower) << id;
          continue;
        }
        EXPECT_EQ(measure.answer, exact.answer) << id;
        EXPECT_TRUE(measure.core_lower == scaled(exact.core_lower, variant.exponent)) << id;
      }
    }
  }
  for (const Answer answer : {Answer::separated, Answer::touching, Answer::overlapping}) {
    EXPECT_GT(answers[answer], 30);
  }
  EXPECT_GT(kinds["swap"], 300);
  EXPECT_GT(kinds["rotat"], 300);
  EXPECT_GT(kinds["trans"], 150);
  EXPECT_GT(kinds["scale"], 600);
  EXPECT_GT(kinds["verti"], 100);
}

bool same_bits(double x, double y) {
  return (std::isnan(x) && std::isnan(y)) || (x == y && std::signbit(x) == std::signbit(y));
}
bool same_bits(const Vec3d& u, const Vec3d& v) {
  return same_bits(u.x(), v.x()) && same_bits(u.y(), v.y()) && same_bits(u.z(), v.z());
}

TEST(Metamorphic, OutcomesComeBackExactly) {
  Outcome outcome;
  outcome.answer = Answer::separated;
  outcome.status = Status::ok;
  outcome.distance = 0.1;
  outcome.lower = 0.09;
  outcome.normal = {0.6, 0, 0.8};
  outcome.witness_a = {0.1, 0.2, 0.3};
  outcome.witness_b = {-0.4, 0.5, 1.0 / 3};
  outcome.iterations = 3;
  const files::Case c = make(kinds::regimes().front(), 1, 0);
  const auto expect_same = [&](const Outcome& back) {
    EXPECT_EQ(back.answer, outcome.answer);
    EXPECT_EQ(back.status, outcome.status);
    EXPECT_EQ(back.iterations, 3);
    EXPECT_TRUE(same_bits(back.distance, outcome.distance));
    EXPECT_TRUE(same_bits(back.lower, outcome.lower));
    EXPECT_TRUE(same_bits(back.upper, outcome.upper));
    EXPECT_TRUE(same_bits(back.normal, outcome.normal));
    EXPECT_TRUE(same_bits(back.witness_a, outcome.witness_a));
    EXPECT_TRUE(same_bits(back.witness_b, outcome.witness_b));
  };
  Outcome swapped = outcome;
  swapped.normal = Vec3d::Zero() - swapped.normal;
  std::swap(swapped.witness_a, swapped.witness_b);
  expect_same(kinds::to_original(kinds::swap_variant(c), swapped));
  for (const geometry::SignedPermutation& turn : geometry::signed_permutations()) {
    Outcome turned = outcome;
    for (Vec3d* v : {&turned.normal, &turned.witness_a, &turned.witness_b}) *v = turn(*v);
    expect_same(kinds::to_original(kinds::rotation_variant(c, turn), turned));
  }
  for (const int exponent : {-30, 17}) {
    const auto scales = kinds::scale_variants(c, exponent);
    ASSERT_EQ(scales.size(), 1u);
    Outcome large = outcome;
    large.distance = std::ldexp(large.distance, exponent);
    large.lower = std::ldexp(large.lower, exponent);
    for (Vec3d* v : {&large.witness_a, &large.witness_b}) {
      for (double& x : *v) x = std::ldexp(x, exponent);
    }
    expect_same(kinds::to_original(scales[0], large));
  }
}

TEST(Metamorphic, ScalesHullsAsIfTheyWereBuiltAgain) {
  int hulls = 0;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const files::Case c = make(*kinds::find_regime("random-polytopes"), 3, i);
    for (const kinds::Variant& variant : kinds::scale_variants(c, -13)) {
      const Shape& shape = variant.transformed.shape_a;
      if (shape.kind != ShapeKind::hull) continue;
      const auto again = make_hull(shape.hull->vertices);
      ASSERT_EQ(again->faces.size(), shape.hull->faces.size());
      for (std::size_t f = 0; f < again->faces.size(); ++f) {
        EXPECT_EQ(again->faces[f].loop, shape.hull->faces[f].loop);
        EXPECT_EQ(again->faces[f].normal, shape.hull->faces[f].normal);
      }
      EXPECT_EQ(again->neighbours, shape.hull->neighbours);
      ++hulls;
    }
  }
  EXPECT_GT(hulls, 10);
}

TEST(Metamorphic, RefusesWhatIsNotExact) {
  files::Case c = make(kinds::regimes().front(), 1, 0);
  EXPECT_TRUE(kinds::scale_variants(c, 1100).empty());
  EXPECT_TRUE(kinds::scale_variants(c, -1074).empty());
  // Nothing can be added to both of these without rounding.
  c.pose_a.translation = Vec3d::Constant(1e-300);
  c.pose_b.translation = Vec3d::Constant(1e300);
  base::Random random(1);
  EXPECT_TRUE(kinds::translation_variants(c, random).empty());
}

}  // namespace
}  // namespace touchstone
