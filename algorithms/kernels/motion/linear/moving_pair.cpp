// Places the pair in its unit.
#include "algorithms/kernels/motion/linear/moving_pair.h"

#include <algorithm>
#include <cmath>

#include "algorithms/kernels/motion/relative_motion.h"

namespace touchstone {

MovingPair::MovingPair(const CentreOffset& offset, const Vec3d& displacement, double reach,
                       const SupportShape<double>& a, const Mat3d& rotation_a,
                       const SupportShape<double>& b, const Mat3d& rotation_b)
    : unit_(power_of_two_above(
          std::max({offset.vector.cwiseAbs().maxCoeff(), displacement.cwiseAbs().maxCoeff(),
                    (offset.vector + displacement).cwiseAbs().maxCoeff(), 0x1p54 * offset.doubt,
                    a.reach(rotation_a), b.reach(rotation_b)}))),
      reach_(reach / unit_),
      a_(a, rotation_a, unit_),
      b_(b, rotation_b, unit_),
      start_(offset.vector * (1 / unit_)),
      velocity_(displacement * (1 / unit_)),
      offset_(start_) {}

Vec3d MovingPair::first_direction() const {
  const Vec3d there = start_ + nearest_time(start_, velocity_) * velocity_;
  const double distance = there.norm();
  const double length = start_.norm();
  // A direction across the path parts bodies that pass each other, and turns none away early.
  if (distance > 0.5 * reach() && distance > 1e-6 * length) return there / distance;
  return length > 0 ? Vec3d(start_ / length) : Vec3d::UnitX();
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
