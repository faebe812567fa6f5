// Part of sweep-and-prune: the insertion-sort update of an EndpointList. See
// endpoint_list.h.
#include <algorithm>

#include "algorithms/broad_phase/sweep_and_prune/endpoint_list.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

bool overlap_on(const Aabb& a, const Aabb& b, std::size_t axis) {
  return a.min[axis] <= b.max[axis] && b.min[axis] <= a.max[axis];
}

}  // namespace

bool EndpointList::repair(const EndpointMotion& motion, std::size_t most_passes) {
  make_shadows(motion.before());
  cast_shadows(motion, 0, axis_);
  changes_.clear();
  // Measured: a pass over all end points takes as long as finding those of a third of the bodies.
  const std::size_t changed = motion.on(axis_).size();
  const bool are_few = 6 * changed <= points_.size();
  if (changed > 0 &&
      !(are_few ? repair_few(motion, most_passes) : repair_all(motion, most_passes))) {
    return false;
  }
  cast_shadows(motion, axis_ + 1, 3);
  return true;
}

// Updates the shadows of the axes first <= axis < last.
void EndpointList::cast_shadows(const EndpointMotion& motion, std::size_t first, std::size_t last) {
  if (last - first == 2 && motion.is_common()) {
    for (const std::uint32_t id : motion.on(first)) set_shadows(id, motion.now()[id]);
    return;
  }
  for (std::size_t other = first; other < last; ++other) {
    for (const std::uint32_t id : motion.on(other)) set_shadow(id, other, motion.now()[id]);
  }
}

// Insertion sort of all end points; returns false if it takes too many passes.
bool EndpointList::repair_all(const EndpointMotion& motion, std::size_t most_passes) {
  is_placed_ = false;
  const std::span<Endpoint> points = points_;
  const std::size_t axis = axis_;
  std::size_t passes = 0;
  std::size_t listed = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t id = body_of(points[i]);
    points[i] = endpoint(motion.now()[id], axis, is_max(points[i]), id);
    passes += move<down, false>(points, i, listed, motion);
    if (passes > most_passes) return false;
  }
  look_at_passes(listed, motion);
  return true;
}

// Updates only the end points that changed. Those that stay between their neighbours, as most do,
// are detected without a branch; the others then move one by one through the sorted ones.
bool EndpointList::repair_few(const EndpointMotion& motion, std::size_t most_passes) {
  make_places(motion.now().size());
  const std::span<Endpoint> points = points_;
  const std::size_t axis = axis_;
  const std::span<const std::uint32_t> changed = motion.on(axis);
  fresh_.resize(2 * changed.size() + 1);  // one more entry is written
  std::size_t count = 0;
  for (const std::uint32_t id : changed) {
    for (const bool max : {false, true}) {
      const Endpoint now = endpoint(motion.now()[id], axis, max, id);
      const std::size_t at = place(now);
      const Endpoint then = points[at];
      const Endpoint below = points[at - (at > 0 ? 1 : 0)];
      const Endpoint above = points[at + (at + 1 < points.size() ? 1 : 0)];
      const bool stays = (below <= now) & (now <= above);
      points[at] = stays ? now : then;
      fresh_[count] = now;
      count += stays ? 0 : 1;
    }
  }
  std::size_t passes = 0;
  std::size_t listed = 0;
  for (const Endpoint now : std::span(fresh_).first(count)) {
    const std::size_t at = place(now);
    const Endpoint then = points[at];
    points[at] = now;
    passes += now < then ? move<down, true>(points, at, listed, motion)
                         : move<up, true>(points, at, listed, motion);
    if (passes > most_passes) return false;
  }
  look_at_passes(listed, motion);
  return true;
}

// Moves the end point at a place to where it belongs, and lists those of the other kind that it
// passes. Returns the number of all that it passes.
template <std::ptrdiff_t way, bool with_places>
std::size_t EndpointList::move(std::span<Endpoint> points, std::size_t at, std::size_t& listed,
                               const EndpointMotion& motion) {
  const Endpoint point = points[at];
  const auto is_next = [&](std::size_t to) {
    if constexpr (way == down) return to > 0 && point < points[to - 1];
    return to + 1 < points.size() && points[to + 1] < point;
  };
  std::size_t to = at;
  while (is_next(to)) {
    const Endpoint other = points[to] = points[to + way];
    if constexpr (with_places) place(other) = static_cast<std::uint32_t>(to);
    to += way;
    // There is no branch: minimum or maximum is unpredictable.
    passes_[listed] = way == down ? Pass{point, other} : Pass{other, point};
    listed += (other ^ point) >> 31 & 1;
    if (listed == passes_.size()) {
      look_at_passes(listed, motion);
      listed = 0;
    }
  }
  points[to] = point;
  if constexpr (with_places) place(point) = static_cast<std::uint32_t>(to);
  return way == down ? at - to : to - at;
}

// Tests the boxes of end points that have passed each other. A pair comes if its boxes overlap on
// this axis after the frame and not before it; it goes in the opposite case. Either counts only if
// the boxes overlap on the axes updated before this one after the frame, and on the others before
// it.
void EndpointList::look_at_passes(std::size_t listed, const EndpointMotion& motion) {
  using Lanes = simd::baseline::Simd<float>;
  for (const Pass& pass : std::span(passes_).first(listed)) {
    const std::uint32_t a = body_of(pass.lower);
    const std::uint32_t b = body_of(pass.upper);
    const Shadow& own = shadows_[a];
    const Lanes::Vector reach{-own[1], -own[0], -own[3], -own[2]};
    if (Lanes::to_bits(Lanes::less_equal(Lanes::load(shadows_[b].data()), reach)) != 0xf) continue;
    const bool comes = is_max(pass.upper);
    const bool now = overlap_on(motion.now()[a], motion.now()[b], axis_);
    const bool then = overlap_on(motion.before()[a], motion.before()[b], axis_);
    if (now != comes || then == comes) continue;
    changes_.push_back({{std::min(a, b), std::max(a, b)}, comes});
  }
}

}  // namespace touchstone
