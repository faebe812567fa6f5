// Part of sweep-and-prune: for each axis, the bodies whose end points on it have moved
// between two frames. A car on a street moves along one axis of three.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"

namespace touchstone {

// The moved bodies of a frame, by axis. The class keeps its memory and views of the boxes.
class EndpointMotion {
 public:
  // Lists these bodies; the spans must stay valid and unchanged while this object is in use.
  void start(std::span<const Aabb> before, std::span<const Aabb> now,
             std::span<const std::uint32_t> moved);

  std::span<const Aabb> before() const { return before_; }  // boxes of all bodies, by id
  std::span<const Aabb> now() const { return now_; }
  // The bodies whose extents on the axis have changed; if nearly all bodies move, all moved bodies,
  // because sorting them by axis does not pay then.
  std::span<const std::uint32_t> on(std::size_t axis) const { return changed_[axis]; }
  // True if the axes share one list.
  bool is_common() const { return changed_[0].data() == changed_[2].data(); }

  std::size_t held_bytes() const;

 private:
  void list_by_axis(std::span<const std::uint32_t> moved);

  std::span<const Aabb> before_, now_;
  std::array<std::span<const std::uint32_t>, 3> changed_;
  std::array<std::vector<std::uint32_t>, 3> lists_;
};

}  // namespace touchstone
