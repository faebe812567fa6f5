// Adds and finds seconds by name.
#include "harness/measure/sampler.h"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace touchstone::measure {

void Durations::add(std::string_view name, double seconds) {
  const auto used = durations_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto at = std::find_if(durations_.begin(), used,
                               [&](const Duration& duration) { return duration.name() == name; });
  if (at == used) {
    if (count_ == most || name.size() > longest_name) {
      throw std::length_error("no room for another duration of a sample");
    }
    std::ranges::copy(name, at->name_.begin());
    ++count_;
  }
  at->seconds += seconds;
}

double Durations::of(std::string_view name) const {
  for (const Duration& duration : all()) {
    if (duration.name() == name) return duration.seconds;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double Durations::sum() const {
  double sum = 0;
  for (const Duration& duration : all()) sum += duration.seconds;
  return sum;
}

}  // namespace touchstone::measure
