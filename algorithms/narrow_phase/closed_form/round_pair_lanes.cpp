// Part of closed-form: error bounds, and the selection of the instruction level for
// round_pair_lanes.inl.
#include "algorithms/narrow_phase/closed_form/round_pair_lanes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>

#include "algorithms/kernels/batch/pair_lanes.h"

namespace touchstone {
namespace {

using simd::Quad;

// Forward bounds on the rounding error of a distance, relative to the size of the pair: the sum of
// the radii, of the coordinates of the half segments or half extents, and of the offset's
// coordinates. u is half an epsilon. Between cores that are segments no point is off by more than 8
// u of that, and neither is the component of their difference along a unit vector.
//
// A box is rotated by the transpose of its matrix if that is orthonormal. A coordinate is then off
// by less than 23 u in float and 40 u in double (see box_pair_lanes.cpp); lengths change by half of
// the spectral norm of the skew, 14 u and 29 u. Cylinders and cones are rotated likewise. With three such
// coordinates the point is off by 40 u and 70 u. Its distance from the outline is made of fewer than 20
// operations, and off by 16 u more.
template <class Scalar>
struct DistanceError {
  static constexpr Scalar cores = 32 * unit_roundoff<Scalar>;
  static constexpr Scalar box = (std::is_same_v<Scalar, float> ? 64 : 128) * unit_roundoff<Scalar>;
  static constexpr Scalar revolved =
      (std::is_same_v<Scalar, float> ? 80 : 128) * unit_roundoff<Scalar>;
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/narrow_phase/closed_form/round_pair_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
void RoundPairLanes<Scalar>::bind(std::span<const Shape> shapes) {
  sizes_.assign(4 * shapes.size(), 0);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Shape& shape = shapes[i];
    if (shape.kind > ShapeKind::cone) continue;
    std::array<double, 3> numbers = {shape.radius, shape.half_length, 0};
    if (shape.kind == ShapeKind::sphere) numbers[1] = 0;
    if (shape.kind == ShapeKind::box) Vec3d::Map(numbers.data()) = shape.half_extents;
    for (std::size_t k = 0; k < 3; ++k) sizes_[4 * i + k] = static_cast<Scalar>(numbers[k]);
  }
}

template <class Scalar>
std::size_t RoundPairLanes<Scalar>::solve(ShapeKind kind_a, ShapeKind kind_b,
                                          const BodyPairs& pairs, Task task,
                                          std::span<Outcome> outcomes, std::uint32_t* left) const {
  const PairTable<Scalar> table{pairs, sizes_.data(), outcomes.data(), left};
  switch (isa()) {
    case Isa::avx512: return avx512::solve_round(table, kind_a, kind_b, task);
    case Isa::avx2: return avx2::solve_round(table, kind_a, kind_b, task);
    case Isa::baseline: break;
  }
  return baseline::solve_round(table, kind_a, kind_b, task);
}

template class RoundPairLanes<float>;
template class RoundPairLanes<double>;

}  // namespace touchstone
