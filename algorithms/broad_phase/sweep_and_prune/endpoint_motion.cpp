// Part of sweep-and-prune: lists for each axis the bodies whose extents on it changed.
#include "algorithms/broad_phase/sweep_and_prune/endpoint_motion.h"

#include "algorithms/core/memory_usage.h"

namespace touchstone {

void EndpointMotion::start(std::span<const Aabb> before, std::span<const Aabb> now,
                           std::span<const std::uint32_t> moved) {
  before_ = before;
  now_ = now;
  changed_ = {moved, moved, moved};
  if (moved.size() <= before.size() / 8 * 5) list_by_axis(moved);
}

// Puts each body into the lists of the axes on which it changed; without a branch, since that is
// unpredictable.
void EndpointMotion::list_by_axis(std::span<const std::uint32_t> moved) {
  std::array<std::uint32_t*, 3> ends;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // The loop below writes one entry past the end, so each list has room for it.
    if (lists_[axis].size() <= moved.size()) lists_[axis].resize(moved.size() + 1);
    ends[axis] = lists_[axis].data();
  }
  for (const std::uint32_t id : moved) {
    const Aabb& then = before_[id];
    const Aabb& now = now_[id];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      *ends[axis] = id;
      ends[axis] += (then.min[axis] != now.min[axis]) | (then.max[axis] != now.max[axis]);
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) changed_[axis] = {lists_[axis].data(), ends[axis]};
}

std::size_t EndpointMotion::held_bytes() const {
  return static_cast<std::size_t>(sum_held_bytes(lists_[0], lists_[1], lists_[2]));
}

}  // namespace touchstone
