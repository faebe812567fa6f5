// Rigid advancement: steps as long as the plane of the closest points parts the turning bodies.
// Paper:   the step is ours; the loop is that of conservative advancement (Mirtich 1996), and the search
//          along a fixed direction is in the spirit of Catto, "Continuous collision", GDC 2013.
// Steps:   0. Begin where balls about the bodies' origins meet.
//          1. GJK finds the plane of the closest points, with normal n (kernels/gjk).
//          2. A point rho of a body moves in time h to rho + h w x rho + r, where |r| along n is at most
//             h^2 / 2 |n x w| |w| |rho|. So the body reaches no further along n than the support
//             value along n + h (n x w), plus that: the gap after h is at least
//               gap(h) = n . offset + h n . v - S_a(n + h n x w_a) - S_b(-n - h n x w_b) - k h^2 / 2.
//             Supports are convex functions, so gap is concave: what is proven at the end of a step holds
//             all along it.
//          3. Guess h by taking the support points as fixed, which is never too short. If the gap is
//             open there, go on there. Otherwise the chord from 0 gives an h at which it is open by
//             concavity; improve that by chords twice.
//          4. If balls about the bodies' origins stay apart along n for longer, take that time.
//          5. If the end is reached, it is a miss. Repeat until the distance is within the tolerance
//             (kernels/motion/advancement).
// Departs: the gap is taken less a bound on all rounding, so that no contact is missed.
// Fails:   unknown / not_converged at the cap of 2,000 steps. It is slow at many turns, where the
//          bound k belongs to the whole body.
// Cost:    a GJK distance and two to four support calls a step; steps converge like Newton's, unless the
//          bodies graze. Tolerance: 1e-9 of the larger body's size.
#include <algorithm>
#include <cmath>
#include <vector>

#include "algorithms/cast.h"
#include "algorithms/kernels/motion/advancement.h"
#include "algorithms/kernels/motion/halfspace_cast.h"

namespace touchstone {
namespace {

// A body's part of the gap along a direction n that points away from it.
class Reach {
 public:
  Reach(PosedShape<double>& shape, const Vec3d& centre, const Vec3d& rotation_vector, double unit,
        double greatest, const Vec3d& n)
      : shape_(shape),
        centre_(centre),
        n_(n),
        turn_(n.cross(rotation_vector)),
        unit_(unit),
        bend_(turn_.norm() * rotation_vector.norm() * greatest) {}

  // Adds the body's centre and core: value is an upper bound on how far they reach along n after h,
  // less the part that is linear in time and the same for all points.
  double value(double h) {
    const Vec3d m = n_ + h * turn_;
    support_ = shape_.support(m);
    return unit_ * m.dot(support_) + h * turn_.dot(centre_);
  }
  // The rate at which the support point of the last call moves along n.
  double speed() const { return turn_.dot(unit_ * support_ + centre_); }
  double bend() const { return bend_; }

 private:
  PosedShape<double>& shape_;
  Vec3d centre_;  // from the body's origin, at the time
  Vec3d n_, turn_, support_ = Vec3d::Zero();
  double unit_, bend_;
};

class RigidAdvancement final : public Cast {
 public:
  explicit RigidAdvancement(const CastSettings& settings)
      : goal_{settings.tolerance, std::max(1, settings.max_iterations.value_or(2000)), true} {}

  void bind(std::span<const Shape> shapes) override {
    shapes_ = make_support_shapes<double>(shapes);
    inner_radii_ = inner_radii(shapes, shapes_);
  }

  void solve(const CastBatch& batch, std::span<CastOutcome> outcomes) override {
    const BodyPairs& pairs = batch.pairs;
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const std::uint32_t a = pairs.first[i], b = pairs.second[i];
      const MovingBody body_a = moving(batch, a);
      const MovingBody body_b = moving(batch, b);
      outcomes[i] = {};
      if (batch.kind_b == ShapeKind::halfspace) {
        cast_halfspace(*body_a.shape, *body_a.pose, *body_a.motion, *body_b.shape, *body_b.pose,
                       *body_b.motion, {goal_.tolerance.value_or(0)}, outcomes[i]);
        continue;
      }
      const RelativeMotion motion(body_a, body_b);
      advance(
          motion, goal_,
          [&](SupportPair<double>& pair, const PartingPlane& plane) {
            return step(motion, pair, plane);
          },
          outcomes[i]);
    }
  }

