// Finds the fastest contestant of a set.
#include "harness/stats/tables/fastest.h"

#include <cmath>
#include <limits>

#include "harness/stats/tables/tables.h"

namespace touchstone::stats {

const Contestant* fastest(const SampleSet& set, Noise noise,
                          const std::function<bool(const Contestant&)>& takes_part) {
  const Contestant* best = nullptr;
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const Contestant& contestant : set.contestants) {
    if (contestant.failure || !takes_part(contestant)) continue;
    const double ratio = median(paired_log_ratios(contestant, set.baseline(), noise));
    if (std::isnan(ratio) || ratio >= least) continue;
    least = ratio;
    best = &contestant;
  }
  return best;
}

const Contestant* fastest_right(const SampleSet& set, Noise noise,
                                const std::function<bool(const Contestant&)>& takes_part) {
  return fastest(set, noise, [&](const Contestant& contestant) {
    return takes_part(contestant) && !is_wrong(set, contestant);
  });
}

std::set<std::int64_t> batches_of(const SampleSet& set) {
  std::set<std::int64_t> batches;
  for (const Contestant& contestant : set.contestants) batches.insert(contestant.batch);
  return batches;
}

}  // namespace touchstone::stats
