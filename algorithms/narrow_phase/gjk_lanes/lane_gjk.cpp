// Part of gjk-lanes: prepares shapes and batches for the loops in lane_gjk.inl, and selects the
// instruction level.
#include "algorithms/narrow_phase/gjk_lanes/lane_gjk.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "algorithms/kernels/batch/pair_lanes.h"
#include "algorithms/kernels/batch/prefetch.h"
#include "algorithms/kernels/epa/origin_projection.h"
#include "algorithms/kernels/gjk/gjk_iteration.h"
#include "algorithms/kernels/minkowski/simplex.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/narrow_phase/gjk_lanes/bitset_hull.h"

namespace touchstone {
namespace {

using simd::Quad;

// The kinds of cores that are not polytopes.
enum class RoundCore : std::uint8_t { none, cylinder, cone, ellipsoid };

// Parameters that all lanes of a batch share.
template <class Scalar>
struct LaneGoal {
  const LaneShape<Scalar>* shapes;
  const hull_scan::VertexBlock<Scalar>* some_vertices;  // of some hull, if there is one
  // Half edges: 3 of a box, 1 of a segment; 3 half axes of a round core; else 0.
  int halves_a, halves_b;
  RoundCore round_a, round_b;
  // Rotated hulls: the greatest number of vertices, rounded up to fours; else 0.
  std::uint32_t vertices_a, vertices_b;
  bool scans_a, scans_b;  // hulls that are scanned instead of rotated
  bool round;             // a body has a radius
  bool centred;           // all centres are the origins of the bodies
  bool distances;
  const std::array<float, 4>* directions;  // as in GjkLanes::Goal
  DepthStarts<Scalar>* starts;             // if depths are requested
  std::vector<LanePlane>* planes;          // that part pairs; null if they are not wanted
  // Upper bound on the rounding error of a point of the difference, in the unit.
  Scalar corner_error;
  Scalar tolerance;
  Scalar most_iterations;
  std::int32_t most_expansions;  // including the iterations of GJK

  bool scans() const { return scans_a || scans_b; }
};

// The number of pairs whose depths are computed together.
constexpr std::size_t most_starts = 128;

// The square of the least length of a search direction; shorter ones have lost their digits, or
// nearly so.
template <class Scalar>
constexpr Scalar shortest_square = sizeof(Scalar) == 8 ? Scalar(1e-200) : Scalar(1e-24);

// The square of the least reach of a round core along a direction whose square has all its digits.
template <class Scalar>
constexpr Scalar shortest_reach_square =
    std::numeric_limits<Scalar>::min() / std::numeric_limits<Scalar>::epsilon();

// The rounding of SupportPair, since the lanes compute the same numbers.
template <class Scalar>
constexpr Scalar lane_rounding = SupportPair<Scalar>::rounding;

// Error bound of a point of the difference. The table in SupportPair gives 26 u per component for
// cores that are not curved, if the centres are the origins of the bodies and the three half edges
// of a box are added one by one, and 31 u more if the centres are not. A round core's point is off
// by 14 u per component more.
template <class Scalar>
struct CornerError {
  static constexpr Scalar curved = corner_rounding<Scalar>;
  static constexpr Scalar centred = 48 * unit_roundoff<Scalar>;
  static constexpr Scalar shifted = 104 * unit_roundoff<Scalar>;
};

#define TOUCHSTONE_TARGET_NAMESPACE hull_scan
#define TOUCHSTONE_TARGET_INCLUDE "algorithms/narrow_phase/gjk_lanes/lane_gjk.inl"
#include "algorithms/kernels/simd/foreach_target.inl"

// Runs the loops at the active level; for doubles there is none at the lowest level.
template <class Scalar>
std::size_t run_lanes_at_level(const PairTable<Scalar>& table, const LaneGoal<Scalar>& goal,
                               std::span<const std::uint32_t> queue, std::size_t left) {
  if (queue.empty()) return left;
  switch (isa()) {
    case Isa::avx512: return avx512::run_all_lanes(table, goal, queue, left);
    case Isa::avx2: return avx2::run_all_lanes(table, goal, queue, left);
    case Isa::baseline: break;
  }
  if constexpr (std::is_same_v<Scalar, float>) {
    return baseline::run_all_lanes(table, goal, queue, left);
  } else {
    return left;
  }
}

RoundCore round_core_of(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::cylinder: return RoundCore::cylinder;
    case ShapeKind::cone: return RoundCore::cone;
    case ShapeKind::ellipsoid: return RoundCore::ellipsoid;
    default: return RoundCore::none;
  }
}

int halves_of(ShapeKind kind) {
  if (round_core_of(kind) != RoundCore::none) return 3;
  return kind == ShapeKind::box ? 3 : kind == ShapeKind::capsule ? 1 : 0;
}

}  // namespace

