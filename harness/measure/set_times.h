// The timed samples of one set.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/run/raw_row.h"
#include "harness/stats/statistics.h"

namespace touchstone {

class SetTimes {
 public:
  // The rows of one sample come one after the other.
  void add(const RawRow& row);

  // The name of the baseline's second registration.
  static std::string twin_of(const std::string& label) { return label + " (twin)"; }

  bool has(const std::string& label) const { return samples_.contains(label); }
  std::vector<std::string> labels() const;
  // The one with a twin; empty where there is none.
  const std::string& baseline() const { return baseline_; }
  // All samples that count, seconds a frame or a query. Rounds with flags do not count, unless
  // `noisy`.
  std::vector<double> times(const std::string& label, bool noisy) const;
  // log(a / b) of the squares: each is the median over its rounds. Contestants of different groups
  // are compared through the baseline, which both have met.
  std::vector<double> log_ratios(const std::string& a, const std::string& b, bool noisy) const;

 private:
  struct Sample {
    std::int64_t square = 0, round = 0, position = 0;
    double seconds = 0, units = 0;
    bool noisy = false;
  };
  std::map<std::int64_t, double> by_square(const std::string& label, bool noisy) const;

  std::map<std::string, std::vector<Sample>> samples_;
  std::string baseline_;
};

// The half-width of an interval of a ratio, as a part of it; NaN where there is no interval.
double half_width(const stats::MedianInterval& log_ratio);

}  // namespace touchstone