 private:
  MovingBody moving(const CastBatch& batch, std::uint32_t k) const {
    const std::uint32_t shape = batch.pairs.shape_of[k];
    return {&shapes_[shape], &batch.pairs.poses[k], &batch.motions[k], inner_radii_[shape]};
  }
  static FreeUntil step(const RelativeMotion& motion, SupportPair<double>& pair,
                        const PartingPlane& plane);

  AdvancementGoal goal_;
  std::vector<SupportShape<double>> shapes_;
  std::vector<double> inner_radii_;  // metres, one for each shape
};

// How long balls about the bodies' origins stay apart along the plane; 0 if they are not.
double balls_apart(const RelativeMotion& motion, const PartingPlane& plane, double slack) {
  const auto radius = [](const MovingBody& body) { return body.shape->radius; };
  const double now = plane.normal.dot(motion.offset(plane.time)) - motion.reach_a() -
                     motion.reach_b() - radius(motion.a()) - radius(motion.b()) - slack;
  if (!(now > 0)) return 0;
  const double speed = plane.normal.dot(motion.displacement());
  return speed < 0 ? now / -speed : 2;
}

FreeUntil RigidAdvancement::step(const RelativeMotion& motion, SupportPair<double>& pair,
                                 const PartingPlane& plane) {
  const double unit = pair.unit();
  const Vec3d& n = plane.normal;
  const double left = 1 - plane.time;
  // A support direction is at most as long as 1 and the greatest turn, 1.5, so that rounding is at
  // most three times that of a unit direction.
  constexpr double greatest_turn = 1.5;
  const double slack = 3 * (RelativeMotion::pair_rounding * unit + motion.placement_rounding());
  const double balls = balls_apart(motion, plane, slack);
  if (balls > left) return {1, true};

  Reach of_a(pair.a(), motion.centre_a(plane.time), motion.a().motion->rotation_vector, unit,
             motion.reach_a(), n);
  Reach of_b(pair.b(), motion.centre_b(plane.time), motion.b().motion->rotation_vector, unit,
             motion.reach_b(), -n);
  const double closing = n.dot(motion.displacement());
  const double bend = of_a.bend() + of_b.bend();
  const double apart = unit * (n.dot(pair.centre_b()) - pair.radius()) - slack;
  const auto gap = [&](double h) {
    return apart + h * closing - of_a.value(h) - of_b.value(h) - 0.5 * h * h * bend;
  };
  const double now = gap(0);
  const double fastest = std::max(motion.a().motion->rotation_vector.norm(),
                                  motion.b().motion->rotation_vector.norm());
  double end = std::min(left, greatest_turn / std::max(fastest, 1e-300));
  // gap(h) is at most now + rate h - bend h^2 / 2, which is zero at the guess.
  const double rate = closing - of_a.speed() - of_b.speed();
  const double root = std::sqrt(rate * rate + 2 * bend * std::max(now, 0.0));
  const double guess =
      rate > 0 ? (bend > 0 ? (rate + root) / bend : end) : 2 * now / std::max(root - rate, 1e-300);
  end = std::min(end, guess * (1 + 1e-9));
  if (!(now > 0)) return {plane.time + balls, false};
  double at_end = gap(end);
  double free = 0;
  if (at_end > 0) {
    free = end;
  } else {
    // Where the chord from an open end is zero, the gap is open by concavity; a little less makes up
    // for the rounding of the chord.
    constexpr double inward = 1 - 1e-12;
    free = end * now / (now - at_end) * inward;
    double open = now, begin = 0;
    for (int k = 0; k < 2 && free > begin; ++k) {
      const double here = gap(free);
      if (!(here > 0.02 * open)) break;
      open = here;
      begin = free;
      free = begin + (end - begin) * open / (open - at_end) * inward;
    }
  }
  if (free >= left) return {1, true};
  return {plane.time + std::max(free, balls), false};
}

bool supports_rigid(ShapeKind, ShapeKind kind_b, bool turns) {
  return !turns || kind_b != ShapeKind::halfspace;
}

}  // namespace
}  // namespace touchstone

namespace touchstone::entries {

std::vector<CastEntry> cast_rigid_advancement() {
  return {
      {.info = {.name = "rigid-advancement",
                .citation = "Touchstone's: conservative advancement by the longest step in which "
                            "the plane of the closest points parts the turning bodies"},
       .scalars = {Precision::float64},
       .rotation = true,
       .supports = supports_rigid,
       .make = [](const CastSettings& settings) {
         return std::make_unique<RigidAdvancement>(settings);
       }}};
}

}  // namespace touchstone::entries
