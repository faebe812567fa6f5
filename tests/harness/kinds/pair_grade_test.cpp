// Tests the grades of answers about pairs, and the score of their counts, by answers that are made by hand.
#include "harness/kinds/pair/pair_grade.h"

#include <gtest/gtest.h>

namespace touchstone {
namespace {

using grade::Verdict;
using kinds::Grade;

// A depth that was asked of two bodies of 10 m, which overlap by 1 m.
class PairGrades : public ::testing::Test {
 protected:
  PairGrades() {
    answer.task = Task::penetration;
    answer.scalar = Precision::float64;
    answer.exact = answer.answer = Answer::overlapping;
    answer.scale = 10;
    answer.lower = answer.upper = answer.given_lower = answer.given_upper = -1;
    set_verdict(Verdict::right);
  }
  void set_verdict(Verdict verdict) {
    answer.given.verdict = answer.end_to_end.verdict = verdict;
    answer.given.margin = verdict == Verdict::silent_error ? 1 : grade::Grade::none;
  }
  Grade grade() const { return kinds::grade_pair(entry, answer, true).grade; }

  NarrowPhaseEntry entry;
  grade::GradedAnswer answer;
};

TEST_F(PairGrades, SidesOfContactAreMissedOrFalse) {
  EXPECT_EQ(grade(), Grade::right);
  set_verdict(Verdict::silent_error);
  EXPECT_EQ(grade(), Grade::false_hit);
  entry.traits.approximate = true;
  EXPECT_EQ(grade(), Grade::near);
  answer.answer = Answer::separated;
  EXPECT_EQ(grade(), Grade::missed);
}

TEST_F(PairGrades, NumbersAreInexactOrBounds) {
  answer.given.depth_error = 0.9e-8;
  EXPECT_EQ(grade(), Grade::right);
  answer.given.depth_error = 1.1e-8;
  EXPECT_EQ(grade(), Grade::inexact);
  entry.traits.depth_is_bound = true;
  EXPECT_EQ(grade(), Grade::bound);
  answer.given.depth_error = -1.1e-8;
  EXPECT_EQ(grade(), Grade::inexact);
  answer.given.depth_error = 0;
  EXPECT_EQ(grade(), Grade::right);
  answer.witnesses.not_a_number = true;
  EXPECT_EQ(grade(), Grade::inexact);
}

// What is wrong by the input's rounding alone is right.
TEST_F(PairGrades, AreOfWhatWasGiven) {
  answer.end_to_end.verdict = Verdict::silent_error;
  answer.end_to_end.margin = 1;
  EXPECT_EQ(grade(), Grade::right);
}

TEST_F(PairGrades, WhatIsNoAnswer) {
  set_verdict(Verdict::honest_failure);
  EXPECT_EQ(grade(), Grade::gave_up);
  answer.given.bounds_error = 1;  // but its certified bounds miss
  EXPECT_EQ(grade(), Grade::inexact);
  set_verdict(Verdict::crashed);
  EXPECT_EQ(grade(), Grade::failed);
  set_verdict(Verdict::timed_out);
  EXPECT_EQ(grade(), Grade::failed);
}

TEST_F(PairGrades, TouchingIsRightOnEitherSideAndAnOpenEnclosureIsUnresolved) {
  set_verdict(Verdict::unscored);
  answer.given_lower = answer.given_upper = 0;
  EXPECT_EQ(grade(), Grade::right);
  answer.given_lower = -1e-20;
  EXPECT_EQ(grade(), Grade::unresolved);
}

TEST(GradeCounts, ScoreARightAnswerOneAWrongOneMinusSixteenAndAllElseNothing) {
  kinds::GradeCount count;
  const auto add = [&](Grade grade, int times) {
    for (int i = 0; i < times; ++i) count.add({grade, true}, i);
  };
  add(Grade::right, 50);
  EXPECT_EQ(count.score(), 50);
  for (const Grade none : {Grade::not_asked, Grade::unresolved, Grade::near, Grade::bound,
                           Grade::gave_up, Grade::failed}) {
    add(none, 3);
  }
  EXPECT_EQ(count.score(), 50);
  add(Grade::missed, 1);
  EXPECT_EQ(count.score(), 34);
  add(Grade::false_hit, 1);
  add(Grade::inexact, 2);
  EXPECT_EQ(count.score(), -14);
  EXPECT_EQ(count.cases, 69);
  kinds::GradeCount twice = count;
  twice.add(count);
  EXPECT_EQ(twice.score(), -28);
}

}  // namespace
}  // namespace touchstone
