// GJK and EPA for many pairs at once: one pair per lane of vectors.
// Paper:   Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988; the nearest
//          feature of a simplex: Ericson, "Real-Time Collision Detection", 2005, section 9.5; van
//          den Bergen, GDC 2001, as in expanding_polytope.h.
// Steps:   1. Load one pair per lane and rotate its bodies into the lane's frame (lane_start).
//             Pairs whose bounding balls are apart are separated at once.
//          2. Find the support point of every lane (lane_support).
//          3. Add it to the lane's simplex and select the feature nearest to the origin, for
//             simplices of all sizes together (lane_step).
//          4. A lane ends at a support plane that separates, at a tetrahedron that surely contains
//             the origin, at a point nearer than the radii, or when its bounds meet (lane_gjk).
//          5. Write the answers of ended lanes (lane_answer) and give these lanes the next pairs of
//             the batch.
//          6. For depths, keep the tetrahedra of up to 128 pairs and grow their polytopes in lanes
//             (lane_depths, lane_expand, bitset_hull).
//          7. Solve the pairs that the lanes leave open one by one, as `gjk` does
//             (kernels/gjk/gjk_query).
// Departs: every lane takes each step, whatever the size of its simplex: all regions are computed
//          and one is selected. Hulls of at most 16 vertices are rotated when their pair enters a
//          lane; larger ones are scanned sixteen vertices at a time, one lane after the other. If
//          the origin is too close to a face of the tetrahedron, a point behind that face is tried.
//          In EPA nearest faces, visible faces and planes are computed for all lanes together,
//          horizons one by one.
//          In double, verdicts on cylinders, cones and ellipsoids are tried in lanes of floats
//          first, whose bounds prove them as well.
// Answers: bounded bodies. The lanes leave open hulls of more than 192 vertices or far from their
//          own origin, bodies whose matrix is not close to a rotation, and without AVX2 all pairs
//          in double (but for those verdicts), since two lanes per vector are slower than none.
//          Verdicts are as reliable as gjk's. Near contact they are gjk's own, with its resolution.
// Fails:   like gjk.
// Cost:    like gjk's iterations; all lanes take as long as the slowest. It pays from batches of
//          about four pairs. Depths take 0.4 to 0.7 of gjk's time in float and up to all of it in
//          double, less for hulls with fewer vertices. A pair whose polytope grows beyond 64
//          vertices is solved one by one from the start. A signed distance takes as long as all
//          distances, and the depths of the pairs that overlap. Caps and tolerance are gjk's.
#include <algorithm>
#include <type_traits>

#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/gjk_lanes/lane_gjk.h"
#include "algorithms/signed_by_two.h"

namespace touchstone {
namespace {

template <class Scalar>
class GjkInLanes final : public NarrowPhase {
 public:
  explicit GjkInLanes(const GjkQuerySettings& settings) : settings_(settings), query_(settings) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<Scalar>(shapes);
    lanes_.bind(shapes, shapes_);
    const auto is_curved = [](const Shape& shape) { return Lanes::is_curved(shape.kind); };
    if (std::is_same_v<Scalar, double> && std::ranges::any_of(shapes, is_curved)) {
      quick_shapes_ = make_support_shapes<float>(shapes);
      quick_.bind(shapes, quick_shapes_);
    }
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (task == Task::signed_distance) return signed_.solve(*this, batch, outcomes);
    left_.resize(std::max(left_.size(), batch.size()));
    const bool curved = Lanes::is_curved(batch.kind_a) || Lanes::is_curved(batch.kind_b);
    const typename Lanes::Goal goal{.task = task,
                                    .tolerance = query_.tolerance(!curved),
                                    .most_iterations = settings_.gjk_cap,
                                    .most_expansions = settings_.epa_cap};
    const std::size_t count =
        std::is_same_v<Scalar, double> && curved && task == Task::intersect
            ? decide_in_floats_first(batch, goal, outcomes)
            : lanes_.solve(batch.kind_a, batch.kind_b, batch.pairs, goal, outcomes, left_.data());
    for (std::size_t k = 0; k < count; ++k) {
      solve_serially(task, batch.pairs, left_[k], outcomes[left_[k]]);
    }
  }

  // One curved pair fills too little of the lanes.
  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    if (Lanes::is_curved(batch.kind_a) || Lanes::is_curved(batch.kind_b)) {
      solve_serially(task, batch.pairs, i, outcome);
    } else {
      NarrowPhase::solve_alone(task, batch, i, outcome);
    }
  }

 private:
  using Lanes = GjkLanes<Scalar>;

  // Verdicts of floats are proven for the same bodies, so doubles are for the pairs that floats leave
  // open. Returns the number of pairs in left_.
  std::size_t decide_in_floats_first(const PairBatch& batch, const typename Lanes::Goal& goal,
                                     std::span<Outcome> outcomes) {
    open_.resize(std::max(open_.size(), batch.size()));
    const std::size_t open =
        quick_.solve(batch.kind_a, batch.kind_b, batch.pairs,
                     {.task = Task::intersect,
                      .most_iterations = std::min(most_quick_iterations, settings_.gjk_cap)},
                     outcomes, open_.data());
    return lanes_.solve_some(batch.kind_a, batch.kind_b, batch.pairs, goal, {open_.data(), open},
                             outcomes, left_.data());
  }

  void solve_serially(Task task, const BodyPairs& pairs, std::size_t i, Outcome& outcome) {
    const std::uint32_t a = pairs.first[i], b = pairs.second[i];
    query_.solve(shapes_[pairs.shape_of[a]], pairs.poses[a], shapes_[pairs.shape_of[b]],
                 pairs.poses[b], task, nullptr, outcome);
  }

  // Floats that take longer mostly end in doubt.
  static constexpr int most_quick_iterations = 16;

  GjkQuerySettings settings_;
  GjkQuery<Scalar> query_;
  std::vector<SupportShape<Scalar>> shapes_;
  Lanes lanes_;
  SignedByTwo signed_;
  // For double: the same in floats.
  std::vector<SupportShape<float>> quick_shapes_;
  GjkLanes<float> quick_;
  // Scratch: the pairs that the lanes leave open, and those that the lanes of floats do.
  std::vector<std::uint32_t> left_, open_;
};

std::unique_ptr<NarrowPhase> make(const NarrowPhaseSettings& settings) {
  GjkQuerySettings own{.tolerance = settings.tolerance};
  own.gjk_cap = std::max(1, settings.max_iterations.value_or(own.gjk_cap));
  own.epa_cap = std::max(1, settings.max_iterations.value_or(own.epa_cap));
  if (settings.scalar == Precision::float32) return std::make_unique<GjkInLanes<float>>(own);
  return std::make_unique<GjkInLanes<double>>(own);
}

bool takes(ShapeKind a, ShapeKind b, Task) {
  return GjkLanes<double>::takes(a) && GjkLanes<double>::takes(b);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_gjk_lanes() {
  return {{.info = {.name = "gjk-lanes",
                    .citation = "Gilbert, Johnson, Keerthi, \"A fast procedure for computing the "
                                "distance between complex objects in three-dimensional space\", "
                                "IEEE J. Robotics and Automation 4(2), 1988; Ericson, Real-Time "
                                "Collision Detection, 2005"},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float32, Precision::float64},
           .supports = takes,
           .tolerance = "the gap between both bounds on a distance or depth; what rounding allows",
           .make = make}};
}

}  // namespace touchstone::entries
