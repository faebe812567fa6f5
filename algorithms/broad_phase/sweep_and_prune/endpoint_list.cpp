// Part of sweep-and-prune: sorting end points, and merging bodies in and out.
#include "algorithms/broad_phase/sweep_and_prune/endpoint_list.h"

#include <algorithm>

#include "algorithms/core/executor/parallel_blocks.h"
#include "algorithms/core/memory_usage.h"

namespace touchstone {

EndpointList::Overlaps EndpointList::count_overlaps() const {
  const auto bodies = static_cast<std::int64_t>(points_.size() / 2);
  Overlaps overlaps;
  std::int64_t begun = 0;
  std::int64_t open = 0;
  for (const Endpoint point : points_) {
    const std::int64_t max = is_max(point) ? 1 : 0;
    overlaps.candidates += (1 - max) * open;
    overlaps.ended += max * (begun < bodies ? 1 : 0);
    begun += 1 - max;
    open += 1 - 2 * max;
  }
  return overlaps;
}

std::size_t EndpointList::count_between(float from, float to) const {
  const auto [low, high] = std::minmax(from, to);
  const auto first = std::ranges::lower_bound(points_, endpoint(low, false, 0));
  const auto last = std::ranges::lower_bound(points_, endpoint(high, false, 0));
  return static_cast<std::size_t>(last - first);
}

void EndpointList::sort(Executor& executor, std::span<const Aabb> boxes,
                        std::span<const std::uint32_t> ids, RadixSort<Endpoint>& radix_sort) {
  is_shadowed_ = is_placed_ = false;
  points_.resize(2 * ids.size());
  for_each_block(executor, ids.size(), 8192, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
      points_[i] = endpoint(boxes[ids[i]], axis_, false, ids[i]);
      points_[ids.size() + i] = endpoint(boxes[ids[i]], axis_, true, ids[i]);
    }
  });
  radix_sort(executor, points_, 33, [](Endpoint point) { return point >> 31; });
}

void EndpointList::take_out(std::span<const std::uint8_t> mark) {
  std::erase_if(points_, [&](Endpoint point) { return mark[body_of(point)] != 0; });
  is_placed_ = false;
}

void EndpointList::put_in(std::span<const Aabb> boxes, std::span<const std::uint32_t> ids) {
  is_placed_ = false;
  if (is_shadowed_) {
    shadows_.resize(boxes.size());
    for (const std::uint32_t id : ids) set_shadows(id, boxes[id]);
  }
  fresh_.clear();
  for (const std::uint32_t id : ids) {
    if (boxes[id].is_empty()) continue;
    fresh_.push_back(endpoint(boxes[id], axis_, false, id));
    fresh_.push_back(endpoint(boxes[id], axis_, true, id));
  }
  std::ranges::sort(fresh_);
  // The merge runs from the back, within the array of the old end points.
  std::size_t old = points_.size();
  points_.resize(old + fresh_.size());
  for (std::size_t to = points_.size(), more = fresh_.size(); more > 0;) {
    const bool take = old == 0 || points_[old - 1] < fresh_[more - 1];
    points_[--to] = take ? fresh_[--more] : points_[--old];
  }
}

void EndpointList::make_shadows(std::span<const Aabb> boxes) {
  shadows_.resize(boxes.size());
  if (is_shadowed_) return;
  is_shadowed_ = true;
  for (std::uint32_t id = 0; id < boxes.size(); ++id) set_shadows(id, boxes[id]);
}

void EndpointList::make_places(std::size_t id_count) {
  places_.resize(2 * id_count);
  if (is_placed_) return;
  is_placed_ = true;
  for (std::uint32_t at = 0; at < points_.size(); ++at) place(points_[at]) = at;
}

std::size_t EndpointList::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(points_, fresh_, shadows_, places_, changes_));
}

}  // namespace touchstone
