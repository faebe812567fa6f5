// Closed forms: pairs of simple shapes that need no iteration.
// Paper:   Ericson, "Real-Time Collision Detection", 2005, sections 5.1.3 (point and box), 5.1.9
//          (segments), 5.2.3 (half-space); Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996
//          (boxes).
// Steps:   1. Solve batches of box pairs, and of spheres and capsules with each other or with a
//             box, in vector lanes, one pair per lane (kernels/batch/box_pair_lanes,
//             round_pair_lanes).
//          2. Solve the pairs that the lanes leave open, and all other batches, one by one.
//          3. Half-space: one support point of the other body (kernels/minkowski/halfspace).
//          4. Box and box: the greatest gap along 15 axes (kernels/sat/box_box).
//          5. Sphere or capsule: reduce it to a point or segment with a radius, and find the
//             closest points of the two segments, or of the point and the box; a point inside a box
//             leaves through the nearest face.
//          6. Subtract the radii from the signed gap of the cores, and compare it with its rounding
//             error.
// Departs: if two cores meet, or nearly so, the normal is made orthogonal to the segments in whose
//          interior they meet, so that the depth stays exact. A box keeps its matrix as given: the
//          inverse takes a point into its frame.
// Answers: sphere or capsule with sphere or capsule, sphere with box, any bounded shape with a
//          half-space: all tasks. Box with box: intersect and penetration, since 15 axes give no
//          distance. Within rounding of contact the answer is `touching` with bounds on the signed
//          distance, at most 2.9e-14 (double) or 1.6e-5 (float) of the pair's unit apart
//          (kernels/minkowski/resolution).
// Fails:   reports not_converged if the rounding error is greater than that, and degenerate for a
//          sphere near a box that its matrix skews, if its two bounds do not decide or differ by
//          more than 1e-10 of the size.
// Cost:    O(1); one support call for a hull over a half-space.
#include <algorithm>
#include <cmath>
#include <limits>

#include "algorithms/kernels/batch/box_pair_lanes.h"
#include "algorithms/kernels/minkowski/halfspace.h"
#include "algorithms/kernels/minkowski/resolution.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/sat/box_box.h"
#include "algorithms/kernels/sat/segment.h"
#include "algorithms/kernels/sat/separating_axis.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/closed_form/round_pair_lanes.h"

namespace touchstone {
namespace {

// The relation of two cores (the bodies without their radii), relative to the centre of body a in
// the pair's unit. The gap is signed; on_b - on_a is gap * normal. It lies between the bounds,
// which differ by more than rounding only if a box's matrix is not a rotation.
template <class Scalar>
struct CoreGap {
  Scalar gap, lower, upper;
  Vec3<Scalar> normal;  // unit vector from a to b
  Vec3<Scalar> on_a, on_b;
};

template <class Scalar>
constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

template <class Scalar>
Vec3<Scalar> part_across(const Vec3<Scalar>& v, const Vec3<Scalar>& along) {
  return v - v.dot(along) / along.squaredNorm() * along;
}

// Returns true if the directions of two segments differ by more than rounding.
template <class Scalar>
bool are_crossed(const Vec3<Scalar>& p, const Vec3<Scalar>& q) {
  return p.cross(q).norm() > rounding<Scalar> * p.norm() * q.norm();
}

// Returns a unit vector orthogonal to both segments, or to those that have a direction.
template <class Scalar>
Vec3<Scalar> across(const Vec3<Scalar>& p, const Vec3<Scalar>& q) {
  // The cross product of almost parallel vectors has an error along them.
  if (are_crossed(p, q)) return part_across<Scalar>(p.cross(q), p).normalized();
  const Vec3<Scalar>& longer = p.squaredNorm() < q.squaredNorm() ? q : p;
  return longer.squaredNorm() > 0 ? longer.unitOrthogonal() : Vec3<Scalar>::UnitX();
}

template <class Scalar>
CoreGap<Scalar> segment_gap(const Segment<Scalar>& a, const Segment<Scalar>& b) {
  const SegmentPoints<Scalar> closest = closest_points(a, b);
  const Vec3<Scalar> between = closest.second - closest.first;
  // The normal must be orthogonal to segments whose interior the points are in; rounding may tilt
  // it.
  const auto inside = [](Scalar s, const Segment<Scalar>& segment) {
    return s > 0 && s < 1 && segment.along.squaredNorm() > 0;
  };
  const bool inside_a = inside(closest.s, a), inside_b = inside(closest.t, b);
  Vec3<Scalar> normal = between;
  if (inside_a && inside_b && are_crossed(a.along, b.along)) {
    const Vec3<Scalar> direction = across(a.along, b.along);
    normal = between.dot(direction) * direction;
  } else if (inside_a) {
    normal = part_across(between, a.along);
  } else if (inside_b) {
    normal = part_across(between, b.along);
  }
  const Scalar length = normal.norm();
  normal = length > rounding<Scalar> ? Vec3<Scalar>(normal / length) : across(a.along, b.along);
  // If the points coincide, the direction's sign is arbitrary.
  if (normal.dot(between) < 0) normal = -normal;
  const Scalar gap = normal.dot(between);
  return {gap, gap, gap, normal, closest.first, closest.second};
}

// The gap between a point, body a's centre, and a box with these half extents around `centre`.
template <class Scalar>
CoreGap<Scalar> point_box_gap(const Vec3<Scalar>& centre, const Mat3<Scalar>& matrix,
                              const Vec3<Scalar>& half) {
  Mat3<Scalar> normals;  // cofactors: outward normals of the faces, up to their length
  for (int k = 0; k < 3; ++k) {
    normals.col(k) = matrix.col((k + 1) % 3).cross(matrix.col((k + 2) % 3));
  }
  const Scalar determinant = matrix.col(0).dot(normals.col(0));
  const Vec3<Scalar> point = -(normals.transpose() * centre) / determinant;
  const Vec3<Scalar> closest = point.cwiseMax(-half).cwiseMin(half);
  const Vec3<Scalar> outward = matrix * (point - closest);
  const Scalar distance = outward.norm();
  if (distance > 0) {
    const Vec3<Scalar> normal = -outward / distance;
    // If the matrix skews the box, `closest` is not the closest point, but it is in the box: its
    // distance bounds from above, the plane through it from below.
    const Scalar upper = std::max(distance, (centre + matrix * closest).norm());
    const Scalar lower = normal.dot(centre) - (matrix.transpose() * normal).cwiseAbs().dot(half);
    return {distance, std::min(distance, lower), upper,
            normal,   Vec3<Scalar>::Zero(),      distance * normal};
  }
  // The point is inside: the shortest way out is through the nearest face.
  constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  const Vec3<Scalar> none = Vec3<Scalar>::Zero();
  CoreGap<Scalar> best{-infinity, -infinity, -infinity, none, none, none};
  for (int k = 0; k < 3; ++k) {
    const Scalar length = normals.col(k).norm();
    const Scalar gap = (std::abs(point[k]) - half[k]) * std::abs(determinant) / length;
    if (!(gap > best.gap)) continue;
    const Scalar sign = (point[k] < 0) == (determinant < 0) ? Scalar{-1} : Scalar{1};
    best.gap = best.lower = best.upper = gap;
    best.normal = sign * normals.col(k) / length;
  }
  best.on_b = best.gap * best.normal;
  return best;
}

template <class Scalar>
class ClosedForm final : public NarrowPhase {
 public:
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

