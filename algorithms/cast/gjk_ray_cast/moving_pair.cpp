// Part of gjk-ray-cast: places the pair in its unit.
#include "algorithms/cast/gjk_ray_cast/moving_pair.h"

#include <algorithm>
#include <cmath>

#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

MovingPair::MovingPair(const SupportShape<double>& a, const Pose& pose_a, const Motion& motion_a,
                       const SupportShape<double>& b, const Pose& pose_b, const Motion& motion_b)
    : MovingPair(centre_offset(a, pose_a, b, pose_b), motion_b.displacement - motion_a.displacement,
                 a, pose_a.rotation, b, pose_b.rotation) {}

MovingPair::MovingPair(const CentreOffset& offset, const Vec3d& displacement,
                       const SupportShape<double>& a, const Mat3d& rotation_a,
                       const SupportShape<double>& b, const Mat3d& rotation_b)
    : unit_(power_of_two_above(
          std::max({offset.vector.cwiseAbs().maxCoeff(), displacement.cwiseAbs().maxCoeff(),
                    (offset.vector + displacement).cwiseAbs().maxCoeff(), 0x1p54 * offset.doubt,
                    a.reach(rotation_a), b.reach(rotation_b)}))),
      reach_a_((a.size * stretch_of(rotation_a) + a.radius) / unit_),
      reach_b_((b.size * stretch_of(rotation_b) + b.radius) / unit_),
      size_(std::max(reach_a_, reach_b_)),
      a_(a, rotation_a, unit_),
      b_(b, rotation_b, unit_),
      start_(offset.vector * (1 / unit_)),
      velocity_(displacement * (1 / unit_)),
      offset_(start_) {}

bool MovingPair::balls_miss(Vec3d& direction) const {
  const double square = velocity_.squaredNorm();
  const double nearest = square > 0 ? std::clamp(-start_.dot(velocity_) / square, 0.0, 1.0) : 0;
  const Vec3d there = start_ + nearest * velocity_;
  const double distance = there.norm();
  const double reach = reach_a_ + reach_b_;
  const double length = start_.norm();
  direction = length > 0 ? Vec3d(start_ / length) : Vec3d::UnitX();
  // A direction across the path parts bodies that pass each other, and turns none away early.
  if (!(distance > 0.5 * reach) || !(distance > 1e-6 * length)) return false;
  direction = there / distance;
  const double at_start = direction.dot(start_);
  const double at_end = at_start + direction.dot(velocity_);
  return std::min(at_start, at_end) > reach + rounding;
}

DifferencePoint<double> MovingPair::support(const Vec3d& direction) {
  DifferencePoint<double> point;
  point.a = a_.support(direction);
  point.b = b_.support(-direction);
  point.difference = point.a - (point.b + offset_);
  return point;
}

void MovingPair::move_to(double time, Simplex<double>& simplex) {
  time_ = time;
  offset_ = start_ + time * velocity_;
  for (int i = 0; i < simplex.size; ++i) {
    DifferencePoint<double>& point = simplex.points[static_cast<std::size_t>(i)];
    point.difference = point.a - (point.b + offset_);
  }
}

}  // namespace touchstone
