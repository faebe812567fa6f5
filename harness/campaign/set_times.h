// The timed samples of one set, as its rows tell them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/record/raw_row.h"
#include "harness/stats/samples.h"

namespace touchstone::campaign {

class SetTimes {
 public:
  // The rows of one sample come one after the other.
  void add(const record::RawRow& row);

  // The name of the baseline's second registration, the A/A control.
  static std::string twin_of(const std::string& label) { return label + " (twin)"; }

  bool has(const std::string& label) const { return contestants_.contains(label); }
  std::vector<std::string> labels() const;
  // The contestant with a control; empty where there is none.
  const std::string& baseline() const { return baseline_; }
  // All samples that count, seconds a frame or a query. Rounds with flags do not count, unless
  // `noisy`.
  std::vector<double> times(const std::string& label, bool noisy) const;
  // log(a / b) of the squares that both were in.
  std::vector<double> log_ratios(const std::string& a, const std::string& b, bool noisy) const;
  // log(a / b) with its interval; of those that never met, by what each has to the baseline.
  stats::MedianInterval log_ratio(const std::string& a, const std::string& b, bool noisy,
                                  double confidence) const;

 private:
  const stats::Contestant& find(const std::string& label) const;

  std::map<std::string, stats::Contestant> contestants_;
  std::string baseline_;
};

// The half-width of an interval of a ratio, as a part of it; NaN where there is no interval.
double half_width(const stats::MedianInterval& log_ratio);

}  // namespace touchstone::campaign
