// Ellipsoids by their smooth support functions, with Newton's method on the sphere of normals.
// Paper:   Perram, Wertheim, J. Computational Physics 58, 1985 (intersect); Lin, Han, "On the
//          distance between two ellipsoids", SIAM J. Optimization 13(1), 2002 (the problem); Absil,
//          Mahony, Sepulchre, "Optimization Algorithms on Matrix Manifolds", 2008, ch. 6 (Newton).
// Steps:   1. Pairs whose bounding balls are apart are separated (not for distance).
//          2. Write each body as a matrix applied to the unit ball, in the pair's unit
//             (ellipsoid_pair).
//          3. intersect: search the weight of Perram and Wertheim's function until a plane
//             separates or a common point appears (ellipsoid_contact).
//          4. distance and depth: from the line of centres, ascend to the normal with the greatest
//             gap between the support planes, by damped Newton steps (newton_ascent).
//          5. distance: the gap and the support points there enclose it. If the ascent is
//             undecided, step 3 decides and the ascent starts again at its normal.
//          6. depth: test whether an ellipsoid inside the bodies' sum proves that overlap to be the
//             least (ellipsoid_depth).
//          7. If it does not, search all normals by branch and bound, with an ascent from each
//             better one.
//          A signed distance begins as in step 4, and goes on to step 6 where no plane separates.
//          8. Write the distance with both bounds, the normal and the witness points.
// Departs: the distance is searched among planes instead of points, so that it is exact to second
//          order and a bound at every step; the same ascent finds depths. The least depth is proven
//          by an inner ellipsoid or by branch and bound.
// Warm:    the plane that parted a pair at a verdict, or instead of a depth (warm_planes).
// Answers: sphere or ellipsoid with ellipsoid: all tasks.
// Fails:   never answers `touching`; unknown / not_converged within 4e-15 (double) or 2e-6 (float)
//          of touching, relative to the pair's size. Bodies without volume, or so thin that the
//          squares of their radii are lost in rounding, are not_converged if the nearest point is
//          on the flat side of one. A depth is not_converged with bounds if a distant second
//          minimum is as good to 1e-3 and poorly curved.
// Cost:    O(1); 4 to 6 Newton steps of two support calls, and a search of about 100 planes if a
//          depth is not proven at once. Caps: 64 steps, 2000 planes. Tolerance relative to the
//          size: 1e-12 (double) or 2e-6 (float).
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "algorithms/kernels/batch/warm_planes.h"
#include "algorithms/kernels/gjk/warm_start.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/narrow_phase.h"
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_contact.h"
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_depth.h"
#include "algorithms/narrow_phase/ellipsoid/ellipsoid_pair.h"

namespace touchstone {
namespace {

constexpr int default_step_cap = 64;
constexpr int default_plane_cap = 2000;

template <class Scalar>
class EllipsoidPlanes final : public NarrowPhase {
 public:
  explicit EllipsoidPlanes(const NarrowPhaseSettings& settings)
      : tolerance_(std::max(static_cast<Scalar>(settings.tolerance.value_or(1e-12) / 2), rounding)),
        has_margin_(settings.margin.has_value()),
        margin_(settings.margin.value_or(std::numeric_limits<double>::infinity())),
        step_cap_(std::max(1, settings.max_iterations.value_or(default_step_cap))),
        plane_cap_(std::max(1, settings.max_iterations.value_or(default_plane_cap))) {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = shapes;
    balls_ = make_support_shapes<Scalar>(shapes);
  }

  void solve(Task task, const PairBatch& batch, std::span<Outcome> outcomes) override {
    if (!WarmPlanes::may_answer(task, batch, margin_)) {
      for (std::size_t i = 0; i < batch.size(); ++i) solve_pair(task, batch, i, outcomes[i]);
      return;
    }
    for (const std::uint32_t i : planes_.answer(task, batch, false, outcomes, margin_)) {
      if (const auto plane = solve_pair(task, batch, i, outcomes[i])) keep(*plane, batch, i);
    }
  }

  void solve_alone(Task task, const PairBatch& batch, std::size_t i, Outcome& outcome) override {
    const bool warm = WarmPlanes::may_answer(task, batch, margin_);
    if (warm && WarmPlanes::answer_alone(task, batch, i, outcome, margin_)) return;
    const auto plane = solve_pair(task, batch, i, outcome);
    if (warm && plane) keep(*plane, batch, i);
  }

 private:
  static constexpr Scalar rounding = EllipsoidPair<Scalar>::rounding;

  // A plane that parts a pair: a normal of about unit length, and a lower bound on the gap along it
  // in metres.
  struct Parting {
    Vec3d normal;
    double gap;
  };

  void keep(const Parting& plane, const PairBatch& batch, std::size_t i) const {
    const std::uint32_t a = batch.pairs.first[i], b = batch.pairs.second[i];
    WarmPlanes::keep(
        CarriedPlane::make(plane.normal, plane.gap, radius_of(balls_[batch.pairs.shape_of[a]]),
                           batch.pairs.poses[a], radius_of(balls_[batch.pairs.shape_of[b]]),
                           batch.pairs.poses[b]),
        batch, i);
  }

