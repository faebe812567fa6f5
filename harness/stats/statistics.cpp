// Medians, intervals and tests.
#include "harness/stats/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <boost/math/policies/policy.hpp>
#include <cmath>
#include <numeric>

namespace touchstone::stats {
namespace {

// In doubles, which are compiled in half the time of the long doubles that the library would take.
using InDoubles = boost::math::policies::policy<boost::math::policies::promote_double<false>>;
using Normal = boost::math::normal_distribution<double, InDoubles>;
using Binomial = boost::math::binomial_distribution<double, InDoubles>;
using StudentsT = boost::math::students_t_distribution<double, InDoubles>;

double median_of_sorted(std::span<const double> values) {
  const std::size_t n = values.size();
  if (n == 0) return nan;
  return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

// Returns the interval between the rank-th smallest and the rank-th greatest value; none for rank
// 0.
MedianInterval between_ranks(const std::vector<double>& sorted, std::size_t rank, std::size_t n) {
  if (rank == 0) return {median_of_sorted(sorted), nan, nan, n};
  return {median_of_sorted(sorted), sorted[rank - 1], sorted[sorted.size() - rank], n};
}

// The midranks of the values a and then b, doubled, so that ties are whole numbers too.
struct DoubledRanks {
  std::vector<std::size_t> of_a, all;
  double tie_term = 0;  // sum of t^3 - t over groups of t equal values

  DoubledRanks(std::span<const double> a, std::span<const double> b) {
    struct Value {
      double x;
      bool in_a;
    };
    std::vector<Value> values;
    for (const double x : a) values.push_back({x, true});
    for (const double x : b) values.push_back({x, false});
    std::ranges::sort(values, {}, &Value::x);
    for (std::size_t begin = 0; begin < values.size();) {
      std::size_t end = begin;
      while (end < values.size() && values[end].x == values[begin].x) ++end;
      for (std::size_t i = begin; i < end; ++i) {
        all.push_back(begin + end + 1);
        if (values[i].in_a) of_a.push_back(begin + end + 1);
      }
      const auto ties = static_cast<double>(end - begin);
      tie_term += ties * ties * ties - ties;
      begin = end;
    }
  }
};

constexpr std::size_t most_exact = 60;  // values in both samples: 10 million additions

// Returns the probability of each sum of `size` of these ranks, by the shift algorithm: element s
// is the probability of the sum s.
std::vector<double> rank_sum_distribution(const std::vector<std::size_t>& ranks, std::size_t size) {
  const std::size_t greatest = std::accumulate(ranks.begin(), ranks.end(), std::size_t{0});
  // ways[k][s] is the number of subsets of k of the ranks seen so far with the sum s.
  std::vector<std::vector<double>> ways(size + 1, std::vector<double>(greatest + 1, 0));
  ways[0][0] = 1;
  std::size_t reached = 0;
  for (const std::size_t rank : ranks) {
    reached += rank;
    for (std::size_t k = size; k >= 1; --k) {
      for (std::size_t s = reached; s >= rank; --s) ways[k][s] += ways[k - 1][s - rank];
    }
  }
  std::vector<double>& of_size = ways[size];
  const double total = std::accumulate(of_size.begin(), of_size.end(), 0.0);
  for (double& p : of_size) p /= total;
  return of_size;
}

// Returns the greatest k for which fewer than k of the n * m differences are on one side of the
// true shift with a probability of at most `tail`; 0 if there is none.
std::size_t shift_rank(std::size_t n, std::size_t m, double tail) {
  if (n + m <= most_exact) {
    std::vector<std::size_t> ranks(n + m);
    for (std::size_t i = 0; i < ranks.size(); ++i) ranks[i] = i + 1;
    const std::vector<double> p = rank_sum_distribution(ranks, n);
    double below = 0;
    std::size_t k = 0;
    for (std::size_t s = n * (n + 1) / 2; s < p.size(); ++s, ++k) {
      below += p[s];
      if (below > tail) break;
    }
    return k;
  }
  const double product = static_cast<double>(n) * static_cast<double>(m);
  const double z = boost::math::quantile(Normal(), tail);
  const double k = product / 2 + z * std::sqrt(product * static_cast<double>(n + m + 1) / 12);
  return k < 1 ? 0 : static_cast<std::size_t>(k);
}

}  // namespace

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return median_of_sorted(values);
}

MedianInterval median_interval(std::vector<double> values, double confidence) {
  std::ranges::sort(values);
  const std::size_t n = values.size();
  const double tail = (1 - confidence) / 2;
  const Binomial heads(static_cast<double>(n), 0.5);
  // The median is below the rank-th smallest value if fewer than `rank` values are below it.
  std::size_t rank = 0;
  while (2 * rank < n && boost::math::cdf(heads, static_cast<double>(rank)) <= tail) ++rank;
  return between_ranks(values, rank, n);
}

MedianInterval exponential(const MedianInterval& of_logs) {
  return {std::exp(of_logs.median), std::exp(of_logs.low), std::exp(of_logs.high), of_logs.n};
}

MedianInterval if_known(const MedianInterval& values) {
  const bool known = values.n >= fewest_squares && !std::isnan(values.low);
  return known ? values : MedianInterval{nan, nan, nan, values.n};
}

double mann_whitney(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.empty()) return 1;
  const DoubledRanks ranks(a, b);
  const std::size_t sum = std::accumulate(ranks.of_a.begin(), ranks.of_a.end(), std::size_t{0});
  if (ranks.all.size() <= most_exact) {
    const std::vector<double> p = rank_sum_distribution(ranks.all, a.size());
    const auto at = p.begin() + static_cast<std::ptrdiff_t>(sum);
    const double below = std::accumulate(p.begin(), at + 1, 0.0);
    const double above = std::accumulate(at, p.end(), 0.0);
    return std::min(1.0, 2 * std::min(below, above));
  }
  const auto n = static_cast<double>(a.size());
  const auto m = static_cast<double>(b.size());
  const double mean = n * (n + m + 1) / 2;
  const double variance = n * m / 12 * (n + m + 1 - ranks.tie_term / ((n + m) * (n + m - 1)));
  if (variance <= 0) return 1;  // all values are equal
  const double off = std::abs(static_cast<double>(sum) / 2 - mean);
  const double z = std::max(0.0, off - 0.5) / std::sqrt(variance);
  return 2 * boost::math::cdf(boost::math::complement(Normal(), z));
}

