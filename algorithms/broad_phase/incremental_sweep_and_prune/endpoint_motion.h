// Which bodies have moved, axis by axis: a car on a street moves on one of three.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "algorithms/core/aabb.h"

namespace touchstone {

// Of some bodies between two frames. Keeps its memory, and no more than views of the boxes.
class EndpointMotion {
 public:
  // The lists of these bodies; they and the boxes are to stay as they are while this is used.
  void start(std::span<const Aabb> before, std::span<const Aabb> now,
             std::span<const std::uint32_t> moved);

  std::span<const Aabb> before() const { return before_; }  // of all bodies, by id
  std::span<const Aabb> now() const { return now_; }
  // Those whose extents on the axis are others than before. Where nearly all bodies move, all that
  // do: it is then not worth while to tell them apart.
  std::span<const std::uint32_t> on(std::size_t axis) const { return changed_[axis]; }
  // Whether the lists of all axes are the same.
  bool is_common() const { return changed_[0].data() == changed_[2].data(); }

  std::size_t held_bytes() const;

 private:
  void tell_apart(std::span<const std::uint32_t> moved);

  std::span<const Aabb> before_, now_;
  std::array<std::span<const std::uint32_t>, 3> changed_;
  std::array<std::vector<std::uint32_t>, 3> lists_;
};

}  // namespace touchstone
