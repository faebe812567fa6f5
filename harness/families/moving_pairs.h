// Moving pairs with a known answer, some of which turn.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "algorithms/core/motion.h"
#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"
#include "harness/families/draws.h"

namespace touchstone::families {

// Moving pairs with a known answer.

struct MovingPairCase {
  std::string what;
  Shape a, b;
  Pose pose_a, pose_b;
  Motion motion_a, motion_b;
  // The truth: if it is a hit, the time of impact up to `doubt`, at which the bodies close at
  // `speed` along the plane of contact (metres; 0: not known). If it is a miss, the gap that they
  // keep at least.
  bool hit = false;
  // False if the bodies may touch at one instant alone, as at two corners that pass each other: then the
  // rounding of their placement decides, and an exact answer is either.
  bool squarely = true;
  double toi = 0, doubt = 0, speed = 0;
  double gap = 0;
  Vec3d normal = Vec3d::Zero();  // of the plane by which it was made, from a to b
  Vec3d inward = Vec3d::Zero();  // moved along this, touching b gets deeper into a
};

// A sphere, capsule, cylinder or cone; a box; the hull of points (metres).
Shape round_shape(ShapeKind kind, double radius, double half_length);
Shape box_shape(const Vec3d& half_extents);
Shape hull_shape(std::vector<Vec3d> vertices);

// A bounded shape of a kind, of sizes between 0.3 and 1.
Shape random_shape(ShapeKind kind, Draws& random);

// The pose at a time, independently of the kernels.
Pose pose_at(const Pose& pose, const Motion& motion, double time);

// How a plane of contact is chosen.
enum class ContactFeature : std::uint8_t {
  vertices,  // a random direction
  face,      // an axis of body a
  edges,     // the product of an axis of each
};
Vec3d contact_normal(ContactFeature feature, const Pose& a, const Pose& b, Draws& random);

// Bodies whose supports along +-normal meet at `toi`, before which the plane parts them.
MovingPairCase meeting(ShapeKind a, ShapeKind b, ContactFeature feature, double toi, double path,
                       Draws& random);
// Bodies that pass each other along a plane with a gap. If that is negative, b is in a by a point
// that is so far from where they would touch.
MovingPairCase passing(ShapeKind a, ShapeKind b, ContactFeature feature, double gap, double path,
                       Draws& random);

// All lengths times a factor.
MovingPairCase scaled(MovingPairCase c, double factor);
MovingPairCase swapped(MovingPairCase c);
// Both moved by the same displacement on top.
MovingPairCase drifting(MovingPairCase c, const Vec3d& displacement);

// Moving pairs of which one turns, with a known answer.

// Bodies of any two kinds that turn by so many radians; the answer is not known.
MovingPairCase turning(ShapeKind a, ShapeKind b, double radians, Draws& random);

// A needle that turns in place reaches a ball when its axis is a radius away from the ball.
MovingPairCase turning_needle(bool hit, Draws& random);

// Turns of many times: a rod that sinks while it turns above a plate, and meets it at a known time.
MovingPairCase sinking_rod(bool hit, Draws& random);

// A body whose origin is far outside of it, by up to 10^4 times the ball that it comes to.
MovingPairCase far_pivot(bool hit, Draws& random);

// A corner of a turning box passes a plate at the gap, or scratches it, for a negative one.
MovingPairCase passing_corner(double gap);

}  // namespace touchstone::families
