// Prediction of the normal of first contact of spheres and capsules.
#include "algorithms/kernels/motion/advancement/round_planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchstone {
namespace {

// A vector that turns, to second order of the time.
struct TurningAxis {
  TurningAxis(const Vec3d& axis, const Vec3d& turn)
      : start(axis), velocity(turn.cross(axis)), acceleration(turn.cross(velocity)) {}
  Vec3d at(double h) const { return start + h * (velocity + 0.5 * h * acceleration); }
  Vec3d velocity_at(double h) const { return velocity + h * acceleration; }

  Vec3d start, velocity, acceleration;
};

}  // namespace

Vec3d lasting_normal(SupportPair<double>& pair, const PairMotion& motion, const ClosestOfRound& now,
                     double left, double least_gap) {
  const TurningAxis p(half_axis(pair.a()), motion.turn_a), q(half_axis(pair.b()), motion.turn_b);
  const Vec3d velocity = motion.velocity / pair.unit();
  const Vec3d& offset = pair.centre_b();
  const double radius = pair.radius();
  // A step of h loses bend h^2 / 2 to the bodies' turning.
  const double bend = p.acceleration.norm() + q.acceleration.norm();

  Vec3d best = Vec3d::Zero();
  ClosestOfRound closest = now;
  double time = 0;
  double approaching = 0, approach = 0;  // the last time with a rate below zero, and that rate
  double parting = std::numeric_limits<double>::infinity(), part_rate = 0;
  constexpr int most_looks = 5;
  for (int k = 0; k < most_looks; ++k) {
    const double distance = closest.between.norm();
    if (!(distance > 0)) break;
    const Vec3d normal = closest.between / distance;
    const bool open = normal.dot(offset) - std::abs(normal.dot(p.start)) -
                          std::abs(normal.dot(q.start)) - radius >
                      least_gap;
    if (open || k == 0) best = normal;
    const double rate = normal.dot(velocity + closest.part_b * q.velocity_at(time) -
                                   closest.part_a * p.velocity_at(time));
    const double gap = distance - radius;
    double next = left;
    if (rate < 0) {
      approaching = time;
      approach = rate;
      next = std::min(time - gap / rate, left);
    } else {
      if (open) break;
      parting = time;
      part_rate = rate;
    }
    if (!(next < parting)) {
      next = approaching + (parting - approaching) * approach / (approach - part_rate);
    }
    // A normal that is off by the change of the gap loses the square of that; the bodies' turning loses as much.
    if (!(gap * gap > std::max(least_gap, 0.5 * bend * time * time)) || next == time) break;
    time = next;
    closest = closest_of_segments(p.at(time), q.at(time), offset + time * velocity);
  }
  return best;
}

}  // namespace touchstone
