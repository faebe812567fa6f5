// Closed forms: pairs of simple shapes that need no iteration, or a few rounds.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, sections 5.1.3 (point and box), 5.1.9
//          (segments), 5.2.3 (half-space); Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996
//          (boxes).
// Steps:   1. Solve batches in vector lanes, one pair per lane: boxes (kernels/batch/box_pair_lanes), spheres
//             and capsules with each other, spheres with a box, cylinder or cone (round_pair_lanes).
//          2. Solve the pairs that the lanes leave open, and all other batches, one by one.
//          3. Half-space: one support point of the other body (kernels/minkowski/halfspace).
//          4. Box and box: the greatest gap along 15 axes (kernels/sat/box_box). Boxes that rest touch
//             at a face: its plane and two points bound the signed distance
//             (kernels/batch/box_pair_rest.inl). The distance starts at the features that face each
//             other along the axis with the greatest gap, and is minimised along the edges of one box
//             (kernels/batch/box_pair_distance.inl); GJK finds it where these leave it open.
//          5. Sphere or capsule: reduce it to a point or segment with a radius, and find the
//             closest points of the two segments, or of the point and the box; a point inside a box
//             leaves through the nearest face.
//          6. Sphere and cylinder or cone: the nearest place on the outline of the half plane through the
//             point and the axis, a rectangle or a triangle. Within rounding of contact, and for a matrix that
//             is no rotation, GJK and EPA.
//          7. Subtract the radii from the signed gap of the cores, and compare it with its rounding
//             error.
//          8. Capsule and box: the zero of the slope of the distance along the segment, which is
//             linear between eight places; where the segment meets the box, the least depth along
//             six axes (closed_form/plain_capsule_box). What that leaves open goes to GJK and EPA
//             (kernels/gjk/gjk_query).
//          A pair that is asked for alone skips the lanes, in double whatever the scalar. Round bodies, and
//          spheres with a box, cylinder or cone, take the nearest points of their cores and a plane between
//          them (closed_form/plain_pair). The verdict of boxes takes the fifteen axes in one vector each
//          (closed_form/plain_boxes), and their depth the same axes (closed_form/plain_box_depth). Boxes that
//          rest take the face that they touch (closed_form/plain_box_rest). What these leave open goes to
//          step 1 or 2.
// Departs: if two cores meet, or nearly so, the normal is made orthogonal to the segments in whose
//          interior they meet, so that the depth stays exact. A box keeps its matrix as given: the
//          inverse takes a point into its frame.
// Answers: sphere, capsule or box with one of these, sphere with cylinder or cone, any bounded shape with a
//          half-space: all tasks.
//          Alone, a pair beyond the margin is answered before a root is taken. Within rounding of
//          contact the answer is `touching` with bounds on the signed distance, at most 2.9e-14
//          (double) or 1.6e-5 (float) of the pair's unit apart (kernels/minkowski/resolution).
// Fails:   reports not_converged if the rounding error is greater than that, and degenerate for a
//          sphere near a box that its matrix skews, if its two bounds do not decide or differ by
//          more than 1e-10 of the size. Pairs that go to GJK fail as there: a sphere and a cylinder or
//          cone within rounding of contact may be not_converged.
// Cost:    O(1), at most eight rounds for boxes that rest or are apart; GJK's where that leaves a pair open,
//          and EPA's for a capsule, cylinder or cone; one support call for a hull over a half-space.
#include <algorithm>
#include <limits>

#include "algorithms/kernels/batch/box_pair_lanes.h"
#include "algorithms/kernels/gjk/gjk_query.h"
#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/minkowski/resolution.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/sat/box_box.h"
#include "algorithms/kernels/sat/separating_axis.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/closed_form/core_gap.h"
#include "algorithms/narrow_phase/closed_form/plain_box_depth.h"
#include "algorithms/narrow_phase/closed_form/plain_box_rest.h"
#include "algorithms/narrow_phase/closed_form/plain_boxes.h"
#include "algorithms/narrow_phase/closed_form/plain_capsule_box.h"
#include "algorithms/narrow_phase/closed_form/plain_pair.h"
#include "algorithms/narrow_phase/closed_form/round_pair_lanes.h"
#include "algorithms/signed_by_two.h"