 private:
  void solve_one(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) const {
    const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
    const std::uint32_t a = batch.pairs.shape_of[first], b = batch.pairs.shape_of[second];
    const Pose &pose_a = batch.pairs.poses[first], &pose_b = batch.pairs.poses[second];
    if (batch.kind_b == ShapeKind::halfspace) {
      solve_halfspace(support_shapes_[a], pose_a, support_shapes_[b], pose_b, task, outcome);
    } else if (batch.kind_a == ShapeKind::box) {
      solve_boxes({polytopes_[a], pose_a, polytopes_[b], pose_b}, task, outcome);
    } else {
      solve_round(shapes_[a], pose_a, shapes_[b], pose_b, task, outcome);
    }
  }

  static void solve_boxes(const PolytopePair<Scalar>& pair, Task task, Outcome& outcome) {
    int tested = 0;
    const Axis<Scalar> best = pair.far_apart() ? Axis<Scalar>{} : box_axis(pair, tested);
    pair.report(best, task, true, outcome);
    outcome.iterations = 0;
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
    if (task == Task::intersect || (task == Task::distance && common) ||
        (task == Task::penetration && apart)) {
      return;
    }
    if (skewed) {
      outcome.answer = Answer::unknown;
      outcome.status = Status::degenerate;
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

  std::span<const Shape> shapes_;
  std::vector<Polytope<Scalar>> polytopes_;
  std::vector<SupportShape<Scalar>> support_shapes_;
  BoxPairLanes<Scalar> box_lanes_;
  RoundPairLanes<Scalar> round_lanes_;
  std::vector<std::uint32_t> left_;  // scratch: the pairs that the lanes leave open
};

bool takes(ShapeKind a, ShapeKind b, Task task) {
  if (b == ShapeKind::halfspace) return a != ShapeKind::halfspace;
  if (a == ShapeKind::box && b == ShapeKind::box) return task != Task::distance;
  if (a == ShapeKind::sphere && b == ShapeKind::box) return true;
  return a <= ShapeKind::capsule && b <= ShapeKind::capsule;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_closed_form() {
  return {{.info = {.name = "closed-form",
                    .citation = "Ericson, Real-Time Collision Detection, 2005; Gottschalk, Lin, "
                                "Manocha, OBBTree, SIGGRAPH 1996"},
           .tasks = {Task::intersect, Task::distance, Task::penetration},
           .scalars = {Precision::float32, Precision::float64},
           .supports = takes,
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             if (settings.scalar == Precision::float32)
               return std::make_unique<ClosedForm<float>>();
             return std::make_unique<ClosedForm<double>>();
           }}};
}

}  // namespace touchstone::entries
