// Tests of statistics against tables, enumerations and worked examples.
#include "harness/stats/statistics.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <span>
#include <utility>

namespace touchstone::stats {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::Pointwise;

std::vector<double> one_to(std::size_t n) {
  std::vector<double> values(n);
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(Median, OfFewAndOfNone) {
  EXPECT_EQ(stats::median({3}), 3);
  EXPECT_EQ(stats::median({5, 1, 4}), 4);
  EXPECT_EQ(stats::median({5, 1, 4, 2}), 3);
  EXPECT_TRUE(std::isnan(stats::median({})));
}

TEST(MedianInterval, NoneBelowSixValuesAtNinetyFivePercent) {
  for (std::size_t n = 0; n < 6; ++n) {
    const stats::MedianInterval interval = stats::median_interval(one_to(n), 0.95);
    EXPECT_TRUE(std::isnan(interval.low)) << n;
    EXPECT_TRUE(std::isnan(interval.high)) << n;
    EXPECT_EQ(interval.n, n);
  }
  const stats::MedianInterval six = stats::median_interval({6, 1, 5, 2, 4, 3}, 0.95);
  EXPECT_EQ(six.median, 3.5);
  EXPECT_EQ(six.low, 1);
  EXPECT_EQ(six.high, 6);
  EXPECT_EQ(six.n, 6u);
}

TEST(MedianInterval, RanksOfThePublishedTable) {
  // These are the order statistics of the sign test at 95 %, as in the tables of any textbook.
  const std::pair<std::size_t, double> table[] = {{8, 1},   {9, 2},   {12, 3},  {15, 4},
                                                  {17, 5},  {20, 6},  {25, 8},  {30, 10},
                                                  {40, 14}, {50, 18}, {100, 40}};
  for (const auto& [n, rank] : table) {
    const stats::MedianInterval interval = stats::median_interval(one_to(n), 0.95);
    EXPECT_EQ(interval.low, rank) << n;
    EXPECT_EQ(interval.high, static_cast<double>(n) + 1 - rank) << n;
  }
  // At 99 % there is no interval below 8 values.
  EXPECT_TRUE(std::isnan(stats::median_interval(one_to(7), 0.99).low));
  EXPECT_EQ(stats::median_interval(one_to(8), 0.99).low, 1);
}

TEST(MedianInterval, CoversTheMedianOfASkewedDistribution) {
  std::mt19937_64 random(3);
  std::lognormal_distribution<double> draw(0, 2);  // its median is 1
  int covered = 0;
  constexpr int trials = 4000;
  for (int trial = 0; trial < trials; ++trial) {
    std::vector<double> values(12);
    for (double& x : values) x = draw(random);
    const stats::MedianInterval interval = stats::median_interval(values, 0.95);
    covered += interval.low <= 1 && 1 <= interval.high;
  }
  EXPECT_GT(covered, trials * 95 / 100);  // the exact coverage is 96.1 %
  EXPECT_LT(covered, trials * 98 / 100);
}

TEST(IfKnown, NeedsSixSquaresAndAnInterval) {
  const double nan = stats::nan;
  EXPECT_EQ(stats::if_known({2, 1, 3, 6}).median, 2);
  EXPECT_TRUE(std::isnan(stats::if_known({2, 1, 3, 5}).median));
  EXPECT_TRUE(std::isnan(stats::if_known({2, nan, nan, 6}).median));
}

// Computes the same p by an enumeration of all ways to call `n` of the values a.
double mann_whitney_by_enumeration(std::vector<double> a, std::span<const double> b) {
  const std::size_t n = a.size();
  a.insert(a.end(), b.begin(), b.end());
  const auto u_of = [&](unsigned chosen) {
    double u = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < a.size(); ++j) {
        const bool counted = (chosen >> i & 1) == 1 && (chosen >> j & 1) == 0;
        if (counted) u += a[i] > a[j] ? 1 : a[i] == a[j] ? 0.5 : 0;
      }
    }
    return u;
  };
  const double seen = u_of((1u << n) - 1);
  double below = 0;
  double above = 0;
  double all = 0;
  for (unsigned chosen = 0; chosen < 1u << a.size(); ++chosen) {
    if (static_cast<std::size_t>(std::popcount(chosen)) != n) continue;
    const double u = u_of(chosen);
    ++all;
    below += u <= seen;
    above += u >= seen;
  }
  return std::min(1.0, 2 * std::min(below, above) / all);
}