template <class Scalar>
void GjkLanes<Scalar>::bind(std::span<const Shape> shapes,
                            std::span<const SupportShape<Scalar>> support_shapes) {
  centred_ = all_fit_ = true;
  some_scan_ = false;
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
      lane.block_count = static_cast<std::uint32_t>(shape.vertices.size());
      lane.rough = shape.scanned_hull().rough;
      // The centre of a hull far from its origin must be rotated with care. Cube maps are not used
      // in lanes.
      lane.fits = shape.is_near_origin && shape.cells.empty();
      lane.scans = lane.fits && shapes[i].hull->vertices.size() > most_turned_vertices;
    }
    all_fit_ = all_fit_ && lane.fits;
    if (!lane.fits) continue;
    centred_ = centred_ && shape.is_centred;
    some_scan_ = some_scan_ || lane.scans;
    if (lane.vertices == nullptr) continue;
    some_vertices_ = lane.vertices;
    if (lane.scans) continue;
    const std::size_t count = shapes[i].hull->vertices.size();
    most_vertices_ = std::max(most_vertices_, static_cast<std::uint32_t>(count));
  }
}

template <class Scalar>
std::size_t GjkLanes<Scalar>::solve(ShapeKind kind_a, ShapeKind kind_b, const BodyPairs& pairs,
                                    const Goal& asked, std::span<const std::uint32_t> places,
                                    std::span<Outcome> outcomes, std::uint32_t* left) {
  const bool hull_a = kind_a == ShapeKind::hull, hull_b = kind_b == ShapeKind::hull;
  // Vertices are rotated in fours. A block has copies of the first vertex behind the last.
  const std::uint32_t vertices = (most_vertices_ + 3) / 4 * 4;
  const LaneGoal<Scalar> turned{.shapes = shapes_.data(),
                                .some_vertices = some_vertices_,
                                .halves_a = halves_of(kind_a),
                                .halves_b = halves_of(kind_b),
                                .round_a = round_core_of(kind_a),
                                .round_b = round_core_of(kind_b),
                                .vertices_a = hull_a ? vertices : 0,
                                .vertices_b = hull_b ? vertices : 0,
                                .scans_a = false,
                                .scans_b = false,
                                .round = kind_a <= ShapeKind::capsule,
                                .centred = centred_,
                                .distances = asked.task == Task::distance,
                                .directions = asked.directions,
                                .starts = asked.task == Task::penetration ? &starts_ : nullptr,
                                .planes = asked.planes,
                                .corner_error = is_curved(kind_a) || is_curved(kind_b)
                                                    ? CornerError<Scalar>::curved
                                                : centred_ ? CornerError<Scalar>::centred
                                                           : CornerError<Scalar>::shifted,
                                .tolerance = asked.tolerance,
                                .most_iterations = static_cast<Scalar>(asked.most_iterations),
                                .most_expansions = asked.most_expansions};
  LaneGoal<Scalar> scanned = turned;
  scanned.vertices_a = scanned.vertices_b = 0;
  scanned.scans_a = hull_a;
  scanned.scans_b = hull_b;
  if (turned.starts != nullptr) starts_.all.resize(most_starts);
  // Lanes of doubles are slower than one pair at a time without wider vectors.
  constexpr bool wants_avx2 = std::is_same_v<Scalar, double>;
  if (wants_avx2 && isa() == Isa::baseline) {
    std::ranges::copy(places, left);
    return places.size();
  }
  const PairTable<Scalar> table{pairs, nullptr, outcomes.data(), left};
  if (all_fit_ && !some_scan_) return run_lanes_at_level(table, turned, places, 0);
  turned_.clear();
  scanned_.clear();
  std::size_t left_count = 0;
  for (const std::uint32_t i : places) {
    const LaneShape<Scalar>& a = shapes_[pairs.shape_of[pairs.first[i]]];
    const LaneShape<Scalar>& b = shapes_[pairs.shape_of[pairs.second[i]]];
    if (!a.fits || !b.fits) {
      left[left_count++] = i;
    } else {
      (a.scans || b.scans ? scanned_ : turned_).push_back(i);
    }
  }
  left_count = run_lanes_at_level<Scalar>(table, turned, turned_, left_count);
  return run_lanes_at_level<Scalar>(table, scanned, scanned_, left_count);
}

template class GjkLanes<float>;
template class GjkLanes<double>;

}  // namespace touchstone
