// Tests verdicts and errors of answers about cubes, balls and half-spaces.
#include "harness/grade/grade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/grade/true_case.h"
#include "tests/harness/check/pairs.h"

namespace touchstone {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

// A pair of cubes with half extents 1, the second at x, and its exact answer.
struct Cubes {
  oracle::Oracle oracle;
  grade::EncodedPair pair;
  oracle::Measure exact;

  explicit Cubes(double x, const Shape& b = cube(1))
      : pair(along_x(cube(1), b, x), Encoding::as_given),
        exact(oracle.measure(pair.a(), pair.b())) {}
  grade::Grade grade(const Outcome& outcome, Task task) const {
    return touchstone::grade::grade(outcome, task, exact, pair.a(), pair.b());
  }
  grade::WitnessGrade witnesses(const Outcome& outcome, Task task) {
    return grade::grade_witnesses(outcome, task, pair.a(), pair.b(), oracle);
  }
};

Outcome outcome(Answer answer, Status status = Status::ok, double distance = Outcome::none) {
  Outcome outcome;
  outcome.answer = answer;
  outcome.status = status;
  outcome.distance = distance;
  return outcome;
}

TEST(Grade, EveryVerdict) {
  using enum Answer;
  const Cubes apart(3), touch(2), meet(1.5);
  const auto verdict = [](const Cubes& cubes, Answer answer, Status status = Status::ok) {
    return cubes.grade(outcome(answer, status), Task::intersect).verdict;
  };
  for (const Status status : {Status::ok, Status::not_reported}) {
    EXPECT_EQ(verdict(apart, separated, status), grade::Verdict::right);
    EXPECT_EQ(verdict(apart, overlapping, status), grade::Verdict::silent_error);
    EXPECT_EQ(verdict(apart, touching, status), grade::Verdict::silent_error);
    EXPECT_EQ(verdict(meet, overlapping, status), grade::Verdict::right);
    EXPECT_EQ(verdict(meet, touching, status), grade::Verdict::right);
    EXPECT_EQ(verdict(meet, separated, status), grade::Verdict::silent_error);
    EXPECT_EQ(verdict(touch, separated, status), grade::Verdict::unscored);
    EXPECT_EQ(verdict(touch, overlapping, status), grade::Verdict::unscored);
    EXPECT_EQ(verdict(apart, unknown, status), grade::Verdict::honest_failure);
    EXPECT_EQ(verdict(touch, unknown, status), grade::Verdict::honest_failure);
  }
  for (const Status status : {Status::not_converged, Status::degenerate, Status::capacity}) {
    EXPECT_EQ(verdict(apart, overlapping, status), grade::Verdict::honest_failure);
    EXPECT_EQ(verdict(apart, separated, status), grade::Verdict::honest_failure);
  }
  EXPECT_EQ(verdict(apart, unknown, Status::crashed), grade::Verdict::crashed);
  EXPECT_EQ(verdict(apart, unknown, Status::timed_out), grade::Verdict::timed_out);
  EXPECT_EQ(verdict(apart, unknown, Status::unsupported), grade::Verdict::unsupported);
}

TEST(Grade, TheOracleMayNotTell) {
  Cubes cubes(3);
  cubes.exact.answer = Answer::unknown;
  cubes.exact.lower = -1;
  cubes.exact.upper = 1;
  const grade::Grade grade = cubes.grade(outcome(Answer::overlapping), Task::intersect);
  EXPECT_EQ(grade.verdict, grade::Verdict::unscored);
  EXPECT_TRUE(std::isnan(grade.margin));
}

TEST(Grade, NamesOfVerdictsDiffer) {
  std::set<std::string_view> names;
  for (int i = 0; i < 7; ++i) names.insert(to_string(static_cast<grade::Verdict>(i)));
  EXPECT_EQ(names.size(), 7u);
}

TEST(Grade, BodiesThatTouchAreUnscoredOrInContact) {
  Outcome outcome;
  outcome.status = Status::ok;
  outcome.answer = Answer::separated;
  EXPECT_EQ(grade::judge(outcome, Answer::touching), grade::Verdict::unscored);
  EXPECT_EQ(grade::judge(outcome, Answer::touching, grade::Touching::contact),
            grade::Verdict::silent_error);
  EXPECT_EQ(grade::judge(outcome, Answer::unknown, grade::Touching::contact),
            grade::Verdict::unscored);
  outcome.answer = Answer::overlapping;
  EXPECT_EQ(grade::judge(outcome, Answer::touching, grade::Touching::contact),
            grade::Verdict::right);
}

// Bounds that are both zero claim that the bodies touch exactly.
TEST(Grade, TouchingWithBoundsOfZeroTakesASide) {
  Outcome claim = outcome(Answer::touching);
  claim.lower = claim.upper = 0;
  EXPECT_FALSE(grade::is_within_resolution(claim));
  EXPECT_EQ(Cubes(2.5).grade(claim, Task::distance).verdict, grade::Verdict::silent_error);
  EXPECT_EQ(Cubes(1.5).grade(claim, Task::distance).verdict, grade::Verdict::right);
}

TEST(Grade, TouchingWithinBoundsTakesNoSide) {
  const auto within = [](double lower, double upper) {
    Outcome o = outcome(Answer::touching);
    o.lower = lower;
    o.upper = upper;
    return o;
  };
  for (const double x : {2 + 1e-14, 2., 2 - 1e-14}) {
    const Cubes cubes(x);
    const grade::Grade grade = cubes.grade(within(-2e-14, 2e-14), Task::intersect);
    EXPECT_EQ(grade.verdict, grade::Verdict::right) << x;
    EXPECT_EQ(grade.bounds_error, 0) << x;
    EXPECT_EQ(grade.resolution, 4e-14) << x;
  }
  const grade::Grade apart = Cubes(2.25).grade(within(-2e-14, 2e-14), Task::intersect);
  EXPECT_EQ(apart.verdict, grade::Verdict::right);
  EXPECT_NEAR(apart.bounds_error, 0.25, 1e-13);
  // One bound alone is none.
  EXPECT_EQ(Cubes(2.25).grade(within(-1, Outcome::none), Task::intersect).verdict,
            grade::Verdict::silent_error);
}

TEST(Grade, MarginIsTheExactDistanceThatWasCalledWrongly) {
  EXPECT_EQ(Cubes(3).grade(outcome(Answer::overlapping), Task::intersect).margin, 1);
  EXPECT_EQ(Cubes(1.5).grade(outcome(Answer::separated), Task::intersect).margin, 0.5);
  EXPECT_TRUE(std::isnan(Cubes(3).grade(outcome(Answer::separated), Task::intersect).margin));
  const grade::Grade honest =
      Cubes(3).grade(outcome(Answer::overlapping, Status::not_converged), Task::intersect);
  EXPECT_TRUE(std::isnan(honest.margin));
}

TEST(Grade, ErrorsOfDistances) {
  const Cubes apart(3);
  const auto error = [&](double distance) {
    return apart.grade(outcome(Answer::separated, Status::ok, distance), Task::distance)
        .distance_error;
  };
  EXPECT_EQ(error(1), 0);
  EXPECT_EQ(error(1.25), 0.25);
  EXPECT_EQ(error(0.75), -0.25);
  EXPECT_EQ(error(inf), inf);
  EXPECT_TRUE(std::isnan(error(Outcome::none)));
  // These numbers were not asked for, not stood by, or are about bodies that overlap.
  const Outcome far = outcome(Answer::separated, Status::ok, 2);
  EXPECT_TRUE(std::isnan(apart.grade(far, Task::penetration).distance_error));
  EXPECT_TRUE(
      std::isnan(apart.grade(outcome(Answer::separated, Status::not_converged, 2), Task::distance)
                     .distance_error));
  EXPECT_TRUE(std::isnan(Cubes(1.5).grade(far, Task::distance).distance_error));
  EXPECT_EQ(Cubes(2).grade(far, Task::distance).distance_error, 2);
}

TEST(Grade, ErrorsOfDepthsAndTheirTranslations) {
  const Cubes meet(1.5);
  const auto grade = [&](double depth, const Vec3d& normal) {
    Outcome o = outcome(Answer::overlapping, Status::ok, -depth);
    o.normal = normal;
    return meet.grade(o, Task::penetration);
  };
  const grade::Grade right = grade(0.5, {1, 0, 0});
  EXPECT_EQ(right.depth_error, 0);
  EXPECT_EQ(right.separation_error, 0);
  EXPECT_EQ(right.excess, 0);
  // The depth is too small: its translation leaves a quarter.
  const grade::Grade shallow = grade(0.25, {1, 0, 0});
  EXPECT_EQ(shallow.depth_error, -0.25);
  EXPECT_EQ(shallow.separation_error, 0.25);
  EXPECT_EQ(shallow.excess, 0);
  // Another axis needs a longer translation. A normal of any length states the direction.
  const grade::Grade side = grade(2, {0, 5, 0});
  EXPECT_EQ(side.depth_error, 1.5);
  EXPECT_EQ(side.separation_error, 0);
  EXPECT_EQ(side.excess, 1.5);
  // The opposite direction needs the whole length of both.
  EXPECT_EQ(grade(0.5, {-1, 0, 0}).separation_error, 3);
  // Without a direction there is no translation.
  EXPECT_TRUE(std::isnan(grade(0.5, Vec3d::Zero()).separation_error));
  EXPECT_TRUE(std::isnan(grade(0.5, Vec3d::Constant(Outcome::none)).excess));
  EXPECT_EQ(grade(0.75, Vec3d::Zero()).depth_error, 0.25);
}

TEST(Grade, ErrorsOfSignedDistances) {
  const Cubes apart(3), meet(1.5), touch(2);
  const auto grade = [](const Cubes& cubes, Answer answer, double distance) {
    Outcome o = outcome(answer, Status::ok, distance);
    o.normal = {1, 0, 0};
    return cubes.grade(o, Task::signed_distance);
  };
  EXPECT_EQ(grade(apart, Answer::separated, 1.25).distance_error, 0.25);
  EXPECT_TRUE(std::isnan(grade(apart, Answer::separated, 1.25).depth_error));
  EXPECT_FALSE(grade::grades_depth(Task::signed_distance, grade(apart, Answer::separated, 1)));
  EXPECT_EQ(grade(meet, Answer::overlapping, -0.25).depth_error, -0.25);
  EXPECT_EQ(grade(meet, Answer::overlapping, -0.25).separation_error, 0.25);
  EXPECT_TRUE(std::isnan(grade(meet, Answer::overlapping, -0.25).distance_error));
  EXPECT_TRUE(grade::grades_depth(Task::signed_distance, grade(meet, Answer::overlapping, -0.5)));
  // Either number may be that of bodies that touch; one of the other side has no measure.
  EXPECT_EQ(grade(touch, Answer::separated, 0.5).distance_error, 0.5);
  EXPECT_EQ(grade(touch, Answer::overlapping, -0.5).depth_error, 0.5);
  EXPECT_TRUE(std::isnan(grade(meet, Answer::separated, 0.5).distance_error));
  EXPECT_TRUE(std::isnan(grade(apart, Answer::overlapping, -0.5).depth_error));
}

TEST(Grade, NormalOfAGap) {
  const Cubes apart(3);
  Outcome o = outcome(Answer::separated, Status::ok, 1);
  o.normal = {1, 0, 0};
  EXPECT_EQ(apart.grade(o, Task::distance).separation_error, 0);
  EXPECT_EQ(apart.grade(o, Task::distance).excess, 0);
  o.normal = {0, 1, 0};
  EXPECT_EQ(apart.grade(o, Task::distance).excess, 3);
}

TEST(Grade, AHalfspaceIsLeftAlongAnyUpwardDirection) {
  files::Case c;
  c.shape_a = cube(1);
  c.shape_b.kind = ShapeKind::halfspace;
  c.pose_a.translation = {0, 0, 0.5};
  const grade::EncodedPair pair(c, Encoding::as_given);
  oracle::Oracle oracle;
  const oracle::Measure exact = oracle.measure(pair.a(), pair.b());
  EXPECT_EQ(exact.lower, -0.5);
  Outcome o = outcome(Answer::overlapping, Status::ok, -0.5);
  const auto grade = [&](const Vec3d& normal) {
    o.normal = normal;
    return touchstone::grade::grade(o, Task::penetration, exact, pair.a(), pair.b());
  };
  EXPECT_EQ(grade({0, 0, -1}).separation_error, 0);
  // A turn by a rounding error costs no more than that.
  EXPECT_NEAR(grade({1e-8, 0, -1}).separation_error, 0, 1e-15);
  EXPECT_NEAR(grade({1, 0, -1}).separation_error, std::sqrt(0.5) - 0.5, 1e-15);
  EXPECT_EQ(grade({0, 0, 1}).separation_error, inf);
}

TEST(Grade, TwoHalfspacesOverlapForEver) {
  files::Case c;
  c.shape_a.kind = c.shape_b.kind = ShapeKind::halfspace;
  c.shape_b.normal = {0, 1, 1};
  const grade::EncodedPair pair(c, Encoding::as_given);
  oracle::Oracle oracle;
  const oracle::Measure exact = oracle.measure(pair.a(), pair.b());
  const auto error = [&](double distance) {
    return touchstone::grade::grade(outcome(Answer::overlapping, Status::ok, distance),
                                    Task::penetration, exact, pair.a(), pair.b())
        .depth_error;
  };
  EXPECT_EQ(error(-inf), 0);
  EXPECT_EQ(error(-5), -inf);
}

TEST(Grade, CertifiedBounds) {
  const Cubes apart(3);
  const auto error = [&](double lower, double upper, Status status = Status::ok) {
    Outcome o = outcome(Answer::separated, status);
    o.lower = lower;
    o.upper = upper;
    return apart.grade(o, Task::intersect).bounds_error;
  };
  EXPECT_TRUE(std::isnan(error(Outcome::none, Outcome::none)));
  EXPECT_EQ(error(0.5, 1.5), 0);
  EXPECT_EQ(error(1, 1), 0);
  EXPECT_EQ(error(1.25, 2), 0.25);
  EXPECT_EQ(error(0, 0.5), 0.5);
  EXPECT_EQ(error(1.25, Outcome::none), 0.25);
  EXPECT_EQ(error(0.25, Outcome::none), 0);
  EXPECT_EQ(error(Outcome::none, 0.5), 0.5);
  EXPECT_EQ(error(2, 0), 1);  // empty
  // Bounds are graded even if the search did not converge.
  EXPECT_EQ(error(1.25, 2, Status::not_converged), 0.25);
  EXPECT_TRUE(std::isnan(error(1.25, 2, Status::crashed)));
}

TEST(Grade, WitnessPoints) {
  Cubes apart(3);
  Outcome o = outcome(Answer::separated, Status::ok, 1);
  o.normal = {1, 0, 0};
  o.witness_a = {1, 0.5, 0.5};
  o.witness_b = {2, 0.5, 0.5};
  grade::WitnessGrade grade = apart.witnesses(o, Task::distance);
  EXPECT_EQ(grade.off_body, 0);
  EXPECT_EQ(grade.length_error, 0);
  EXPECT_EQ(grade.normal_error, 0);
  EXPECT_FALSE(grade.not_a_number);
  EXPECT_FALSE(grade.missing);

  o.witness_a = {1, 1.25, 0.5};
  EXPECT_EQ(apart.witnesses(o, Task::distance).off_body, 0.25);
  o.witness_a = {0.5, 0.5, 0.5};  // inside counts as on the body
  o.normal = {2, 0, 0};
  grade = apart.witnesses(o, Task::distance);
  EXPECT_EQ(grade.off_body, 0);
  EXPECT_EQ(grade.length_error, 0.5);
  EXPECT_EQ(grade.normal_error, 1);

  // For a depth, the points are one translation apart.
  Cubes meet(1.5);
  o = outcome(Answer::overlapping, Status::ok, -0.5);
  o.witness_a = {1, 0, 0};
  o.witness_b = {0.5, 0, 0};
  grade = meet.witnesses(o, Task::penetration);
  EXPECT_EQ(grade.off_body, 0);
  EXPECT_EQ(grade.length_error, 0);
  EXPECT_TRUE(std::isnan(grade.normal_error));
}

TEST(Grade, WitnessPointsOfRoundBodies) {
  Cubes ball_beside(3, ball(1));
  Outcome o = outcome(Answer::separated, Status::ok, 1);
  o.witness_a = {1, 0, 0};
  o.witness_b = {1.5, 0, 0};
  EXPECT_EQ(ball_beside.witnesses(o, Task::distance).off_body, 0.5);
}

TEST(Grade, MissingWitnessPoints) {
  Cubes apart(3), meet(1.5);
  const auto missing = [](Cubes& cubes, const Outcome& o, Task task) {
    return cubes.witnesses(o, task).missing;
  };
  Outcome o = outcome(Answer::separated, Status::ok, 1);
  EXPECT_TRUE(missing(apart, o, Task::distance));
  EXPECT_FALSE(missing(apart, o, Task::intersect));
  o.normal = {1, 0, 0};
  EXPECT_TRUE(missing(apart, o, Task::signed_distance));
  o.witness_a = {1, 0, 0};
  EXPECT_TRUE(missing(apart, o, Task::distance));
  o.witness_b = {2, 0, 0};
  EXPECT_FALSE(missing(apart, o, Task::distance));
  EXPECT_TRUE(missing(meet, outcome(Answer::overlapping, Status::ok, -0.5), Task::penetration));
  EXPECT_FALSE(missing(meet, outcome(Answer::overlapping, Status::ok, -inf), Task::penetration));
  EXPECT_FALSE(missing(meet, outcome(Answer::overlapping), Task::distance));
  EXPECT_FALSE(
      missing(apart, outcome(Answer::separated, Status::not_converged, 1), Task::distance));
  EXPECT_FALSE(missing(apart, outcome(Answer::touching, Status::ok, 0), Task::distance));
}

TEST(Grade, NotANumber) {
  Cubes apart(3), meet(1.5);
  const auto bad = [](Cubes& cubes, const Outcome& o, Task task) {
    return cubes.witnesses(o, task).not_a_number;
  };
  Outcome o = outcome(Answer::separated, Status::ok, 1);
  EXPECT_FALSE(bad(apart, o, Task::distance));  // the vectors are wholly unknown
  o.normal = {1, Outcome::none, 0};
  EXPECT_TRUE(bad(apart, o, Task::distance));
  EXPECT_FALSE(bad(apart, o, Task::intersect));
  o.normal = {inf, 0, 0};
  EXPECT_TRUE(bad(apart, o, Task::distance));
  EXPECT_TRUE(bad(apart, outcome(Answer::separated), Task::distance));
  EXPECT_TRUE(bad(apart, outcome(Answer::separated, Status::ok, inf), Task::distance));
  EXPECT_TRUE(bad(meet, outcome(Answer::overlapping, Status::ok, inf), Task::penetration));
  EXPECT_FALSE(bad(meet, outcome(Answer::overlapping, Status::ok, -inf), Task::penetration));
  EXPECT_FALSE(bad(meet, outcome(Answer::overlapping), Task::distance));
  EXPECT_FALSE(bad(meet, outcome(Answer::overlapping, Status::degenerate), Task::penetration));
}

}  // namespace
}  // namespace touchstone
