// The longest step in which a plane parts turning bodies.
#include "algorithms/kernels/motion/advancement/parting_step.h"

#include <algorithm>
#include <cmath>

#include "algorithms/kernels/motion/length.h"

namespace touchstone {
namespace {

// A body's part of the gap along a direction n that points away from it, seen from what turns with n.
class Reach {
 public:
  // `turn` is the body's angular velocity, of length `angle`, and `turning` that of n.
  Reach(PosedShape<double>& shape, const Vec3d& centre, const Vec3d& turn, double angle,
        const Vec3d& turning, double unit, double greatest, const Vec3d& n)
      : shape_(shape), centre_(centre), n_(n), turn_(n.cross(turn - turning)), unit_(unit) {
    bend_turn_ = -turn.cross(turn_);
    if (turning.isZero(0)) {
      fastest_ = angle;
      bend_ = turn_.norm() * angle * greatest;
    } else {
      const Vec3d relative = turn - turning;
      bend_turn_ -= relative.cross(turning.cross(n));
      fastest_ = angle + turning.norm();
      bend_ = (relative.squaredNorm() + turning.cross(turn).norm()) * greatest;
    }
  }

  // Adds the body's centre and core: value is an upper bound on how far they reach along n after h,
  // less the part that is the same at all times, and less what is bounded by `bend`, or with `curved` by `third`.
  double value(double h, bool curved) {
    const Vec3d change = h * (curved ? Vec3d(turn_ + 0.5 * h * bend_turn_) : turn_);
    return unit_ * shape_.support_value(n_ + change) + change.dot(centre_);
  }
  // The same for h = 0. Sets the rate at which the support point moves along n, and the rate of that.
  double value_now(double& rate, double& rate_change) {
    const Vec3d support = unit_ * shape_.support(n_), arm = support + centre_;
    rate = turn_.dot(arm);
    rate_change = bend_turn_.dot(arm);
    return n_.dot(support);
  }
  // Bounds on the second and the third derivative of any point's way along n.
  double bend() const { return bend_; }
  double third() const { return fastest_ * bend_; }
  // The sum of the angular velocities of the body and n.
  double fastest() const { return fastest_; }

 private:
  PosedShape<double>& shape_;
  Vec3d centre_;                // from the body's origin, at the time
  Vec3d n_, turn_, bend_turn_;  // n, and the first and second derivative of n as seen from the body
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
  // A support direction is at most as long as 1, the greatest turn, 1.5, and half its square, so that rounding is
  // at most four times that of a unit direction.
  constexpr double greatest_turn = 1.5;
  const double slack = 4 * (RelativeMotion::pair_rounding * unit + motion.placement_rounding());
  const double balls = balls_apart(motion, plane, slack);
  if (balls > left) return {1, true};

  const Vec3d& turning = plane.turning;
  Reach of_a(pair.a(), motion.centre_a(plane.time), motion.a().motion->rotation_vector,
             motion.angle_a(), turning, unit, motion.reach_a(), n);
  Reach of_b(pair.b(), motion.centre_b(plane.time), motion.b().motion->rotation_vector,
             motion.angle_b(), turning, unit, motion.reach_b(), -n);
  double closing = n.dot(motion.displacement()), closing_change = 0;
  double bend = of_a.bend() + of_b.bend(), third = of_a.third() + of_b.third();
  double fastest = std::max(of_a.fastest(), of_b.fastest());
  if (!turning.isZero(0)) {
    const Vec3d away = motion.offset(plane.time), turn_of_n = turning.cross(n);
    const double furthest = std::max(length_of(away), length_of(motion.offset(1)));
    const double turn = turning.norm(), speed_of_n = turn_of_n.norm();
    closing += turn_of_n.dot(away);
    closing_change = turning.cross(turn_of_n).dot(away) + 2 * turn_of_n.dot(motion.displacement());
    bend += speed_of_n * (turn * furthest + 2 * motion.speed());
    third += speed_of_n * turn * (turn * furthest + 3 * motion.speed());
  }
  const double apart = unit * (n.dot(pair.centre_b()) - pair.radius()) - slack;
  double speed_a = 0, speed_b = 0, change_a = 0, change_b = 0;
  const double now = apart - of_a.value_now(speed_a, change_a) - of_b.value_now(speed_b, change_b);
  if (!(now > 0)) return {plane.time + balls, false};
  const double rate = closing - speed_a - speed_b;
  const double furthest = std::min(left, greatest_turn / std::max(fastest, 1e-300));
  const auto root_of = [&](double change) {
    const double root = std::sqrt(std::max(0.0, rate * rate + 2 * change * now));
    if (rate > 0) return change > 0 ? (rate + root) / change : furthest;
    return 2 * now / std::max(root - rate, 1e-300);
  };
  // To second order, if anything turns. With the support points fixed the gap is now + rate h - change h^2 / 2, up to third order.
  const double change = change_a + change_b - closing_change;
  double free = 0;
  if (rate < 0 && bend > 0) {
    const auto gap = [&](double h) {
      return apart + h * closing - of_a.value(h, true) - of_b.value(h, true) +
             0.5 * h * h * (closing_change - h * third / 3);
    };
    constexpr int most_tries = 3;
    constexpr double overstep = 1.1;
    const double least = 0.25 * now / -rate;  // less is left to the surer bound
    double h = std::min({furthest, std::sqrt(2 * now / std::max(bend, 1e-300)), root_of(change)});
    for (int k = 0; k < most_tries && h > least; ++k) {
      const double here = gap(h);
      if (here > 0) {
        free = h;
        break;
      }
      h -= overstep * here / std::min(rate - change * h, 0.1 * rate);
    }
  }
  if (!(free > 0)) {
    const auto gap = [&](double h) {
      return apart + h * closing - of_a.value(h, false) - of_b.value(h, false) - 0.5 * h * h * bend;
    };
    // gap(h) is at most now + rate h - bend h^2 / 2, which is zero at the guess.
    const double end = std::min(furthest, root_of(bend) * (1 + 1e-9));
    const double at_end = gap(end);
    // Where the chord from an open end is zero, the gap is open by concavity; a little less makes up
    // for the rounding of the chord.
    constexpr double safety = 1 - 1e-12;
    free = at_end > 0 ? end : end * now / (now - at_end) * safety;
    if (const double here = at_end > 0 ? 0 : gap(free); here > 0.02 * now) {
      free += (end - free) * here / (here - at_end) * safety;
    }
  }
  if (free >= left) return {1, true};
  return {plane.time + std::max(free, balls), false};
}

}  // namespace touchstone
