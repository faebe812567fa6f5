// Squares, windows and periods of a plan; shuffles a cyclic Latin square.
#include "harness/measure/measure_plan.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "harness/base/hash.h"

namespace touchstone::measure {
namespace {

std::vector<std::size_t> shuffled(std::size_t size, base::Random& random) {
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = size; i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

LatinSquare latin_square(std::size_t size, base::Random& random) {
  const std::vector<std::size_t> rounds = shuffled(size, random);
  const std::vector<std::size_t> positions = shuffled(size, random);
  const std::vector<std::size_t> contestants = shuffled(size, random);
  LatinSquare square(size, std::vector<std::size_t>(size));
  for (std::size_t r = 0; r < size; ++r) {
    for (std::size_t p = 0; p < size; ++p) {
      square[r][p] = contestants[(rounds[r] + positions[p]) % size];
    }
  }
  return square;
}

namespace {

constexpr std::array<int, 4> looks = {first_look, 12, 24, 48};  // the number of squares of a group

}  // namespace

std::size_t MeasuredSet::rounds(std::size_t group) const {
  return std::min(groups[group].size(), most_rounds);
}

SampleRequest MeasuredSet::request(int lap, std::size_t group, std::size_t round) const {
  const std::size_t windows = warm_up_windows + rounds(group);
  return window_at(static_cast<std::size_t>(lap) * windows + warm_up_windows + round);
}

SampleRequest MeasuredSet::warm_up_request(int lap, std::size_t group,
                                           std::size_t warm_up_window) const {
  const std::size_t windows = warm_up_windows + rounds(group);
  return window_at(static_cast<std::size_t>(lap) * windows + warm_up_window);
}

SampleRequest MeasuredSet::window_at(std::size_t place) const {
  const std::size_t wanted = starts.front() + (place * window) % (frames - starts.front());
  const auto at = std::ranges::lower_bound(starts, wanted);
  return {.set = number,
          .frame = static_cast<std::uint32_t>(at == starts.end() ? starts.front() : *at),
          .frames = window,
          .skips_first = skips_first};
}

std::vector<Period> periods(std::optional<int> squares, int processes) {
  std::vector<Period> all;
  int done = 0;
  int process = 0;
  const auto add = [&](int until) {
    Period& period = all.emplace_back();
    const int count = until - done;
    for (int i = 0; i < processes; ++i) {
      const int first = done + i * count / processes;
      const int end = done + (i + 1) * count / processes;
      if (end > first) period.push_back({process++, first, end});
    }
    done = until;
  };
  if (squares) {
    add(*squares);
  } else {
    for (const int look : looks) add(look);
  }
  return all;
}

LatinSquare square_order(const MeasurePlan& plan, std::size_t set, std::int64_t square,
                         std::size_t size) {
  const std::uint64_t place =
      base::mix(base::mix(base::mix(plan.number) + set) + static_cast<std::uint64_t>(square));
  base::Random random(plan.seed, place);
  return latin_square(size, random);
}

}  // namespace touchstone::measure
