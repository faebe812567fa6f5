// From the rounds of a timing to the times of its points.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "harness/trade/point_times.h"

namespace touchstone::trade {

// Contestant i of the plan is point i; point 0 is the baseline, and the last contestant its
// control.
class PointStatistics {
 public:
  explicit PointStatistics(std::size_t points) : ratios_(points + 1), stages_(points) {}

  void add(const measure::Round& round);
  // Fills in the times of points that were not lost.
  void summarise(PointTimes& times) const;

 private:
  // Values of rounds that the machine left alone, and of the others.
  struct Values {
    std::vector<double> quiet, noisy;
    std::vector<double> chosen() const;
  };

  Values baseline_;             // seconds a frame
  std::vector<Values> ratios_;  // of each contestant: logarithms of ratios to the baseline
  std::vector<std::array<std::vector<double>, stage_names.size()>> stages_;
};

}  // namespace touchstone::trade
