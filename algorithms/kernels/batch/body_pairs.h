// Pairs of bodies, as the batches of a narrow phase have them.
#pragma once

#include <cstdint>
#include <span>

#include "algorithms/core/pose.h"

namespace touchstone {

// Pair i is of bodies first[i] and second[i]; body k has the shape shape_of[k] and the pose
// poses[k].
struct BodyPairs {
  std::span<const std::uint32_t> first, second;
  std::span<const std::uint32_t> shape_of;
  std::span<const Pose> poses;
};

}  // namespace touchstone
