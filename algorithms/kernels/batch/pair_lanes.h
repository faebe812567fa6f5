// The input and output of loops over pairs of bodies, with one pair in each lane of simd/vector.h.
// Used by box_pair_lanes.h, closed-form and gjk-lanes.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>

#include "algorithms/core/body_pairs.h"
#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/kernels/simd/vector.h"

namespace touchstone {

// The numbers of a pose are loaded four at a time. Those of an outcome are written so; outcome.h
// states its layout.
static_assert(sizeof(Pose) == 12 * sizeof(double));

template <class Scalar>
struct PairTable {
  BodyPairs pairs;
  const Scalar* shapes;  // four numbers for each shape
  Outcome* outcomes;
  std::uint32_t* left;  // places of pairs without an answer
};

// Half of epsilon: the greatest relative error of a rounding.
template <class Scalar>
constexpr Scalar unit_roundoff = std::numeric_limits<Scalar>::epsilon() / 2;

// A matrix counts as orthonormal if the products of its columns are off by at most this.
template <class Scalar>
constexpr Scalar greatest_skew = (std::is_same_v<Scalar, float> ? 6 : 16) * unit_roundoff<Scalar>;

}  // namespace touchstone
