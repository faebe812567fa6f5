// Cuts units into ranges by bisection of the greatest cost.
#include "harness/shards/cut.h"

#include <algorithm>

namespace touchstone::shards {
namespace {

// Fills one range after the other up to the cost `most`, and leaves a unit for each range that
// follows. The last range takes what is left, which may cost more.
std::vector<base::UnitRange> fill(const Costs& costs, std::int64_t shards, double most) {
  std::vector<base::UnitRange> ranges;
  std::int64_t first = 0;
  for (std::int64_t shard = 0; shard < shards; ++shard) {
    const std::int64_t end_at_most = costs.units() - (shards - 1 - shard);
    std::int64_t low = first + 1, high = end_at_most;
    if (shard + 1 == shards) low = high;
    while (low < high) {
      const std::int64_t middle = low + (high - low + 1) / 2;
      if (costs.of({first, middle}) <= most) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    ranges.push_back({first, low});
    first = low;
  }
  return ranges;
}

double greatest(const Costs& costs, const std::vector<base::UnitRange>& ranges) {
  double cost = 0;
  for (const base::UnitRange& range : ranges) cost = std::max(cost, costs.of(range));
  return cost;
}

}  // namespace

Costs::Costs(const std::vector<double>& period, std::int64_t units) : units_(units) {
  sums_.push_back(0);
  for (const double cost : period) sums_.push_back(sums_.back() + cost);
}

double Costs::before(std::int64_t unit) const {
  const auto period = static_cast<std::int64_t>(sums_.size()) - 1;
  return static_cast<double>(unit / period) * sums_.back() +
         sums_[static_cast<std::size_t>(unit % period)];
}

std::vector<base::UnitRange> cut(const Costs& costs, std::int64_t shards) {
  constexpr double precision = 1e-6;
  double high = costs.of({0, costs.units()});
  double low = high / static_cast<double>(shards);
  std::vector<base::UnitRange> best = fill(costs, shards, low);
  high = greatest(costs, best);
  while (high - low > precision * high) {
    const double middle = (low + high) / 2;
    std::vector<base::UnitRange> ranges = fill(costs, shards, middle);
    const double cost = greatest(costs, ranges);
    if (cost < high) {
      high = cost;
      best = std::move(ranges);
    }
    // Nothing below `middle` is possible where even filling up to it leaves too much for the last.
    if (cost > middle) {
      low = middle;
    } else {
      high = std::min(high, middle);
    }
  }
  return best;
}

}  // namespace touchstone::shards