  static std::optional<Parting> parting(const EllipsoidPair<Scalar>& pair,
                                        const EllipsoidPlane<Scalar>& plane) {
    // The normal's length is off by rounding as well as the bound.
    const Scalar gap = plane.gap - pair.radius - 2 * rounding;
    if (!(gap > 0)) return {};
    return Parting{plane.normal.template cast<double>(), pair.unit * static_cast<double>(gap)};
  }

  // Returns the plane that parts the bodies, if the verdict is made by one.
  std::optional<Parting> solve_pair(Task task, const PairBatch& batch, std::size_t i,
                                    Outcome& outcome) const {
    const std::uint32_t first = batch.pairs.first[i], second = batch.pairs.second[i];
    const std::uint32_t a = batch.pairs.shape_of[first], b = batch.pairs.shape_of[second];
    const Pose &pose_a = batch.pairs.poses[first], &pose_b = batch.pairs.poses[second];
    outcome.iterations = 0;
    outcome.support_calls = -1;
    if (!asks_distance(task) && balls_are_apart(balls_[a], pose_a, balls_[b], pose_b)) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      return {};
    }
    if (has_margin_ && asks_distance(task) &&
        balls_are_apart_by(margin_, balls_[a], pose_a, balls_[b], pose_b)) {
      write_beyond(margin_, outcome);
      return {};
    }
    const EllipsoidPair<Scalar> pair(shapes_[a], pose_a, shapes_[b], pose_b);
    switch (task) {
      case Task::intersect: {
        const Vec3<Scalar> normal = decide(pair, outcome);
        if (outcome.answer != Answer::separated || batch.memory.empty()) return {};
        return parting(pair, EllipsoidPlane<Scalar>(pair, normal));
      }
      case Task::distance: solve_distance(pair, pose_a.translation, outcome); break;
      case Task::penetration: return solve_depth(pair, pose_a.translation, outcome);
      case Task::signed_distance: solve_signed(pair, pose_a.translation, outcome); break;
    }
    return {};
  }

  // Decides whether the bodies share a point. Returns a normal, which separates them if they do
  // not.
  Vec3<Scalar> decide(const EllipsoidPair<Scalar>& pair, Outcome& outcome) const {
    const EllipsoidContact<Scalar> found = contact(pair, step_cap_);
    outcome.answer = found.answer;
    outcome.status = found.answer == Answer::unknown ? Status::not_converged : Status::ok;
    if (found.answer == Answer::unknown) clear_numbers(outcome);
    outcome.iterations += found.iterations;
    return found.normal;
  }

  static Vec3<Scalar> first_normal(const EllipsoidPair<Scalar>& pair) {
    const Scalar length = pair.centre.norm();
    return length > 0 ? Vec3<Scalar>(pair.centre / length) : Vec3<Scalar>::UnitX();
  }

  void solve_distance(const EllipsoidPair<Scalar>& pair, const Vec3d& origin,
                      Outcome& outcome) const {
    const ClimbGoal goal{
        .only_verdict = true, .most_iterations = step_cap_, .margin = margin_ / pair.unit};
    Climb<Scalar> found = climb(pair, first_normal(pair), goal, tolerance_);
    outcome.iterations += found.iterations;
    if (found.end == ClimbEnd::apart || found.end == ClimbEnd::inside) {
      const bool apart = found.end == ClimbEnd::apart;
      outcome.answer = apart ? Answer::separated : Answer::overlapping;
      outcome.status = Status::ok;
      if (apart) write_distance(pair, found.plane, origin, outcome);
      return;
    }
    const Vec3<Scalar> normal = decide(pair, outcome);
    if (outcome.answer == Answer::overlapping) return;
    if (outcome.answer == Answer::separated) {
      found = climb(pair, normal, goal, tolerance_);
      outcome.iterations += found.iterations;
      if (found.end != ClimbEnd::apart) outcome.status = Status::not_converged;
    }
    write_distance(pair, found.plane, origin, outcome);
  }

  std::optional<Parting> solve_depth(const EllipsoidPair<Scalar>& pair, const Vec3d& origin,
                                     Outcome& outcome) const {
    const Climb<Scalar> found = climb(pair, first_normal(pair), depth_goal(), tolerance_);
    outcome.iterations = found.iterations;
    if (found.end == ClimbEnd::apart) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      return parting(pair, found.plane);
    }
    solve_depth_from(pair, found, origin, outcome);
    return {};
  }