MedianInterval shift(std::span<const double> a, std::span<const double> b, double confidence) {
  std::vector<double> differences;
  differences.reserve(a.size() * b.size());
  for (const double x : a) {
    for (const double y : b) differences.push_back(y - x);
  }
  std::ranges::sort(differences);
  const std::size_t n = std::min(a.size(), b.size());
  const std::size_t rank = n == 0 ? 0 : shift_rank(a.size(), b.size(), (1 - confidence) / 2);
  return between_ranks(differences, rank, n);
}

std::vector<double> holm(std::span<const double> p) {
  std::vector<std::size_t> order(p.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return p[i]; });
  std::vector<double> corrected(p.size());
  double least = 0;  // a corrected probability is never below that of a smaller one
  for (std::size_t i = 0; i < order.size(); ++i) {
    least = std::max(least, std::min(1.0, p[order[i]] * static_cast<double>(p.size() - i)));
    corrected[order[i]] = least;
  }
  return corrected;
}

std::vector<double> modified_z(std::span<const double> values) {
  const double middle = median({values.begin(), values.end()});
  std::vector<double> deviations;
  for (const double x : values) deviations.push_back(std::abs(x - middle));
  double scale = median(deviations) / 0.6745;
  if (scale == 0) {
    // Both estimate the standard deviation of a normal distribution.
    const double mean = std::accumulate(deviations.begin(), deviations.end(), 0.0) /
                        static_cast<double>(deviations.size());
    scale = mean * std::sqrt(std::acos(-1.0) / 2);
  }
  std::vector<double> z;
  for (const double x : values) z.push_back(scale > 0 ? (x - middle) / scale : 0.0);
  return z;
}

PowerLaw fit_power_law(std::span<const double> x, std::span<const double> y, double confidence) {
  const std::size_t n = x.size();
  PowerLaw law{nan, nan, nan, nan, n};
  if (n == 0) return law;
  double mean_x = 0;
  double mean_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += std::log(x[i]) / static_cast<double>(n);
    mean_y += std::log(y[i]) / static_cast<double>(n);
  }
  double xx = 0;
  double xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double dx = std::log(x[i]) - mean_x;
    xx += dx * dx;
    xy += dx * (std::log(y[i]) - mean_y);
  }
  std::vector<double> distinct(x.begin(), x.end());
  std::ranges::sort(distinct);
  const auto repeated = std::ranges::unique(distinct);
  const std::size_t places = n - repeated.size();
  if (places < 2) return law;
  law.exponent = xy / xx;
  law.factor = std::exp(mean_y - law.exponent * mean_x);
  if (places < 3) return law;
  double residual = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = std::log(y[i]) - mean_y - law.exponent * (std::log(x[i]) - mean_x);
    residual += r * r;
  }
  const auto freedom = static_cast<double>(n - 2);
  const double half = boost::math::quantile(StudentsT(freedom), (1 + confidence) / 2) *
                      std::sqrt(residual / freedom / xx);
  law.low = law.exponent - half;
  law.high = law.exponent + half;
  return law;
}

std::string interval_cell(const MedianInterval& values, double scale) {
  return std::isnan(values.low)
             ? std::string("-")
             : fmt::format("{:.4g} to {:.4g}", values.low * scale, values.high * scale);
}

}  // namespace touchstone::stats