namespace touchstone {
namespace {

template <class Scalar>
class ClosedForm final : public NarrowPhase {
 public:
  explicit ClosedForm(const NarrowPhaseSettings& settings)
      : margin_(settings.margin.value_or(std::numeric_limits<double>::infinity())),
        gjk_(GjkQuerySettings{.margin = margin_}) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = shapes;
    polytopes_.clear();
    for (const Shape& shape : shapes) {
      const bool box = shape.kind == ShapeKind::box;
      polytopes_.push_back(box ? make_polytope<Scalar>(shape) : Polytope<Scalar>{});
    }
    support_shapes_ = make_support_shapes<Scalar>(shapes);
    box_lanes_.bind(shapes);
    round_lanes_.bind(shapes);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    const bool boxes = batch.kind_a == ShapeKind::box && batch.kind_b == ShapeKind::box;
    if (boxes && task == Task::signed_distance) return signed_.solve(*this, batch, outcomes);
    if (batch.kind_b == ShapeKind::halfspace) {
      return solve_halfspace_batch<Scalar>(support_shapes_, pairs, task, outcomes);
    }
    const bool round = RoundPairLanes<Scalar>::takes(batch.kind_a, batch.kind_b);
    if (!boxes && !round) {
      for (std::size_t i = 0; i < batch.size(); ++i) solve_one(task, batch, i, outcomes[i]);
      return;
    }
    left_.resize(batch.size());
    const std::size_t left =
        boxes ? box_lanes_.solve(pairs, task, outcomes, left_.data())
              : round_lanes_.solve(batch.kind_a, batch.kind_b, pairs, task, outcomes, left_.data());
    for (std::size_t k = 0; k < left; ++k) solve_one(task, batch, left_[k], outcomes[left_[k]]);
  }

  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
    const Shape& a = shapes_[batch.pairs.shape_of[first]];
    const Shape& b = shapes_[batch.pairs.shape_of[second]];
    const Pose &pose_a = batch.pairs.poses[first], &pose_b = batch.pairs.poses[second];
    if (batch.kind_a == ShapeKind::box && batch.kind_b == ShapeKind::box) {
      Answer answer = plain_boxes_.in_float(a, pose_a, b, pose_b);
      if (answer == Answer::unknown) {
        if (solve_plain_box_rest(task, a, pose_a, b, pose_b, outcome)) return;
        answer = plain_boxes_.in_double(a, pose_a, b, pose_b);
      }
      if (answer != Answer::unknown && !asks_for_number(task, answer)) {
        outcome.answer = answer;
        outcome.status = Status::ok;
        outcome.iterations = 0;
        outcome.support_calls = -1;
        return;
      }
      if (asks_depth(task) && answer != Answer::separated &&
          solve_plain_box_depth(a, pose_a, b, pose_b, outcome)) {
        return;
      }
      NarrowPhase::solve_alone(task, batch, i, outcome);
      return;
    }
    if (solve_plain_pair(task, a, pose_a, b, pose_b, outcome, margin_)) return;
    if (is_revolved(batch.kind_b)) return NarrowPhase::solve_alone(task, batch, i, outcome);
    solve_one(task, batch, i, outcome);
  }

 private:
  void solve_one(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) {
    const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
    const std::uint32_t a = batch.pairs.shape_of[first], b = batch.pairs.shape_of[second];
    const Pose &pose_a = batch.pairs.poses[first], &pose_b = batch.pairs.poses[second];
    if (batch.kind_b == ShapeKind::halfspace) {
      solve_halfspace(support_shapes_[a], pose_a, support_shapes_[b], pose_b, task, outcome);
    } else if (batch.kind_a == ShapeKind::box && asks_distance(task)) {
      gjk_.solve(support_shapes_[a], pose_a, support_shapes_[b], pose_b, task, nullptr, outcome);
    } else if (batch.kind_a == ShapeKind::box) {
      solve_boxes({polytopes_[a], pose_a, polytopes_[b], pose_b}, task, outcome);
    } else if (is_revolved(batch.kind_b) || is_capsule_box(batch)) {
      if (is_capsule_box(batch) &&
          plain_capsule_box_(task, shapes_[a], pose_a, shapes_[b], pose_b, outcome, margin_)) {
        return;
      }
      gjk_.solve(support_shapes_[a], pose_a, support_shapes_[b], pose_b, task, nullptr, outcome);
    } else {
      solve_round(shapes_[a], pose_a, shapes_[b], pose_b, task, outcome);
    }
  }

  static bool is_capsule_box(const PairBatch& batch) {
    return batch.kind_a == ShapeKind::capsule && batch.kind_b == ShapeKind::box;
  }
  static bool is_revolved(ShapeKind kind) {
    return kind == ShapeKind::cylinder || kind == ShapeKind::cone;
  }

  static void solve_boxes(const PolytopePair<Scalar>& pair, Task task, Outcome& outcome) {
    int tested = 0;
    const Axis<Scalar> best = pair.far_apart() ? Axis<Scalar>{} : box_axis(pair, tested);
    pair.report(best, task, true, outcome);
    outcome.iterations = 0;
    outcome.support_calls = -1;
  }

  // The greatest dimension of the shape in the world, metres.
  static double size(const Shape& shape, const Pose& pose) {
    const Mat3d& matrix = pose.rotation;
    switch (shape.kind) {
      case ShapeKind::box: return (matrix.cwiseAbs() * shape.half_extents).maxCoeff();
      case ShapeKind::capsule:
        return std::max(shape.radius, shape.half_length * matrix.col(2).cwiseAbs().maxCoeff());
      default: return shape.radius;
    }
  }

