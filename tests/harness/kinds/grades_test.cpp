// Tests the rules that decide whether an answer is right: one for each kind, for algorithms of every origin.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "harness/families/moving_pairs.h"
#include "harness/kinds/cast/cast_grade.h"
#include "harness/kinds/feature/feature_grade.h"
#include "harness/kinds/mesh/mesh_grade.h"
#include "harness/kinds/point/point_grade.h"
#include "harness/kinds/ray/ray_grade.h"

namespace touchstone {
namespace {

using kinds::Grade;

TEST(Grades, OfPointsTakeTheMarginOfTheScalar) {
  PointAnswer exact, answer;
  exact.status = answer.status = Status::ok;
  exact.distance = 1;
  const auto grade = [&](double off, Precision scalar) {
    answer.distance = 1 + off;
    return kinds::grade_point(PointTask::closest, answer, exact, scalar, 10).grade;
  };
  EXPECT_EQ(grade(9e-14, Precision::float64), Grade::right);
  EXPECT_EQ(grade(-2e-13, Precision::float64), Grade::inexact);
  EXPECT_EQ(grade(9e-6, Precision::float32), Grade::right);
  EXPECT_EQ(grade(2e-5, Precision::float32), Grade::inexact);
  EXPECT_EQ(grade(std::nan(""), Precision::float32), Grade::inexact);
  answer.status = Status::not_converged;
  EXPECT_EQ(grade(0, Precision::float64), Grade::gave_up);
  answer.status = Status::crashed;
  EXPECT_EQ(grade(0, Precision::float64), Grade::failed);
}

TEST(Grades, OfSidesAreMissedFalseOrInexact) {
  PointAnswer exact, answer;
  exact.status = answer.status = Status::not_reported;
  const auto grade = [&](PointSide said, PointSide is) {
    answer.side = said;
    exact.side = is;
    return kinds::grade_point(PointTask::side, answer, exact, Precision::float64, 1).grade;
  };
  EXPECT_EQ(grade(PointSide::outside, PointSide::surface), Grade::missed);
  EXPECT_EQ(grade(PointSide::inside, PointSide::outside), Grade::false_hit);
  EXPECT_EQ(grade(PointSide::inside, PointSide::surface), Grade::inexact);
  EXPECT_EQ(grade(PointSide::unknown, PointSide::surface), Grade::gave_up);
  EXPECT_EQ(grade(PointSide::inside, PointSide::inside), Grade::right);
}

TEST(Grades, OfRaysHoldExactVerdictsToTheTriangle) {
  RayHit exact, hit;
  exact.status = hit.status = Status::ok;
  exact.hit = hit.hit = true;
  exact.t = 1;
  exact.triangle = 3;
  RayCastEntry plain, promising;
  promising.exact_verdicts = true;
  const auto grade = [&](const RayCastEntry& entry, double off, std::uint32_t triangle,
                         Precision scalar) {
    hit.t = 1 + off;
    hit.triangle = triangle;
    return kinds::grade_ray(RayTask::closest, hit, exact, entry, scalar, 1).grade;
  };
  EXPECT_EQ(grade(plain, 1e-9, 4, Precision::float64), Grade::right);
  EXPECT_EQ(grade(promising, 1e-9, 4, Precision::float64), Grade::inexact);
  EXPECT_EQ(grade(plain, 1e-8, 3, Precision::float64), Grade::inexact);
  EXPECT_EQ(grade(plain, 1e-5, 3, Precision::float32), Grade::right);
  EXPECT_EQ(grade(promising, 1e-5, 3, Precision::float32), Grade::inexact);
  hit.hit = false;
  EXPECT_EQ(grade(plain, 0, 3, Precision::float64), Grade::missed);
}

// A ball of radius 1 goes along x from -4 towards another at the origin, and touches it at time 1/2.
files::CastCase two_balls(double aside) {
  files::CastCase c;
  c.shape_a.radius = c.shape_b.radius = 1;
  c.pose_a.translation = {-4, aside, 0};
  c.motion_a.displacement = {4, 0, 0};
  return c;
}

TEST(Grades, OfCastsAreByTheToleranceThatTheAlgorithmHas) {
  const std::vector<files::CastCase> cases = {two_balls(0), two_balls(2 + 1e-4)};
  kinds::CastTruths truths(cases);
  const auto grade = [&](std::size_t place, double toi, double tolerance, bool in_time) {
    const CastOutcome outcome{.answer = CastAnswer::hit, .status = Status::ok, .toi = toi};
    return kinds::grade_cast(outcome, truths.of(place), {.place = place, .tolerance = tolerance},
                             in_time, truths)
        .grade;
  };
  EXPECT_EQ(grade(0, 0.5, 1e-9, true), Grade::right);
  // Late by as much as the balls move within the tolerance.
  EXPECT_EQ(grade(0, 0.5 + 1e-4, 1e-3, false), Grade::right);
  EXPECT_EQ(grade(0, 0.5 + 1e-4, 1e-3, true), Grade::inexact);
  EXPECT_EQ(grade(0, 0.5 + 1e-3, 1e-3, false), Grade::inexact);
  // Early, with the balls further apart than the tolerance or not.
  EXPECT_EQ(grade(0, 0.5 - 1e-4, 1e-3, true), Grade::right);
  EXPECT_EQ(grade(0, 0.5 - 1e-3, 1e-3, true), Grade::inexact);
  // They pass each other at 1e-4.
  EXPECT_EQ(grade(1, 1, 1e-3, true), Grade::near);
  EXPECT_EQ(grade(1, 1, 1e-5, true), Grade::false_hit);
  const CastOutcome miss{.answer = CastAnswer::miss, .status = Status::not_reported};
  EXPECT_EQ(
      kinds::grade_cast(miss, truths.of(0), {.place = 0, .tolerance = 1}, false, truths).grade,
      Grade::missed);
}

TEST(Grades, TheToleranceOfACastIsAskedOrItsOwn) {
  CastEntry asked, fixed, late;
  fixed.fixed_tolerance = 1e-3;
  late.fixed_share_of_path = 1e-4;
  late.default_tolerance = 1e-2;
  EXPECT_EQ(kinds::cast_tolerance(asked, 1e-6, 5, 2), 1e-6);
  EXPECT_EQ(kinds::cast_tolerance(asked, std::nullopt, 5, 2), 2e-9);
  EXPECT_EQ(kinds::cast_tolerance(fixed, 1e-6, 5, 2), 1e-3);
  EXPECT_EQ(kinds::cast_tolerance(late, 1e-6, 5, 2), 5e-4);
  EXPECT_EQ(kinds::cast_tolerance(late, std::nullopt, 5, 2), 1e-2);
}

// A vertex falls from a metre above a triangle to a metre below, and meets it at time 1/2.
TEST(Grades, OfFeaturesSeeWhatIsLateAndWhatIsEarly) {
  CcdQuery query;
  query.start = {Vec3d(0.25, 0.25, 1), Vec3d(0, 0, 0), Vec3d(1, 0, 0), Vec3d(0, 1, 0)};
  query.end = query.start;
  query.end[0].z() = -1;
  oracle::Oracle oracle;
  const kinds::FeatureAsked asked = {.query = &query, .first_count = 1, .lengths = {1e-4, 0}};
  const auto exact = kinds::impact_of({1, query.start, query.end}, 0);
  ASSERT_TRUE(exact.is_hit);
  const auto grade = [&](const CcdOutcome& outcome) {
    return kinds::grade_feature(outcome, exact, asked, false, oracle).grade;
  };
  const auto hit = [](double toi) {
    return CcdOutcome{.answer = CcdAnswer::hit, .status = Status::ok, .toi = toi};
  };
  EXPECT_EQ(grade(hit(0.5)), Grade::right);
  EXPECT_EQ(grade(hit(0.5 + 5e-7)), Grade::right);
  EXPECT_EQ(grade(hit(0.5 + 2e-6)), Grade::inexact);
  EXPECT_EQ(grade(hit(0.5 - 4e-5)), Grade::right);  // within the tolerance
  EXPECT_EQ(grade(hit(0.5 - 1e-3)), Grade::inexact);
  CcdOutcome claims = hit(0.5);
  claims.free_before = 0.6;
  EXPECT_EQ(grade(claims), Grade::inexact);
  claims = {.answer = CcdAnswer::miss, .status = Status::ok};
  EXPECT_EQ(grade(claims), Grade::missed);
  // The vertex stops short of the triangle: within the tolerance, or not.
  query.end[0].z() = 5e-5;
  const auto apart = kinds::impact_of({1, query.start, query.end}, 0);
  ASSERT_FALSE(apart.is_hit);
  EXPECT_EQ(kinds::grade_feature(hit(1), apart, asked, false, oracle).grade, Grade::near);
  EXPECT_EQ(kinds::grade_feature(hit(0.5), apart, asked, false, oracle).grade, Grade::false_hit);
}

TEST(Grades, OfMeshesCompareListsDistancesAndBounds) {
  kinds::MeshAnswer exact, answer;
  exact.status = answer.status = Status::ok;
  exact.answer = answer.answer = Answer::overlapping;
  exact.pairs = answer.pairs = 2;
  exact.hash = answer.hash = 7;
  const auto grade = [&](ConcaveTask task, Precision scalar) {
    return kinds::grade_mesh(task, answer, exact, &exact, scalar, 10).grade;
  };
  EXPECT_EQ(grade(ConcaveTask::contacts, Precision::float64), Grade::right);
  answer.hash = 8;
  EXPECT_EQ(grade(ConcaveTask::contacts, Precision::float64), Grade::inexact);
  EXPECT_EQ(grade(ConcaveTask::intersect, Precision::float64), Grade::right);
  answer.answer = Answer::separated;
  EXPECT_EQ(grade(ConcaveTask::intersect, Precision::float64), Grade::missed);
  exact.answer = Answer::separated;
  exact.lower = exact.upper = exact.distance = 1;
  for (const auto& [off, of_double, of_float] :
       {std::tuple(5e-11, Grade::right, Grade::right),
        std::tuple(2e-10, Grade::inexact, Grade::right),
        std::tuple(2e-4, Grade::inexact, Grade::inexact)}) {
    answer.distance = 1 + off;
    EXPECT_EQ(grade(ConcaveTask::distance, Precision::float64), of_double) << off;
    EXPECT_EQ(grade(ConcaveTask::distance, Precision::float32), of_float) << off;
  }
  answer.distance = 1;
  answer.lower = 1.1;
  answer.upper = 1.2;
  EXPECT_EQ(grade(ConcaveTask::distance, Precision::float64), Grade::inexact);
}

}  // namespace
}  // namespace touchstone
