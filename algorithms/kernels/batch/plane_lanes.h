// Tests the separating planes that pairs of bodies carry (kernels/gjk/carried_plane.h), one pair in
// each lane of vectors. Used by gjk, gjk-lanes, ellipsoid and smooth through warm_planes.h.
//
// A lane makes the operations of CarriedPlane::parts in another order, so its proof is that one's.
// No shape is read.
// Cost:    27 products a pair, nine of integers, and the loads of two poses and of 40 bytes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"

namespace touchstone {

// The memories of pairs: that of pair i is at memory + memory_bytes * memory_of[i], and begins with
// a CarriedPlane. They are aligned for it.
struct PlaneTable {
  static constexpr std::size_t memory_bytes = 64;

  BodyPairs pairs;
  const std::byte* memory;
  std::span<const std::uint32_t> memory_of;
  double margin = 0;  // metres; planes must part the bodies by more than this
};

// The pairs that planes do not part.
struct PlaneRest {
  std::uint32_t* left;  // their places in order, with room for all
  // Unless null, with room for all pairs: where to look for a plane between pair i of them, which is
  // the carried normal from a to b in the world, of length 1/2 to 3, or zero if there is none, and
  // maybe if it is not to be believed. The fourth number is zero.
  std::array<float, 4>* directions;
};

// Writes that the pairs whose planes part them are separated: answer, status and counts. Returns the
// number of the others.
std::size_t part_by_planes(const PlaneTable& table, Outcome* outcomes, const PlaneRest& rest);

}  // namespace touchstone
