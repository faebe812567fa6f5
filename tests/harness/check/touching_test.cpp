// Tests that touching regimes touch exactly, or miss by the ulps that they state.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "harness/kinds/pair/regimes/regimes.h"
#include "tests/harness/check/exact_answer.h"

namespace touchstone {
namespace {

constexpr std::uint64_t count = 200;

Vec3d to_float(const Vec3d& v) { return v.cast<float>().cast<double>(); }

// Rounds every number of the case to float; no length of these regimes changes by it.
files::Case in_float(files::Case c) {
  for (Pose* pose : {&c.pose_a, &c.pose_b}) {
    pose->rotation = pose->rotation.cast<float>().cast<double>();
    pose->translation = to_float(pose->translation);
  }
  return c;
}

// Answers with the rotations of both bodies as quaternions, exactly orthonormal.
Answer answer_with_quaternions(oracle::Oracle& oracle, const files::Case& c) {
  const auto body = [](const oracle::Solid& solid, const Pose& pose) {
    const Eigen::Quaterniond q(pose.rotation);
    return oracle::Body(solid, {q.w(), q.x(), q.y(), q.z()}, pose.translation);
  };
  const oracle::Solid a(c.shape_a), b(c.shape_b);
  return oracle.verdict(body(a, c.pose_a), body(b, c.pose_b));
}

TEST(TouchingRegimes, TouchExactlyInEveryEncoding) {
  oracle::Oracle oracle;
  for (const char* name :
       {"touching-baked", "touching-origin", "touching-grid", "touching-pythagorean"}) {
    for (std::uint64_t i = 0; i < count; ++i) {
      const files::Case c = make(*kinds::find_regime(name), 9, i);
      EXPECT_EQ(exact_verdict(oracle, c), Answer::touching) << c.id << "\n" << files::to_json(c);
      for (const Shape* shape : {&c.shape_a, &c.shape_b}) {
        if (shape->kind != ShapeKind::hull) continue;
        for (const Vec3d& v : shape->hull->vertices) EXPECT_EQ(v, to_float(v)) << c.id;
      }
      EXPECT_EQ(exact_verdict(oracle, in_float(c)), Answer::touching) << c.id;
      // Quarter turns are exact as quaternions only if the quaternion is.
      const std::string regime = name;
      if (regime == "touching-baked" || regime == "touching-origin") {
        EXPECT_EQ(answer_with_quaternions(oracle, c), Answer::touching) << c.id;
      }
    }
  }
}

TEST(TouchingRegimes, AreAnUlpApartOrAnUlpDeepWhereTheySaySo) {
  oracle::Oracle oracle;
  for (std::uint64_t i = 0; i < count; ++i) {
    const files::Case less = make(*kinds::find_regime("touching-less-an-ulp"), 9, i);
    const oracle::Measure apart = exact_measure(oracle, less);
    EXPECT_EQ(apart.answer, Answer::separated) << less.id;
    EXPECT_LT(apart.upper, 5e-16) << less.id;
    const files::Case more = make(*kinds::find_regime("touching-plus-an-ulp"), 9, i);
    const oracle::Measure deep = exact_measure(oracle, more);
    EXPECT_EQ(deep.answer, Answer::overlapping) << more.id;
    EXPECT_GT(deep.lower, -5e-16) << more.id;
  }
}

TEST(TouchingRegimes, CurvedBodiesTouchAsFarAsCanBeTold) {
  oracle::Oracle oracle;
  for (std::uint64_t i = 0; i < count; ++i) {
    const files::Case c = make(*kinds::find_regime("touching-curved"), 9, i);
    const oracle::Measure m = exact_measure(oracle, c);
    EXPECT_TRUE(m.answer == Answer::touching || m.answer == Answer::unknown) << c.id;
    EXPECT_LE(m.lower, 0) << c.id;
    EXPECT_GE(m.upper, 0) << c.id;
    EXPECT_LT(m.upper - m.lower, 1e-7) << c.id;
  }
}

// Each regime produces the outcomes that it is for.
TEST(Regimes, HaveBothOutcomes) {
  oracle::Oracle oracle;
  for (const kinds::Regime& regime : kinds::regimes()) {
    std::map<Answer, int> answers;
    constexpr std::uint64_t some = 60;
    for (std::uint64_t i = 0; i < some; ++i) {
      ++answers[exact_verdict(oracle, make(regime, 4, i))];
    }
    const int apart = answers[Answer::separated], deep = answers[Answer::overlapping];
    SCOPED_TRACE(regime.name);
    if (regime.group == "gap") {
      EXPECT_GE(apart, regime.parameter < 1e-15 ? 50 : some);
    }
    if (regime.group == "depth") {
      EXPECT_GE(deep, regime.parameter > -1e-15 ? 50 : some);
    }
    if (regime.name.starts_with("contained")) {
      EXPECT_EQ(deep, some);
    }
    if (regime.name == "coincident-identical") {
      EXPECT_EQ(deep, some);
    }
    if (regime.extreme || regime.group == "random" || regime.group == "degenerate") {
      EXPECT_GT(apart, 14);
      EXPECT_GT(deep, 8);
    }
    if (regime.name == "coplanar") {
      EXPECT_GT(apart, 10);
      EXPECT_GT(deep, 10);
      EXPECT_GT(answers[Answer::touching], 0);
    }
  }
}

}  // namespace
}  // namespace touchstone