TEST(MannWhitney, TheTextbookExample) {
  // The example is Hollander and Wolfe, permeability of the chorioamnion: W = 35, one-sided p =
  // 0.1272.
  const std::vector<double> x = {0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46};
  const std::vector<double> y = {1.15, 0.88, 0.90, 0.74, 1.21};
  EXPECT_NEAR(stats::mann_whitney(x, y), 2 * 0.1272, 1e-4);
  EXPECT_DOUBLE_EQ(stats::mann_whitney(x, y), stats::mann_whitney(y, x));
  const stats::MedianInterval shifted = stats::shift(y, x, 0.95);
  EXPECT_NEAR(shifted.median, 0.305, 1e-12);
  EXPECT_NEAR(shifted.low, -0.15, 1e-12);
  EXPECT_NEAR(shifted.high, 0.76, 1e-12);
  EXPECT_EQ(shifted.n, 5u);
}

TEST(MannWhitney, AgreesWithEnumeration) {
  std::mt19937_64 random(5);
  int ties = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::vector<double> a(2 + random() % 4);
    std::vector<double> b(1 + random() % 6);
    const std::uint64_t values = trial % 2 == 0 ? 4 : 1000;
    for (double& x : a) x = static_cast<double>(random() % values);
    for (double& x : b) x = static_cast<double>(random() % values) + (trial % 3 == 0 ? 2 : 0);
    std::vector<double> both = a;
    both.insert(both.end(), b.begin(), b.end());
    std::ranges::sort(both);
    ties += std::ranges::adjacent_find(both) != both.end();
    EXPECT_NEAR(stats::mann_whitney(a, b), mann_whitney_by_enumeration(a, b), 1e-12) << trial;
  }
  EXPECT_GT(ties, 20);
  EXPECT_LT(ties, 50);
}

TEST(MannWhitney, Extremes) {
  EXPECT_DOUBLE_EQ(stats::mann_whitney(one_to(5), std::vector<double>{6, 7, 8, 9, 10}), 2 / 252.0);
  EXPECT_EQ(stats::mann_whitney(std::vector<double>{1, 1, 1}, std::vector<double>{1, 1}), 1);
  EXPECT_EQ(stats::mann_whitney(std::vector<double>(40, 1.0), std::vector<double>(40, 1.0)), 1);
  EXPECT_EQ(stats::mann_whitney(std::vector<double>{}, std::vector<double>{1, 1}), 1);
}

TEST(MannWhitney, TheNormalApproximationGoesOnWhereTheExactEnds) {
  // 30 + 30 values are exact, 31 + 31 are not; b is shifted by as many ranks of a.
  for (const double step : {0.5, 4.5, 8.5, 12.5}) {
    std::vector<double> p;
    for (const std::size_t n : {30u, 31u}) {
      std::vector<double> b = one_to(n);
      for (double& x : b) x += step;
      p.push_back(stats::mann_whitney(one_to(n), b));
    }
    EXPECT_NEAR(p[0], p[1], 0.03) << step;
  }
  // The result by hand: ranks of a are 1..40, so U = 0; the variance is 40 * 40 * 81 / 12.
  std::vector<double> b = one_to(40);
  for (double& x : b) x += 40;
  const double z = (800 - 0.5) / std::sqrt(1600 * 81 / 12.0);
  const double expected = std::erfc(z / std::sqrt(2.0));
  EXPECT_NEAR(stats::mann_whitney(one_to(40), b) / expected, 1, 1e-9);
}

