// Tests of one box against many, in vectors, at each level of vector instructions. Used by the
// loops of boxes, bvh and several broad phases, which are compiled once for each level by
// foreach_target.inl with TOUCHSTONE_TARGET_NAMESPACE set to aabb_simd.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "algorithms/core/aabb.h"
#include "algorithms/kernels/boxes/aabb_soa.h"
#include "algorithms/kernels/boxes/aabb_stack.h"
#include "algorithms/kernels/boxes/pair_writer.h"

namespace touchstone::aabb_simd {

// The addresses of the arrays, passed by value so that loops keep them in registers across writes.
struct Columns {
  const float* min[3];
  const float* max[3];
  const std::uint32_t* ids;
};

// The columns of an AabbSoA or an AabbStack.
template <class Boxes>
Columns columns_of(const Boxes& boxes) {
  return {{boxes.min(0), boxes.min(1), boxes.min(2)},
          {boxes.max(0), boxes.max(1), boxes.max(2)},
          boxes.ids()};
}

struct MutableColumns {
  float* min[3];
  float* max[3];
  std::uint32_t* ids;
};

// The columns of an AabbSoA or an AabbStack.
template <class Boxes>
MutableColumns mutable_columns_of(Boxes& boxes) {
  return {{boxes.min(0), boxes.min(1), boxes.min(2)},
          {boxes.max(0), boxes.max(1), boxes.max(2)},
          boxes.ids()};
}

// The bits of the first `count` of 16 boxes; all bits if there are more.
inline unsigned first_lanes(std::size_t count) { return count < 16 ? (1u << count) - 1 : 0xffffu; }

#define TOUCHSTONE_TARGET_NAMESPACE pair_writer
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/boxes/aabb_simd.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace touchstone::aabb_simd
