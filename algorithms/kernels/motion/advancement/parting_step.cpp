// The longest step in which a plane parts turning bodies.
#include "algorithms/kernels/motion/advancement/parting_step.h"

#include <algorithm>
#include <cmath>

namespace touchstone {
namespace {

// A body's part of the gap along a direction n that points away from it, seen from what turns with n.
class Reach {
 public:
  // `turn` is the body's angular velocity, of length `angle`, and `turning` that of n.
  Reach(PosedShape<double>& shape, const Vec3d& centre, const Vec3d& turn, double angle,
        const Vec3d& turning, double unit, double greatest, const Vec3d& n)
      : shape_(shape), centre_(centre), n_(n), turn_(n.cross(turn - turning)), unit_(unit) {
    if (turning.isZero(0)) {
      fastest_ = angle;
      bend_ = turn_.norm() * angle * greatest;
    } else {
      const double square = (turn - turning).squaredNorm();
      fastest_ = std::sqrt(square);
      bend_ = (square + turning.cross(turn).norm()) * greatest;
    }
  }

  // Adds the body's centre and core: value is an upper bound on how far they reach along n after h,
  // less the part that is linear in time and the same for all points.
  double value(double h) {
    return unit_ * shape_.support_value(n_ + h * turn_) + h * turn_.dot(centre_);
  }
  // The same for h = 0. Sets the rate at which the support point moves along n.
  double value_now(double& rate) {
    const Vec3d support = unit_ * shape_.support(n_);
    rate = turn_.dot(support + centre_);
    return n_.dot(support);
  }
  double bend() const { return bend_; }
  // The angular velocity relative to n's.
  double fastest() const { return fastest_; }

 private:
  PosedShape<double>& shape_;
  Vec3d centre_;  // from the body's origin, at the time
  Vec3d n_, turn_;
  double unit_, bend_, fastest_;
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

}  // namespace

FreeUntil longest_step(const RelativeMotion& motion, SupportPair<double>& pair,
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

  const Vec3d& turning = plane.turning;
  Reach of_a(pair.a(), motion.centre_a(plane.time), motion.a().motion->rotation_vector,
             motion.angle_a(), turning, unit, motion.reach_a(), n);
  Reach of_b(pair.b(), motion.centre_b(plane.time), motion.b().motion->rotation_vector,
             motion.angle_b(), turning, unit, motion.reach_b(), -n);
  double closing = n.dot(motion.displacement());
  double bend = of_a.bend() + of_b.bend();
  double fastest = std::max(of_a.fastest(), of_b.fastest());
  if (!turning.isZero(0)) {
    const Vec3d away = motion.offset(plane.time);
    const double furthest = std::sqrt(std::max(away.squaredNorm(), motion.offset(1).squaredNorm()));
    const double turn = turning.norm();
    closing -= n.dot(turning.cross(away));
    bend += turning.cross(n).norm() * (turn * furthest + 2 * motion.speed());
    fastest = std::max(fastest, turn);
  }
  const double apart = unit * (n.dot(pair.centre_b()) - pair.radius()) - slack;
  const auto gap = [&](double h) {
    return apart + h * closing - of_a.value(h) - of_b.value(h) - 0.5 * h * h * bend;
  };
  double speed_a = 0, speed_b = 0;
  const double now = apart - of_a.value_now(speed_a) - of_b.value_now(speed_b);
  double end = std::min(left, greatest_turn / std::max(fastest, 1e-300));
  // gap(h) is at most now + rate h - bend h^2 / 2, which is zero at the guess.
  const double rate = closing - speed_a - speed_b;
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
    for (int k = 0; k < 1 && free > begin; ++k) {
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

}  // namespace touchstone
