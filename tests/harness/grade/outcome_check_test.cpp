// Tests the comparison of outcomes with exact answers, as a campaign does it.
#include "harness/grade/answer_check.h"

#include <gtest/gtest.h>

#include <array>

namespace touchstone {
namespace {

// The faults of one answer for two bodies of a metre that are `distance` apart.
grade::OutcomeFaults faults_of(const Outcome& outcome, double distance) {
  const std::array reference = {grade::ReferenceOutcome{
      distance > 0 ? Answer::separated : Answer::overlapping, distance, 1, 1}};
  return grade::check_outcomes(std::array{outcome}, reference, Task::intersect, Precision::float64);
}

TEST(OutcomeCheck, TouchingIsRightIfItsBoundsHold) {
  Outcome touching;
  touching.answer = Answer::touching;
  touching.status = Status::ok;
  touching.lower = -1e-14;
  touching.upper = 1e-14;
  for (const double distance : {5e-15, -5e-15}) {
    EXPECT_EQ(faults_of(touching, distance).disagree, 0) << distance;
    EXPECT_EQ(faults_of(touching, distance).grazing, 0) << distance;
    EXPECT_EQ(faults_of(touching, distance).contacts, 1) << distance;
  }
  for (const double distance : {0.5, -0.5}) {
    const grade::OutcomeFaults faults = faults_of(touching, distance);
    EXPECT_EQ(faults.disagree, 1) << distance;
    EXPECT_NEAR(faults.worst, 0.5, 1e-13) << distance;
  }
}

}  // namespace
}  // namespace touchstone