  void solve_signed(const EllipsoidPair<Scalar>& pair, const Vec3d& origin,
                    Outcome& outcome) const {
    const ClimbGoal goal{.most_iterations = step_cap_, .margin = margin_ / pair.unit};
    const Climb<Scalar> found = climb(pair, first_normal(pair), goal, tolerance_);
    outcome.iterations = found.iterations;
    if (found.end == ClimbEnd::apart) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      write_distance(pair, found.plane, origin, outcome);
      return;
    }
    if (!(found.plane.gap - pair.radius > rounding)) {
      solve_depth_from(pair, found, origin, outcome);
      if (outcome.answer != Answer::separated) return;
    }
    // They are apart, and the ascent did not reach the nearest points.
    solve_distance(pair, origin, outcome);
  }

  ClimbGoal depth_goal() const { return {.only_apart = true, .most_iterations = step_cap_}; }

  // `found` ends the ascent from the line of centres.
  void solve_depth_from(const EllipsoidPair<Scalar>& pair, const Climb<Scalar>& found,
                        const Vec3d& origin, Outcome& outcome) const {
    // A ball whose centre is outside the ellipsoid: the depth follows from the centre's distance.
    if (found.plane.gap > rounding) {
      const Scalar distance = found.plane.between.norm();
      const bool inside = distance - pair.radius < -rounding;
      outcome.answer = inside ? Answer::overlapping : Answer::unknown;
      outcome.status =
          inside && found.end == ClimbEnd::stationary ? Status::ok : Status::not_converged;
      write_distance(pair, found.plane, origin, outcome);
      return;
    }
    const EllipsoidDepth<Scalar> depth =
        ellipsoid_depth(pair, found.plane, tolerance_, depth_goal(), plane_cap_);
    outcome.iterations += depth.iterations;
    if (depth.plane.gap - pair.radius > rounding) {
      outcome.answer = Answer::separated;
      outcome.status = Status::ok;
      return;
    }
    if (depth.lower + pair.radius > rounding) {
      outcome.answer = Answer::overlapping;
    } else {
      decide(pair, outcome);
      if (outcome.answer == Answer::separated) return;
    }
    const bool closed = depth.lower >= -depth.plane.gap - 4 * tolerance_;
    const bool known = closed && outcome.answer == Answer::overlapping;
    outcome.status = known ? Status::ok : Status::not_converged;
    write(pair, depth.plane.normal, depth.plane, depth.plane.gap, depth.plane.gap, -depth.lower,
          origin, outcome);
  }

  // Writes the distance of cores that are apart, or nearly so: between the plane's gap and the
  // distance of its points.
  void write_distance(const EllipsoidPair<Scalar>& pair, const EllipsoidPlane<Scalar>& plane,
                      const Vec3d& origin, Outcome& outcome) const {
    const auto proven = pair.unit * static_cast<double>(plane.gap - pair.radius - rounding);
    if (outcome.answer == Answer::separated && proven > margin_) {
      write_beyond(proven, outcome);
      return;
    }
    const Scalar distance = plane.between.norm();
    // The direction between the points is used if they are far enough apart to define one.
    const bool far = distance > 1024 * rounding && plane.gap > distance / 2;
    const Vec3<Scalar> normal = far ? Vec3<Scalar>(plane.between / distance) : plane.normal;
    write(pair, normal, plane, far ? distance : plane.gap, plane.gap, distance, origin, outcome);
  }

  // Signed distances of the cores, in the pair's unit.
  static void write(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& normal,
                    const EllipsoidPlane<Scalar>& plane, Scalar distance, Scalar lower,
                    Scalar upper, const Vec3d& origin, Outcome& outcome) {
    const auto metres = [&](Scalar length) {
      return pair.unit * static_cast<double>(length - pair.radius);
    };
    const auto world = [&](const Vec3<Scalar>& point) {
      return Vec3d(origin + pair.unit * point.template cast<double>());
    };
    outcome.distance = metres(distance);
    outcome.lower = metres(lower - rounding);
    outcome.upper = metres(upper + rounding);
    outcome.normal = normal.template cast<double>();
    outcome.witness_a = world(plane.a + pair.radius * normal);
    outcome.witness_b = world(pair.centre + plane.b);
  }

  Scalar tolerance_;  // in the pair's unit, which is up to twice its size
  bool has_margin_;
  double margin_;  // metres
  int step_cap_, plane_cap_;
  std::span<const Shape> shapes_;
  std::vector<SupportShape<Scalar>> balls_;
  WarmPlanes planes_;
};

bool takes(ShapeKind a, ShapeKind b, Task) {
  return b == ShapeKind::ellipsoid && (a == ShapeKind::sphere || a == ShapeKind::ellipsoid);
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<NarrowPhaseEntry> narrow_phase_ellipsoid() {
  return {{.info = {.name = "ellipsoid",
                    .citation = "Perram, Wertheim, \"Statistical mechanics of hard ellipsoids. I. "
                                "Overlap algorithm and the contact function\", J. Computational "
                                "Physics 58, 1985; Lin, Han, \"On the distance between two "
                                "ellipsoids\", SIAM J. Optimization 13(1), 2002"},
           .tasks = {all_tasks.begin(), all_tasks.end()},
           .scalars = {Precision::float32, Precision::float64},
           .supports = takes,
           .traits = {.starts_warm = true},
           .tolerance = "the error of a distance, and half the gap between both bounds on a depth; "
                        "1e-12 (float 2e-6)",
           .make = [](const NarrowPhaseSettings& settings) -> std::unique_ptr<NarrowPhase> {
             if (settings.scalar == Precision::float32)
               return std::make_unique<EllipsoidPlanes<float>>(settings);
             return std::make_unique<EllipsoidPlanes<double>>(settings);
           }}};
}

}  // namespace touchstone::entries
