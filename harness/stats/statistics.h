// The statistics of repeated measurements. None assumes a normal distribution of times.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

namespace touchstone::stats {

// NaN stands for a number that is not known.
inline constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// Returns the middle value, or the mean of the middle two; NaN for none. No value is NaN.
double median(std::vector<double> values);

// An estimate with an interval that covers the true value with at least the requested confidence;
// `low` and `high` are NaN if `n` values cannot give such an interval.
struct MedianInterval {
  double median, low, high;
  std::size_t n;
};

inline constexpr double usual_confidence = 0.95;

// Returns the median of the distribution that the values are drawn from, between two order
// statistics chosen by the sign test (Conover, "Practical Nonparametric Statistics", sec. 3.2):
// valid for any distribution. 0 < confidence < 1. At 0.95 there is no interval below 6 values.
MedianInterval median_interval(std::vector<double> values, double confidence);

// With fewer values there is no interval at 95 %, and nothing is said of who is faster.
inline constexpr std::size_t fewest_squares = 6;
// Returns the estimate as it is, or NaN if it is of fewer values or has no interval.
MedianInterval if_known(const MedianInterval& values);

// Returns the interval's two ends to four digits, times `scale`; "-" if there is none.
std::string interval_cell(const MedianInterval& values, double scale = 1);

// Converts an estimate of logarithms to one of their arguments.
MedianInterval exponential(const MedianInterval& of_logs);

// Two-sided Mann-Whitney test: the probability, if both samples come from one distribution, of
// ranks at least so uneven. It is exact, with ties, up to 60 values in all (Streitberg and Roehmel
// 1986); beyond, it is the normal approximation with corrections for ties and continuity. It is 1
// if either sample is empty.
double mann_whitney(std::span<const double> a, std::span<const double> b);

// Returns the shift of b against a: the median of all differences b[j] - a[i] (Hodges and Lehmann
// 1963) with the interval that Mann-Whitney's test gives (Moses; Hollander and Wolfe, sec. 4.3).
// `n` is the number of values of the smaller sample.
MedianInterval shift(std::span<const double> a, std::span<const double> b, double confidence);

// Holm's step-down correction (1979) over a table of tests: corrected probabilities, in the order
// of `p`. If every test whose corrected probability is below a level is rejected, the chance of
// even one false rejection is below that level.
std::vector<double> holm(std::span<const double> p);

// The modified z score of each value, 0.6745 (x - median) / MAD (Iglewicz and Hoaglin 1993). If
// more than half of the values are equal, the mean absolute deviation replaces the MAD.
std::vector<double> modified_z(std::span<const double> values);
inline constexpr double outlier_z = 3.5;  // a value with a greater |z| is flagged, never deleted

// y = factor * x^exponent, by least squares on the logarithms. The interval of the exponent is
// Student's, which measures the distance of the points from a power law: it is NaN below three
// distinct x, and the exponent itself is NaN below two. All x and y > 0.
struct PowerLaw {
  double exponent, low, high, factor;
  std::size_t n;
};
PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, double confidence);

}  // namespace touchstone::stats
