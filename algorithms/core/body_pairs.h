// Pairs of bodies: part of every batch of a narrow phase or a contact manifold.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/core/pose.h"

namespace touchstone {

// Pair i consists of bodies first[i] and second[i]; body k has the shape with the number
// shape_of[k] and the pose poses[k].
struct BodyPairs {
  std::span<const std::uint32_t> first, second;
  std::span<const std::uint32_t> shape_of;
  std::span<const Pose> poses;
};

}  // namespace touchstone
