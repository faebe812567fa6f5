// Tests of error counts.
#include "harness/trade/evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace touchstone {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

trade::TruePair truth(std::uint32_t a, std::uint32_t b, double gap, double size = 1) {
  return {{a, b}, gap > 0 ? Answer::separated : Answer::overlapping, gap, size};
}
trade::PairAnswer said(std::uint32_t a, std::uint32_t b, Answer answer,
                       double distance = Outcome::none) {
  return {{a, b}, answer, Status::ok, distance, 0};
}

TEST(TradeErrors, BinsCoverEveryGapOnce) {
  std::size_t contacts = 0;
  for (double gap = 1e-8; gap < 10; gap *= 1.7) {
    for (const double signed_gap : {gap, -gap}) {
      const Answer answer = signed_gap > 0 ? Answer::separated : Answer::overlapping;
      const trade::GapRange range = trade::gap_range(trade::gap_bin(answer, signed_gap));
      EXPECT_LE(range.low, signed_gap);
      EXPECT_GE(range.high, signed_gap);
      contacts += signed_gap < 0 ? 1 : 0;
    }
  }
  EXPECT_GT(contacts, 10u);
  for (std::size_t bin = 1; bin < trade::gap_bins; ++bin) {
    EXPECT_EQ(trade::gap_range(bin).low, trade::gap_range(bin - 1).high);
  }
  EXPECT_EQ(trade::gap_bin(Answer::touching, 0), trade::gap_decades.size());
  EXPECT_EQ(trade::gap_bin(Answer::overlapping, Outcome::none), trade::unknown_depth_bin);
}

TEST(TradeErrors, TouchingIsRightWithinItsBounds) {
  trade::ErrorCount count(Task::intersect);
  std::vector<trade::PairAnswer> answers = {
      said(0, 1, Answer::touching), said(0, 2, Answer::touching), said(0, 3, Answer::touching)};
  for (trade::PairAnswer& answer : answers) answer.upper = 1e-15;
  count.add({0, {truth(0, 1, 1e-16), truth(0, 2, -1e-16), truth(0, 3, 2e-15)}}, answers);
  EXPECT_EQ(count.errors().false_positives, 1);
  EXPECT_EQ(count.errors().false_negatives, 0);
}

TEST(TradeErrors, VerdictsAreCountedAtTheirTrueGap) {
  trade::ErrorCount count(Task::intersect);
  const trade::FrameTruth frame = {0,
                                   {truth(0, 1, 0.05, 2), truth(0, 2, -0.3), truth(1, 2, -2e-4),
                                    truth(1, 3, 1e-3), truth(2, 3, -0.5)}};
  const std::vector<trade::PairAnswer> answers = {
      said(2, 3, Answer::overlapping), said(0, 1, Answer::overlapping),  // false positive
      said(0, 2, Answer::separated),                                     // false negative
      said(1, 3, Answer::unknown),     said(4, 5, Answer::overlapping),  // 4-5 is not even near
      said(4, 6, Answer::separated)};
  count.add(frame, answers);  // 1-2 was not found: a false negative
  const trade::PointErrors errors = count.errors();
  EXPECT_EQ(errors.near, 5);
  EXPECT_EQ(errors.contacts, 3);
  EXPECT_EQ(errors.false_positives, 1);
  EXPECT_EQ(errors.false_negatives, 2);
  EXPECT_EQ(errors.failed, 1);
  EXPECT_EQ(errors.far, 1);
  EXPECT_DOUBLE_EQ(errors.wrong_share(), 5.0 / 6);
  EXPECT_DOUBLE_EQ(errors.false_negative_share(), 2.0 / 3);
  // The gap is 0.05 of a body of size 2.
  EXPECT_EQ(errors.bins[trade::gap_bin(Answer::separated, 0.025)].wrong, 1);
  EXPECT_EQ(errors.bins[trade::gap_bin(Answer::overlapping, -0.3)].wrong, 1);
  EXPECT_EQ(errors.bins[trade::gap_bin(Answer::overlapping, -0.3)].pairs, 2);
  EXPECT_EQ(errors.bins[trade::gap_bin(Answer::overlapping, -2e-4)].wrong, 1);
  EXPECT_EQ(errors.values, 0);
}

TEST(TradeErrors, ValuesArePartsOfTheSize) {
  trade::ErrorCount distance(Task::distance);
  distance.add({0, {truth(0, 1, 0.5, 2), truth(0, 2, -0.25), truth(1, 2, 0.125), truth(2, 3, 1)}},
               std::vector<trade::PairAnswer>{said(0, 1, Answer::separated, 0.75),
                                              said(0, 2, Answer::separated, 0.0625),
                                              said(2, 3, Answer::unknown)});
  const trade::PointErrors errors = distance.errors();
  EXPECT_EQ(errors.values, 3);                 // 1-2 was not found, so it has no distance
  EXPECT_DOUBLE_EQ(errors.value.greatest, 1);  // an answer without a number
  EXPECT_DOUBLE_EQ(errors.value.mean, (0.125 + 0.0625 + 1) / 3);

  trade::ErrorCount depth(Task::penetration);
  depth.add({0, {truth(0, 1, -0.5), truth(0, 2, 0.25), truth(1, 2, -0.125)}},
            std::vector<trade::PairAnswer>{said(0, 1, Answer::overlapping, -0.25),
                                           said(0, 2, Answer::overlapping, -0.0625)});
  EXPECT_EQ(depth.errors().values, 3);  // 1-2 was missed, which is an error of its depth
  EXPECT_DOUBLE_EQ(depth.errors().value.mean, (0.25 + 0.0625 + 0.125) / 3);
}

TEST(TradeErrors, SpreadTellsThe99thOfAHundred) {
  std::vector<double> values;
  for (int i = 100; i > 0; --i) values.push_back(i);
  const trade::Spread spread = trade::spread_of(values);
  EXPECT_DOUBLE_EQ(spread.mean, 50.5);
  EXPECT_EQ(spread.p99, 99);
  EXPECT_EQ(spread.greatest, 100);
}

TEST(TradeFront, KeepsWhatNothingBeats) {
  const double nan = std::nan("");
  const std::vector<trade::FrontPoint> points = {{3, 0.1}, {1, 0.5}, {2, 0.5}, {1, 0.7}, {nan, 0},
                                                 {5, 0},   {6, 0},   {4, 0.2}, {2, nan}, {3, 0.1}};
  EXPECT_THAT(trade::pareto_front(points), ElementsAre(1, 0, 5));
  EXPECT_THAT(trade::pareto_front({}), IsEmpty());
}

}  // namespace
}  // namespace touchstone