TEST(Shift, FindsAShiftAndItsIntervalNarrows) {
  std::mt19937_64 random(9);
  std::normal_distribution<double> draw(0, 1);
  double width = std::numeric_limits<double>::infinity();
  for (const std::size_t n : {6u, 20u, 80u}) {
    std::vector<double> a(n), b(n);
    for (double& x : a) x = draw(random);
    for (double& x : b) x = draw(random) + 5;
    const stats::MedianInterval interval = stats::shift(a, b, 0.95);
    EXPECT_LT(interval.low, 5);
    EXPECT_GT(interval.high, 5);
    EXPECT_LT(interval.high - interval.low, width);
    width = interval.high - interval.low;
  }
  // A probability of 1 in 20 is too high.
  EXPECT_TRUE(std::isnan(stats::shift(one_to(3), one_to(3), 0.95).low));
  EXPECT_TRUE(std::isnan(stats::shift({}, one_to(3), 0.95).median));
}

TEST(Holm, KnownValues) {
  EXPECT_THAT(stats::holm(std::vector<double>{0.01, 0.04, 0.03, 0.005}),
              Pointwise(DoubleNear(1e-15), {0.03, 0.06, 0.06, 0.02}));
  EXPECT_THAT(stats::holm(std::vector<double>{0.9, 0.8}), ElementsAre(1, 1));
  EXPECT_THAT(stats::holm(std::vector<double>{}), ElementsAre());
}

TEST(ModifiedZ, FlagsWhatIsFarOffAndNothingElse) {
  // The median is 3, absolute deviations are 2 1 0 1 97, and the MAD is 1.
  EXPECT_THAT(stats::modified_z(std::vector<double>{1, 2, 3, 4, 100}),
              Pointwise(DoubleNear(1e-12), {-2 * 0.6745, -0.6745, 0.0, 0.6745, 97 * 0.6745}));
  EXPECT_THAT(stats::modified_z(std::vector<double>{2, 2, 2}), ElementsAre(0, 0, 0));
  std::vector<double> mostly_equal(20, 1.0);
  mostly_equal.back() = 3;
  EXPECT_GT(stats::modified_z(mostly_equal).back(), stats::outlier_z);
  EXPECT_EQ(stats::modified_z(mostly_equal).front(), 0);
  EXPECT_TRUE(stats::modified_z(std::vector<double>{}).empty());
}

TEST(PowerLaw, FindsAnExactOne) {
  std::vector<double> x = {100, 1000, 10000, 40000};
  std::vector<double> y;
  for (const double n : x) y.push_back(3e-9 * std::pow(n, 1.5));
  const stats::PowerLaw law = stats::fit_power_law(x, y, 0.95);
  EXPECT_NEAR(law.exponent, 1.5, 1e-12);
  EXPECT_NEAR(law.low, 1.5, 1e-9);
  EXPECT_NEAR(law.high, 1.5, 1e-9);
  EXPECT_NEAR(law.factor / 3e-9, 1, 1e-9);
}

TEST(PowerLaw, IntervalByHand) {
  // With log x = 0 1 2 and log y = 0 1 3, the slope is 3/2 and the residuals are 1/6 -1/3 1/6, with
  // one degree of freedom.
  const double e = std::exp(1.0);
  const stats::PowerLaw law = stats::fit_power_law(std::vector<double>{1, e, e * e},
                                                   std::vector<double>{1, e, e * e * e}, 0.95);
  EXPECT_NEAR(law.exponent, 1.5, 1e-12);
  EXPECT_NEAR(law.high - law.exponent, 12.7062047 * std::sqrt(1 / 12.0), 1e-6);
  EXPECT_NEAR(law.exponent - law.low, 12.7062047 * std::sqrt(1 / 12.0), 1e-6);
}

TEST(PowerLaw, TooFewPoints) {
  const stats::PowerLaw two =
      stats::fit_power_law(std::vector<double>{1, 10}, std::vector<double>{1, 100}, 0.95);
  EXPECT_NEAR(two.exponent, 2, 1e-12);
  EXPECT_TRUE(std::isnan(two.low));
  const stats::PowerLaw one =
      stats::fit_power_law(std::vector<double>{5, 5, 5}, std::vector<double>{1, 2, 3}, 0.95);
  EXPECT_TRUE(std::isnan(one.exponent));
  EXPECT_TRUE(std::isnan(stats::fit_power_law({}, {}, 0.95).exponent));
}

}  // namespace
}  // namespace touchstone::stats
