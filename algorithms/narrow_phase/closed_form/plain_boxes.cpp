// The fifteen axes of Gottschalk, Lin and Manocha (OBBTree, SIGGRAPH 1996), with what rounding may
// do to them. An axis on which the boxes are apart is proven by their extents along it, of which
// every term is calculated from the matrices as they are. That no axis parts them needs matrices
// that are rotations: then a term that is neglected is below `greatest_skew` of the pair's size.
#include "algorithms/narrow_phase/closed_form/plain_boxes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

#include "algorithms/kernels/simd/vector.h"

namespace touchstone {
namespace {

// All rounding errors of a gap along an axis, as a part of the sum of all lengths: fewer than 64
// operations, none with a result greater than that sum, of matrices and lengths that were rounded.
template <class Scalar>
constexpr Scalar gap_rounding = 64 * std::numeric_limits<Scalar>::epsilon() / 2;
// Sizes whose products neither underflow nor, inverted, overflow.
template <class Scalar>
constexpr Scalar least_size = sizeof(Scalar) == 8 ? Scalar(1e-140) : Scalar(1e-15f);
// Edges whose angle has a sine below this tell nothing that the faces do not, up to its part of the
// size: seen along the edges, the boxes are rectangles.
template <class Scalar>
constexpr Scalar parallel = sizeof(Scalar) == 8 ? Scalar(1e-6) : Scalar(2e-3f);

using simd::Quad;

double extent(const Shape& box, const Pose& pose, const Vec3d& along) {
  return (pose.rotation.transpose() * along).cwiseAbs().dot(box.half_extents);
}

// Returns `separated` if the product of the edges with the greatest gap parts the boxes.
template <class Gap>
Answer apart_along_edges(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                         const Gap& gap) {
  int first = 0, second = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      if (gap(i, j) > gap(first, second)) first = i, second = j;
    }
  }
  const Vec3d axis = pose_a.rotation.col(first).cross(pose_b.rotation.col(second));
  const Vec3d offset = pose_b.translation - pose_a.translation;
  const double size = offset.lpNorm<1>() + a.half_extents.sum() + b.half_extents.sum();
  const bool apart =
      std::abs(axis.dot(offset)) - extent(a, pose_a, axis) - extent(b, pose_b, axis) >
      4 * gap_rounding<double> * size;
  return apart ? Answer::separated : Answer::unknown;
}

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/narrow_phase/closed_form/plain_boxes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

PlainBoxes plain_boxes() {
  switch (isa()) {
    case Isa::avx512: return {avx512::meet_plain_boxes<float>, avx512::meet_plain_boxes<double>};
    case Isa::avx2: return {avx2::meet_plain_boxes<float>, avx2::meet_plain_boxes<double>};
    default: return {baseline::meet_plain_boxes<float>, baseline::meet_plain_boxes<double>};
  }
}

}  // namespace touchstone
