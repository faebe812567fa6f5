// The times of a trade's points, from the rounds of its timing.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harness/trade/point_times.h"

namespace touchstone::trade {

// Contestant i of the plan is point i; point 0 is the baseline, and the last contestant is its
// control.
class PointStatistics {
 public:
  explicit PointStatistics(std::size_t points) : ratios_(points + 1), stages_(points) {}

  void add(const measure::Round& round);
  // Fills in the times of points that were not lost.
  void summarise(PointTimes& times) const;

 private:
  // Values of quiet rounds, and of rounds that other work disturbed.
  struct Values {
    std::vector<double> quiet, noisy;
    std::vector<double> chosen() const;
  };

  Values baseline_;             // seconds a frame
  std::vector<Values> ratios_;  // for each contestant: logarithms of its ratios to the baseline
  std::vector<std::array<std::vector<double>, stage_names.size()>> stages_;
};

}  // namespace touchstone::trade
