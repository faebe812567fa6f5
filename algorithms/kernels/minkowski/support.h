// Support maps of convex shapes, and pairs of bodies as their Minkowski difference. Used by every
// narrow phase with support maps.
//
// A shape is a core (a point, a segment, or the shape itself) with a ball of some radius around it.
// The exact body is {M v + t : v in the core} + Ball(radius), with M as it is stored. A pair is
// described relative to the centre of body a, in units of about its own size, so that no threshold
// depends on the scale or on the distance from the world's origin.
// Paper:   Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
//          objects in three-dimensional space", 1988 (support maps, core and radius); van den
//          Bergen, "A fast and robust GJK implementation for collision detection of convex
//          objects", 1999 (the curved ones).
#pragma once

#include <limits>

#include "algorithms/core/pose.h"
#include "algorithms/kernels/minkowski/posed_shape.h"

namespace touchstone {

// The vector from the centre of a to the centre of b: metres, world axes. Each component is off by
// a few units in the last place of the greatest of the components and the sizes of the rotated
// bodies, and by `doubt`, which is nonzero only if a hull is far from its own origin.
struct CentreOffset {
  Vec3d vector;
  double doubt;
};

template <class Scalar>
CentreOffset centre_offset(const SupportShape<Scalar>& a, const Pose& pose_a,
                           const SupportShape<Scalar>& b, const Pose& pose_b);

// Returns true if balls around the two bodies are apart by more than rounding. `offset` is that of
// their centres.
template <class Scalar>
bool balls_are_apart(const CentreOffset& offset, const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b);
template <class Scalar>
bool balls_are_apart(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b) {
  return balls_are_apart(centre_offset(a, pose_a, b, pose_b), a, pose_a, b, pose_b);
}
// Returns true if they are by more than `margin` (metres) as well.
template <class Scalar>
bool balls_are_apart_by(double margin, const CentreOffset& offset, const SupportShape<Scalar>& a,
                        const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b);
template <class Scalar>
bool balls_are_apart_by(double margin, const SupportShape<Scalar>& a, const Pose& pose_a,
                        const SupportShape<Scalar>& b, const Pose& pose_b) {
  return balls_are_apart_by(margin, centre_offset(a, pose_a, b, pose_b), a, pose_a, b, pose_b);
}

// A point of the difference A - B of the cores, and the points of the bodies' cores that it is made
// of, in the unit and the frame of the pair.
template <class Scalar>
struct DifferencePoint {
  Vec3<Scalar> difference, a, b;
};

// Two bounded bodies, relative to the centre of body a; world axes; lengths are divided by `unit`.
template <class Scalar>
class SupportPair {
 public:
  // Coordinates of the pair's cores, and `centre_b`, are at most about 2. The rounding error of a
  // point of the difference (a length in the pair's unit) was below this in all tests.
  static constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

  // The pair refers to the pose of a.
  SupportPair(const SupportShape<Scalar>& a, const Pose& pose_a, const SupportShape<Scalar>& b,
              const Pose& pose_b);
  // The same, with the offset of the centres.
  SupportPair(const CentreOffset& offset, const SupportShape<Scalar>& a, const Pose& pose_a,
              const SupportShape<Scalar>& b, const Pose& pose_b);

  // The same, with the unit: a power of two of which no component of the offset, and no extent of a body, is more than
  // about twice.
  SupportPair(const CentreOffset& offset, double unit, const SupportShape<Scalar>& a,
              const Pose& pose_a, const SupportShape<Scalar>& b, const Pose& pose_b);

  // Returns the point of the difference of the cores, A - B, that is furthest in the direction, and
  // counts the call.
  template <class CoreOfA = GenericCore, class CoreOfB = GenericCore>
  DifferencePoint<Scalar> support(const Vec3<Scalar>& direction) {
    ++support_calls_;
    DifferencePoint<Scalar> point;
    point.a = a_.template support<CoreOfA>(direction);
    point.b = b_.template support<CoreOfB>(-direction) + centre_b_;
    point.difference = point.a - point.b;
    return point;
  }

  // Access for code that finds support points itself in vectors: see gjk_iteration.inl.
  PosedShape<Scalar>& a() { return a_; }
  PosedShape<Scalar>& b() { return b_; }
  void count_support() { ++support_calls_; }

  // A point inside body b. Body a's centre is the origin, so -centre_b() is inside the difference.
  const Vec3<Scalar>& centre_b() const { return centre_b_; }
  Scalar radius_a() const { return a_.radius(); }
  Scalar radius_b() const { return b_.radius(); }
  Scalar radius() const { return a_.radius() + b_.radius(); }
  bool is_polytope() const { return is_polytope_; }  // both cores are polytopes
  // Neither core has a corner or an edge; at most one is a point.
  bool is_smooth() const { return is_smooth_; }
  double unit() const { return unit_; }  // metres, a power of two
  // A support call is one point of the difference.
  int support_calls() const { return support_calls_; }

  Vec3d to_world(const Vec3<Scalar>& point) const {
    return (*pose_a_)(a_.shape().centre) + unit_ * point.template cast<double>();
  }

 private:
  double unit_;
  PosedShape<Scalar> a_, b_;
  Vec3<Scalar> centre_b_;
  const Pose* pose_a_;
  bool is_polytope_, is_smooth_;
  int support_calls_ = 0;
};

}  // namespace touchstone
