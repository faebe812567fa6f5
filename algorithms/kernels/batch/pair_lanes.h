// What loops over pairs of bodies, one pair a lane of simd.h, are given and write.
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
  const Scalar* shapes;  // four numbers a shape
  Outcome* outcomes;
  std::uint32_t* left;  // places of pairs that are not answered
};

// Half an epsilon: the greatest error of a rounding.
template <class Scalar>
constexpr Scalar unit_roundoff = std::numeric_limits<Scalar>::epsilon() / 2;

// A matrix is taken for orthonormal where its columns' products are off by no more.
template <class Scalar>
constexpr Scalar greatest_skew = (std::is_same_v<Scalar, float> ? 6 : 16) * unit_roundoff<Scalar>;

}  // namespace touchstone
