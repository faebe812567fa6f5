// Box pairs in lanes: binding the shapes, and the choice of the instruction level.
#include "algorithms/kernels/batch/box_pair_lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "algorithms/kernels/batch/pair_lanes.h"

namespace touchstone {
namespace {

using simd::Quad;

// Forward bounds on the error that rounding causes in a gap along an axis, as parts of the size of
// the pair: the sum of the half extents and of the offset's coordinates. u is half an epsilon. A
// matrix counts as orthonormal if its columns' products are off by no more than greatest_skew; a
// product is off by 3 u more, the matrix in float by another u. So the normals of the faces, which
// are the columns of the inverse, are off from the columns by no more than
//     n = sqrt(3) (greatest_skew + 3 u) + 3 u, 19 u in float and 36 u in double,
// a product of one matrix with the other, or with the offset, by n + 4 u, and along the product of
// two edges, which is two such products of the offset and four of half extents, the gap is off by
// no more than 2.4 (n + 4 u) + 6 u times the size: this is `coarse`. It holds along the axis
// itself, whatever its length, so a gap above it proves that the bodies are separated, and gaps
// below its negative along all axes prove that they overlap.
//
// If edges are almost parallel, their product is almost zero, and so is the gap along it. Such a
// pair is replaced by one whose first box has the identity for its pose and whose second has the
// rounded products for its matrix: its bodies are off by n + 4 u, its matrix's columns as normals
// by sqrt(3) (4 greatest_skew + 20 u), and each product of edges is exact to its last digit but
// one. `fine` is the sum of all these, for a gap as a part of the axis' length. Edges whose axis
// has a square below `parallel` count as parallel: they add no facet that is wide enough to matter.
//
// RestError has those of boxes that rest. A distance is off by no more than `distance`, since a root and a division
// follow. An edge's square across what it is near to is above `parallel_edge`, or it is parallel to it.
template <class Scalar>
struct GapError : RestError<Scalar> {
  using RestError<Scalar>::is_float;
  using RestError<Scalar>::u;
  static constexpr Scalar coarse = (is_float ? 64 : 128) * u;
  static constexpr Scalar fine = (is_float ? 160 : 320) * u;
  static constexpr Scalar parallel = 16 * u * u;
  static constexpr Scalar distance = (is_float ? 20 : 16) * u;
  static constexpr Scalar parallel_edge = 512 * u * (512 * u);
};

#define TOUCHSTONE_TARGET_INCLUDE "algorithms/kernels/batch/box_pair_lanes.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

}  // namespace

template <class Scalar>
void BoxPairLanes<Scalar>::bind(std::span<const Shape> shapes) {
  halves_.assign(4 * shapes.size(), 0);
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].kind != ShapeKind::box) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      halves_[4 * i + k] = static_cast<Scalar>(shapes[i].half_extents[static_cast<int>(k)]);
    }
  }
}

template <class Scalar>
std::size_t BoxPairLanes<Scalar>::solve(const BodyPairs& pairs, Task task,
                                        std::span<Outcome> outcomes, std::uint32_t* left) const {
  const PairTable<Scalar> table{pairs, halves_.data(), outcomes.data(), left};
  switch (isa()) {
    case Isa::avx512: return avx512::solve_boxes(table, task);
    case Isa::avx2: return avx2::solve_boxes(table, task);
    case Isa::baseline: break;
  }
  return baseline::solve_boxes(table, task);
}

template class BoxPairLanes<float>;
template class BoxPairLanes<double>;

}  // namespace touchstone
