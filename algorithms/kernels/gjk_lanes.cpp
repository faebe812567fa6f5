#include "algorithms/kernels/gjk_lanes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "algorithms/kernels/pair_lanes.h"
#include "algorithms/kernels/support.h"

namespace touchstone {
namespace {

using real_lanes::Quad;

// What the lanes of a batch have in common.
template <class Scalar>
struct LaneGoal {
  const LaneShape<Scalar>* shapes;
  const hull_scan::VertexBlock<Scalar>* some_vertices;  // of a hull, where there is one
  int halves_a, halves_b;                               // of a box 3, of a segment 1, else none
  std::uint32_t vertices_a, vertices_b;  // the most of a hull, in fours; of others none
  bool round;                            // a body has a radius
  bool centred;                          // all centres are the origins of the bodies
  bool distances;
  bool answers_overlaps;
  Scalar corner_error;  // how far rounding moves a point of the difference, in the unit, at most
  Scalar tolerance;
  Scalar most_iterations;
};

// Shorter ways have lost their digits, or are about to. (Squares of lengths.)
template <class Scalar>
constexpr Scalar shortest_square = sizeof(Scalar) == 8 ? Scalar(1e-200) : Scalar(1e-24);

// As in SupportPair, of which the lanes compute what it computes.
template <class Scalar>
constexpr Scalar lane_rounding = SupportPair<Scalar>::rounding;

// How far a point of the difference is off at most: the table in SupportPair, for cores that are
// not curved, gives 26 u for each component where the centres are the origins of the bodies, with
// the three half edges of a box added one by one, and 31 u more where they are not.
template <class Scalar>
struct CornerError {
  static constexpr Scalar centred = 48 * unit_roundoff<Scalar>;
  static constexpr Scalar shifted = 104 * unit_roundoff<Scalar>;
};

#define TOUCHSTONE_LANES real_lanes
#define TOUCHSTONE_LOOPS "algorithms/kernels/gjk_lanes.inl"
#include "algorithms/kernels/every_level.inl"

int halves_of(ShapeKind kind) {
  return kind == ShapeKind::box ? 3 : kind == ShapeKind::capsule ? 1 : 0;
}

}  // namespace

template <class Scalar>
void GjkLanes<Scalar>::bind(std::span<const Shape> shapes,
                            std::span<const SupportShape<Scalar>> support_shapes) {
  centred_ = all_fit_ = true;
  most_vertices_ = 0;
  some_vertices_ = nullptr;
  shapes_.assign(shapes.size(), {});
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const SupportShape<Scalar>& shape = support_shapes[i];
    LaneShape<Scalar>& lane = shapes_[i];
    const double numbers[3] = {shape.unit, shape.radius, shape.size + shape.radius};
    std::ranges::copy(numbers, lane.numbers);
    for (int k = 0; k < 3; ++k) lane.extents[k] = shape.extents[k];
    for (int k = 0; k < 3; ++k) lane.centre[k] = shape.centre[k];
    lane.fits = takes(shapes[i].kind);
    if (shapes[i].kind == ShapeKind::hull) {
      lane.vertices = shape.vertices.data();
      const std::size_t count = shapes[i].hull->vertices.size();
      lane.vertex_count = static_cast<std::uint32_t>(count);
      // Far from its origin, its centre must be turned with care.
      lane.fits = count <= most_lane_vertices && shape.centre.cwiseAbs().maxCoeff() <= shape.size;
    }
    all_fit_ = all_fit_ && lane.fits;
    if (!lane.fits) continue;
    centred_ = centred_ && shape.centre.isZero(0);
    if (lane.vertices != nullptr) some_vertices_ = lane.vertices;
    most_vertices_ = std::max(most_vertices_, lane.vertex_count);
  }
}

template <class Scalar>
std::size_t GjkLanes<Scalar>::solve(ShapeKind kind_a, ShapeKind kind_b, const BodyPairs& pairs,
                                    const Goal& asked, std::span<Outcome> outcomes,
                                    std::uint32_t* left) {
  // In fours, as vertices are turned; a block has copies of the first behind the last.
  const std::uint32_t vertices = (most_vertices_ + 3) / 4 * 4;
  const LaneGoal<Scalar> goal{
      .shapes = shapes_.data(),
      .some_vertices = some_vertices_,
      .halves_a = halves_of(kind_a),
      .halves_b = halves_of(kind_b),
      .vertices_a = kind_a == ShapeKind::hull ? vertices : 0,
      .vertices_b = kind_b == ShapeKind::hull ? vertices : 0,
      .round = kind_a <= ShapeKind::capsule,
      .centred = centred_,
      .distances = asked.task == Task::distance,
      .answers_overlaps = asked.task != Task::penetration,
      .corner_error = centred_ ? CornerError<Scalar>::centred : CornerError<Scalar>::shifted,
      .tolerance = asked.tolerance,
      .most_iterations = static_cast<Scalar>(asked.most_iterations)};
  // Without wider vectors, lanes of doubles are slower than one pair at a time.
  constexpr bool wants_avx2 = std::is_same_v<Scalar, double>;
  const bool none = wants_avx2 && isa() == Isa::baseline;
  while (places_.size() < pairs.first.size()) {
    places_.push_back(static_cast<std::uint32_t>(places_.size()));
  }
  const std::span<const std::uint32_t> places(places_.data(), pairs.first.size());
  if (none) {
    std::ranges::copy(places, left);
    return places.size();
  }
  std::span<const std::uint32_t> queue = places;
  std::size_t left_count = 0;
  if (!all_fit_) {
    queue_.clear();
    for (const std::uint32_t i : places) {
      const bool fit = shapes_[pairs.shape_of[pairs.first[i]]].fits &&
                       shapes_[pairs.shape_of[pairs.second[i]]].fits;
      if (fit) {
        queue_.push_back(i);
      } else {
        left[left_count++] = i;
      }
    }
    queue = queue_;
  }
  const PairTable<Scalar> table{pairs, nullptr, outcomes.data(), left};
  switch (isa()) {
    case Isa::avx512: return avx512::walk_all(table, goal, queue, left_count);
    case Isa::avx2: return avx2::walk_all(table, goal, queue, left_count);
    case Isa::baseline: break;
  }
  if constexpr (wants_avx2) {
    return left_count;
  } else {
    return baseline::walk_all(table, goal, queue, left_count);
  }
}

template class GjkLanes<float>;
template class GjkLanes<double>;

}  // namespace touchstone
