// Part of sweep-and-prune: the end points of boxes on an axis, as integers that sort
// like them.
// Paper: Baraff, "Dynamic Simulation of Non-Penetrating Rigid Bodies", thesis, Cornell 1992.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "algorithms/core/aabb.h"
#include "algorithms/kernels/sorting/ordered_key.h"

namespace touchstone {

// An end point: its key, then a bit that is set for a maximum, then the body's id. At equal keys
// minima come first, because closed boxes that touch overlap. Ids are below 2^31.
using Endpoint = std::uint64_t;

inline Endpoint endpoint(float x, bool is_max, std::uint32_t id) {
  return sort_item(ordered_key(x), (is_max ? 0x80000000u : 0) | id);
}
inline bool is_max(Endpoint point) { return (point >> 31 & 1) != 0; }
inline std::uint32_t body_of(Endpoint point) {
  return static_cast<std::uint32_t>(point) & 0x7fffffff;
}
// The choice between the two ends has no branch, since it is unpredictable.
inline Endpoint endpoint(const Aabb& box, std::size_t axis, bool max, std::uint32_t id) {
  const auto low = std::bit_cast<std::uint32_t>(box.min[axis]);
  const auto high = std::bit_cast<std::uint32_t>(box.max[axis]);
  const std::uint32_t mask = 0 - std::uint32_t{max};
  return endpoint(std::bit_cast<float>(low ^ ((low ^ high) & mask)), max, id);
}

}  // namespace touchstone
