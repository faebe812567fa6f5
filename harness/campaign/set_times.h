// The timed samples of one set, from its rows.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "harness/measure/measuring_loop.h"
#include "harness/record/raw_row.h"
#include "harness/stats/samples.h"

namespace touchstone::campaign {

class SetTimes {
 public:
  // Adds a row; the rows of one sample are consecutive.
  void add(const record::RawRow& row);

  // Returns the name of the baseline's second registration, the A/A control.
  static std::string twin_of(const std::string& label) { return label + " (twin)"; }

  bool has(const std::string& label) const { return contestants_.contains(label); }
  std::vector<std::string> labels() const;
  // Returns the contestant with a control; empty if there is none.
  const std::string& baseline() const { return baseline_; }
  // Returns all samples that count, in seconds a frame or a query. Rounds with flags count only
  // with `noisy`.
  std::vector<double> times(const std::string& label, bool noisy) const;
  // Returns true if the A/A control differs from the baseline by more than the width.
  bool twin_differs(double width) const;
  // Returns log(a / b) of the squares that both were in.
  std::vector<double> log_ratios(const std::string& a, const std::string& b, bool noisy) const;

 private:
  const stats::Contestant& find(const std::string& label) const;

  std::map<std::string, stats::Contestant> contestants_;
  std::string baseline_;
};

// Write into a row the place of a sample in its round, what its process counted, how it was lost, and that the
// baseline of its set differs from its twin.
void note_place(record::RawRow& row, const measure::Round& round, const measure::Sample& sample);
void note_counters(record::RawRow& row, const measure::SampleReply& reply);
void note_loss(record::RawRow& row, const measure::Loss& loss);
void note_canary(record::RawRow& row);

// Returns the half-width of a ratio's interval, as a part of the ratio; NaN if there is no
// interval.
double half_width(const stats::MedianInterval& log_ratio);

}  // namespace touchstone::campaign
