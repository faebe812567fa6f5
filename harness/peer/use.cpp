// Counts what peers take, over processes.
#include "harness/peer/use.h"

#include <algorithm>
#include <vector>

namespace touchstone::peer {
namespace {

constexpr std::size_t most_times = 1'000'000;

}  // namespace

Use::Use(std::int64_t repeat) : repeat_(repeat), seconds_(repeat > 0 ? most_times : 0) {}

void Use::add_memory(std::size_t bytes) {
  std::atomic<std::int64_t>& most = counts_[0].memory;
  const auto now = static_cast<std::int64_t>(bytes);
  for (std::int64_t before = most; before < now && !most.compare_exchange_weak(before, now);) {
  }
}

void Use::add_seconds(double seconds) {
  const auto place = static_cast<std::size_t>(counts_[0].times++);
  if (place < seconds_.size()) seconds_[place] = seconds;
}

PeerRow Use::row(std::string_view name) const {
  PeerRow row = {.peer = std::string(name),
                 .starts = counts_[0].starts,
                 .peak_memory = counts_[0].memory,
                 .repeat = repeat_,
                 .repeated = counts_[0].times};
  const std::size_t kept = std::min(static_cast<std::size_t>(row.repeated), seconds_.size());
  std::vector<double> times(seconds_.span().begin(),
                            seconds_.span().begin() + static_cast<std::ptrdiff_t>(kept));
  if (times.empty()) return row;
  std::ranges::sort(times);
  row.least_seconds = times.front();
  row.median_seconds = (times[(times.size() - 1) / 2] + times[times.size() / 2]) / 2;
  row.greatest_seconds = times.back();
  return row;
}

}  // namespace touchstone::peer
