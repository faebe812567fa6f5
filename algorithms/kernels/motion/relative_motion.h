// A pair of moving bodies as seen from the origin of the first, at any time. Used by
// conservative-advancement, rigid-advancement, bilateral-advancement and the proof of contact
// (contact_by.h).
#pragma once

#include <algorithm>

#include "algorithms/core/motion.h"
#include "algorithms/kernels/minkowski/support.h"
#include "algorithms/kernels/motion/inner_ball.h"
#include "algorithms/kernels/motion/stretch.h"

namespace touchstone {

// exp(rotation_vector): the rotation about that vector by its length. Accurate to a few roundings
// times 1 + its length.
Mat3d rotation_by(const Vec3d& rotation_vector);

// The time in [0, 1] at which start + time * displacement is nearest to the origin.
inline double nearest_time(const Vec3d& start, const Vec3d& displacement) {
  const double square = displacement.squaredNorm();
  return square > 0 ? std::clamp(-start.dot(displacement) / square, 0.0, 1.0) : 0;
}

// A bounded body that moves.
struct MovingBody {
  const SupportShape<double>* shape;
  const Pose* pose;      // at time 0
  const Motion* motion;  // from time 0 to 1
  double shape_inner;    // metres: inner_radius of the shape (inner_ball.h)
  Stretch stretch;       // of the pose

  double inner_radius() const { return shape_inner * stretch.least; }
};

// A body's rotation at any time, by Rodrigues' formula with its matrices made once. As accurate as
// rotation_by.
class TurningPose {
 public:
  // `angle` is that of the body's motion.
  TurningPose(const MovingBody& body, double angle);
  Mat3d at(double time) const;

 private:
  Mat3d start_, across_, twice_across_;  // the last two are set only if the body turns
  double angle_;
};

// What is known of a moving pair before its bodies turn. The frame moves with the origin of body a, and
// keeps the world's axes. Lengths are in metres.
class MotionBounds {
 public:
  MotionBounds(const MovingBody& a, const MovingBody& b);

  // How far a point of a body that RelativeMotion::at places is off its place relative to the other body
  // (metres). With u half of epsilon: the offset of the origins is off by u of itself, the
  // displacement by 2 u and the sum by u, and a step multiplies the displacement by a direction and a
  // time, 8 u; exp(t w) R is off by (4 |w| + 30) u a body that turns, times
  // that body's reach. The bound is twice that.
  double placement_rounding() const { return placement_rounding_; }

  const Vec3d& displacement() const { return displacement_; }                 // of b relative to a
  double speed() const { return speed_; }                                     // its length
  Vec3d offset(double time) const { return offset_ + time * displacement_; }  // of b's origin
  // Greatest distance of a core's point from the body's origin.
  double reach_a() const { return reach_a_; }
  double reach_b() const { return reach_b_; }
  // A bound on the extents of both bodies from their centres, within a factor of four of the greater.
  double extent() const { return extent_; }
  // By how much the bodies turn (radians).
  double angle_a() const { return angle_a_; }
  double angle_b() const { return angle_b_; }
  const MovingBody& a() const { return a_; }
  const MovingBody& b() const { return b_; }

  // A point of this frame in the world at that time.
  Vec3d to_world(const Vec3d& point, double time) const {
    return point + a_.pose->translation + time * a_.motion->displacement;
  }

 private:
  MovingBody a_, b_;
  Vec3d offset_;        // from a's origin to b's at time 0
  Vec3d displacement_;  // of b relative to a
  double speed_, reach_a_, reach_b_, extent_, angle_a_, angle_b_;
  double placement_rounding_;
};

// The pair at any time.
class RelativeMotion : public MotionBounds {
 public:
  explicit RelativeMotion(const MotionBounds& bounds)
      : MotionBounds(bounds),
        turning_a_(bounds.a(), bounds.angle_a()),
        turning_b_(bounds.b(), bounds.angle_b()) {}

  // How far rounding moves a support point of a pair made by `at`, or its plane, in the pair's own
  // unit; certified/proven_rounding.h proves 248 u, and the rest is for the unit length of a
  // direction and for the arithmetic on gaps. `placement_rounding` comes on top.
  static constexpr double pair_rounding = 160 * std::numeric_limits<double>::epsilon();

  // The pair at a time in [0, 1]. Its `to_world` has no meaning: the pose of a that it refers to is gone.
  SupportPair<double> at(double time) const;

  // The centre of a body's shape from its origin at that time, in world axes.
  Vec3d centre_a(double time) const;
  Vec3d centre_b(double time) const;

 private:
  TurningPose turning_a_, turning_b_;
};

}  // namespace touchstone
