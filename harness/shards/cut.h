// Cuts numbered units into shards of about the same cost.
#pragma once

#include <cstdint>
#include <vector>

#include "harness/base/unit_range.h"

namespace touchstone::shards {

// The costs of units, of which there may be more than fit into memory: the costs of the first ones,
// which the others repeat.
class Costs {
 public:
  // `period` is not empty, and its values are finite and above 0; `units` is at least 1.
  Costs(const std::vector<double>& period, std::int64_t units);

  std::int64_t units() const { return units_; }
  double of(base::UnitRange range) const { return before(range.end) - before(range.first); }

 private:
  double before(std::int64_t unit) const;  // the sum over the units below it

  std::vector<double> sums_;  // over the first units of a period; one more than it has
  std::int64_t units_;
};

// Returns `shards` ranges, none of them empty, in order, that together are all units, and whose
// greatest cost is the least possible up to a part in 10^6. There are at least as many units as
// shards.
std::vector<base::UnitRange> cut(const Costs& costs, std::int64_t shards);

}  // namespace touchstone::shards
