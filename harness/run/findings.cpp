#include "harness/run/findings.h"

#include <algorithm>

namespace touchstone {

void Findings::add(const std::string& narrow, Task task, const std::string& pair_kind,
                   const OutcomeFaults& faults) {
  outcomes_[{task, narrow, pair_kind}].add(faults);
}

bool Findings::same_at_every_width(const std::string& key, const std::string& fingerprint) {
  return fingerprints_.try_emplace(key, fingerprint).first->second == fingerprint;
}

bool Findings::ours_are_wrong() const {
  return std::ranges::any_of(departures_, [](const Departure& d) { return d.ours && !d.known; });
}

}  // namespace touchstone
