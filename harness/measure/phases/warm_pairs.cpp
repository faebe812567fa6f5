// Orders the pairs of a set by slot and task.
#include "harness/measure/phases/warm_pairs.h"

#include <algorithm>
#include <numeric>

namespace touchstone::measure {
namespace {

std::uint64_t key(const grade::PairGroup& group, std::size_t i) {
  const auto [low, high] = std::minmax(group.first[i], group.second[i]);
  return (std::uint64_t{low} << 32) + high;
}

}  // namespace

WarmPairs::WarmPairs(const NarrowSet& set, std::size_t slots_a_task) {
  std::vector<std::uint64_t> keys;
  keys.reserve(set.pairs());
  for (const grade::PairGroup& group : set.frames) {
    for (std::size_t i = 0; i < group.size(); ++i) keys.push_back(key(group, i));
  }
  std::ranges::sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  slots_ = keys.size();
  tasks_ = (slots_ + slots_a_task - 1) / slots_a_task;

  for (const grade::PairGroup& group : set.frames) {
    Frame& frame = frames_.emplace_back();
    frame.pairs.kind_a = group.kind_a;
    frame.pairs.kind_b = group.kind_b;
    std::vector<std::uint32_t> slots(group.size()), order(group.size());
    for (std::size_t i = 0; i < group.size(); ++i) {
      slots[i] =
          static_cast<std::uint32_t>(std::ranges::lower_bound(keys, key(group, i)) - keys.begin());
    }
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return slots[i] / slots_a_task; });
    frame.begins.push_back(0);
    for (const std::uint32_t i : order) {
      while (frame.begins.size() <= slots[i] / slots_a_task) {
        frame.begins.push_back(frame.slots.size());
      }
      frame.pairs.first.push_back(group.first[i]);
      frame.pairs.second.push_back(group.second[i]);
      frame.slots.push_back(slots[i]);
    }
    frame.begins.resize(tasks_ + 1, frame.slots.size());
    if (!std::ranges::is_sorted(order)) frame.places = std::move(order);
  }
}

}  // namespace touchstone::measure
