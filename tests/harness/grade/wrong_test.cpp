// Tests which graded answers count as wrong.
#include "harness/grade/wrong.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace touchstone {
namespace {

using ::testing::HasSubstr;

class Beyond : public ::testing::Test {
 protected:
  Beyond() {
    answer.scalar = Precision::float64;
    answer.task = Task::penetration;
    answer.answer = Answer::overlapping;
    answer.scale = 10;
    answer.end_to_end.verdict = grade::Verdict::right;
  }
  std::string beyond(bool extreme = false) const {
    return grade::beyond_margins(entry, answer, extreme);
  }

  NarrowPhaseEntry entry;
  grade::GradedAnswer answer;
};

TEST_F(Beyond, SidesOfContact) {
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.verdict = grade::Verdict::silent_error;
  answer.end_to_end.margin = 0.9e-11;
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.margin = 1.1e-11;
  EXPECT_THAT(beyond(), HasSubstr("called overlapping, and apart by 1.1e-11 m"));
  EXPECT_EQ(beyond(true), "");
  answer.end_to_end.margin = 1.1e-8;
  EXPECT_NE(beyond(true), "");
  answer.scalar = Precision::float32;
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.margin = 2e-4;
  EXPECT_NE(beyond(), "");
  EXPECT_EQ(beyond(true), "");
  answer.answer = Answer::separated;
  answer.end_to_end.margin = 2e-3;
  EXPECT_THAT(beyond(true), HasSubstr("called separated, and overlapping"));
}

TEST_F(Beyond, AnApproximateAlgorithmMaySayOverlappingOnly) {
  entry.traits.approximate = true;
  answer.end_to_end.verdict = grade::Verdict::silent_error;
  answer.end_to_end.margin = 1;
  EXPECT_EQ(beyond(), "");
  answer.answer = Answer::separated;
  EXPECT_NE(beyond(), "");
}

TEST_F(Beyond, DistancesAndDepths) {
  answer.end_to_end.depth_error = 0.9e-8;
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.depth_error = 1.1e-8;
  EXPECT_THAT(beyond(), HasSubstr("the depth is too great"));
  answer.end_to_end.depth_error = -1.1e-8;
  EXPECT_THAT(beyond(), HasSubstr("the depth is too small"));
  answer.end_to_end.depth_error = 0;
  answer.end_to_end.separation_error = 1.1e-8;
  EXPECT_THAT(beyond(), HasSubstr("does not separate"));
  answer.task = Task::distance;  // the direction across a small gap is known less well
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.distance_error = -1.1e-8;
  EXPECT_THAT(beyond(), HasSubstr("the distance is wrong by 1.1e-08 m, 1.1e-09 of the size"));
}

TEST_F(Beyond, ADepthThatIsABoundMayBeTooGreat) {
  entry.traits.depth_is_bound = true;
  answer.end_to_end.depth_error = 1;
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.depth_error = -1.1e-8;
  EXPECT_NE(beyond(), "");
}

TEST_F(Beyond, BoundsNumbersAndLosses) {
  answer.end_to_end.bounds_error = 1.1e-11;
  EXPECT_THAT(beyond(), HasSubstr("bounds miss"));
  answer.end_to_end.bounds_error = 0;
  answer.witnesses.not_a_number = true;
  EXPECT_THAT(beyond(), HasSubstr("NaN"));
  answer.witnesses.not_a_number = false;
  answer.end_to_end.verdict = grade::Verdict::crashed;
  EXPECT_EQ(beyond(), "crashed");
  answer.end_to_end.verdict = grade::Verdict::timed_out;
  EXPECT_EQ(beyond(), "no answer in time");
  answer.end_to_end.verdict = grade::Verdict::honest_failure;
  EXPECT_EQ(beyond(), "");
}

TEST_F(Beyond, WitnessPoints) {
  answer.witnesses.off_body = 0.9e-3;
  EXPECT_EQ(beyond(), "");
  answer.witnesses.off_body = 1.1e-3;
  EXPECT_THAT(beyond(), HasSubstr("a witness point is off its body by 0.0011 m"));
  answer.witnesses.off_body = 0;
  answer.witnesses.missing = true;
  EXPECT_EQ(beyond(), "") << "MPR and SAT have a depth without points";
  answer.answer = Answer::separated;
  EXPECT_EQ(beyond(), "a distance without its normal or witness points");
}

TEST_F(Beyond, BodiesWithoutAnyScale) {
  answer.scale = 0;
  EXPECT_EQ(beyond(), "");
  answer.end_to_end.depth_error = -1e-300;
  EXPECT_NE(beyond(), "");
}

}  // namespace
}  // namespace touchstone