  // Body a is a sphere or capsule; body b is one of these or a box.
  static void solve_round(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                          Task task, Outcome& outcome) {
    const Vec3d offset = pose_b.translation - pose_a.translation;
    const double unit = power_of_two_above(
        std::max({offset.cwiseAbs().maxCoeff(), size(a, pose_a), size(b, pose_b)}));
    const auto scaled = [&](double length) { return static_cast<Scalar>(length / unit); };
    const Vec3<Scalar> centre_b = (offset / unit).template cast<Scalar>();
    const auto core = [&](const Shape& shape, const Pose& pose, const Vec3<Scalar>& centre) {
      const double length = shape.kind == ShapeKind::sphere ? 0 : shape.half_length / unit;
      const Vec3<Scalar> half = (length * pose.rotation.col(2)).template cast<Scalar>();
      return Segment<Scalar>{centre - half, 2 * half};
    };
    const bool box = b.kind == ShapeKind::box;
    const CoreGap<Scalar> cores =
        box ? point_box_gap<Scalar>(centre_b, pose_b.rotation.template cast<Scalar>(),
                                    (b.half_extents / unit).template cast<Scalar>())
            : segment_gap<Scalar>(core(a, pose_a, Vec3<Scalar>::Zero()), core(b, pose_b, centre_b));
    const Scalar radius_a = scaled(a.radius), radius_b = box ? Scalar{0} : scaled(b.radius);
    const Scalar gap = cores.gap - radius_a - radius_b;

    const Scalar lower = cores.lower - radius_a - radius_b;
    const Scalar upper = cores.upper - radius_a - radius_b;
    // If the bounds are far apart, only the answer is reported.
    const bool skewed = upper - lower > std::max(rounding<Scalar>, Scalar(1e-10));
    const bool apart = lower > rounding<Scalar>, common = upper < -rounding<Scalar>;
    outcome.answer = apart ? Answer::separated : common ? Answer::overlapping : Answer::unknown;
    outcome.status = apart || common ? Status::ok
                     : skewed        ? Status::degenerate
                                     : Status::not_converged;
    if (!apart && !common) {
      write_if_touching(unit * static_cast<double>(lower - rounding<Scalar>),
                        unit * static_cast<double>(upper + rounding<Scalar>),
                        unit * resolution<Scalar>, outcome);
    }
    outcome.iterations = 0;
    outcome.support_calls = -1;
    if (outcome.answer == Answer::unknown) clear_numbers(outcome);
    if (!asks_for_number(task, outcome.answer)) return;
    if (skewed) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::degenerate;
      clear_numbers(outcome);
      return;
    }
    const auto world = [&](const Vec3<Scalar>& point) {
      return Vec3d(pose_a.translation + unit * point.template cast<double>());
    };
    outcome.distance = unit * static_cast<double>(gap);
    outcome.lower = unit * static_cast<double>(lower - rounding<Scalar>);
    outcome.upper = unit * static_cast<double>(upper + rounding<Scalar>);
    outcome.normal = cores.normal.template cast<double>().normalized();
    outcome.witness_a = world(cores.on_a + radius_a * cores.normal);
    outcome.witness_b = world(cores.on_b - radius_b * cores.normal);
  }

  double margin_;  // metres
  std::span<const Shape> shapes_;
  std::vector<Polytope<Scalar>> polytopes_;
  std::vector<SupportShape<Scalar>> support_shapes_;
  BoxPairLanes<Scalar> box_lanes_;
  RoundPairLanes<Scalar> round_lanes_;
  PlainBoxes plain_boxes_ = plain_boxes();
  PlainCapsuleBox plain_capsule_box_ = plain_capsule_box();
  GjkQuery<Scalar> gjk_;
  SignedByTwo signed_;
  std::vector<std::uint32_t> left_;  // scratch: the pairs that the lanes leave open
};

bool takes(ShapeKind a, ShapeKind b, Task) {
  if (b == ShapeKind::halfspace) return a != ShapeKind::halfspace;
  return b <= (a == ShapeKind::sphere ? ShapeKind::cone : ShapeKind::box);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_closed_form() {
  return {{.info = {.name = "closed-form",
                    .citation = "Ericson, Real-Time Collision Detection, 2005; Gottschalk, Lin, "
                                "Manocha, OBBTree, SIGGRAPH 1996"},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float32, Precision::float64},
           .supports = takes,
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             if (settings.scalar == Precision::float32)
               return std::make_unique<ClosedForm<float>>(settings);
             return std::make_unique<ClosedForm<double>>(settings);
           }}};
}

}  // namespace touchstone::entries
