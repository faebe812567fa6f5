// Support maps of convex shapes, and pairs of bodies as their Minkowski difference.
//
// A shape is a core (a point, a segment, or the shape itself) and a ball of some radius around it:
// the exact body is {M v + t : v in the core} + Ball(radius), with M used as it stands. A pair is
// looked at from the centre of body a, in units of about its own size, so no threshold depends on
// the scale or on the distance from the world's origin.
// Papers: Gilbert, Johnson, Keerthi, "A fast procedure for computing the distance between complex
// objects in three-dimensional space", 1988 (support maps, core and radius); van den Bergen, "A
// fast and robust GJK implementation for collision detection of convex objects", 1999 (the curved
// ones).
#pragma once

#include <limits>

#include "algorithms/core/pose.h"
#include "algorithms/kernels/turned_shape.h"

namespace touchstone {

// From the centre of a to the centre of b (metres, world axes), good to its own rounding even far
// from the world's origin and from the shapes' own.
template <class Scalar>
Vec3d centre_offset(const SupportShape<Scalar>& a, const Pose& pose_a,
                    const SupportShape<Scalar>& b, const Pose& pose_b);

// Whether balls around the two bodies are apart, beyond rounding.
template <class Scalar>
bool balls_are_apart(const SupportShape<Scalar>& a, const Pose& pose_a,
                     const SupportShape<Scalar>& b, const Pose& pose_b);

// A point of the difference A - B of the cores, and the points of the bodies' cores that made it.
// In the units and the frame of the pair.
template <class Scalar>
struct DifferencePoint {
  Vec3<Scalar> difference, a, b;
};

// Two bounded bodies, relative to the centre of body a; world axes; lengths are divided by `unit`.
template <class Scalar>
class SupportPair {
 public:
  // Coordinates of the pair's cores, and `centre_b`, are at most about 2. What rounding does to
  // a point of the difference stays below this (length, in the pair's unit).
  static constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

  SupportPair(const SupportShape<Scalar>& a, const Pose& pose_a, const SupportShape<Scalar>& b,
              const Pose& pose_b);

  // The point of the difference of the cores, A - B, that lies furthest in the direction. Counted.
  template <class Scan = ScanAtBest>
  DifferencePoint<Scalar> support(const Vec3<Scalar>& direction) {
    ++support_calls_;
    DifferencePoint<Scalar> point;
    point.a = a_.template support<Scan>(direction);
    point.b = b_.template support<Scan>(-direction) + centre_b_;
    point.difference = point.a - point.b;
    return point;
  }

  // Inside body b; body a's is the origin. So the difference has -centre_b() inside.
  const Vec3<Scalar>& centre_b() const { return centre_b_; }
  Scalar radius_a() const { return a_.radius(); }
  Scalar radius_b() const { return b_.radius(); }
  Scalar radius() const { return a_.radius() + b_.radius(); }
  bool is_polytope() const { return is_polytope_; }  // both cores are
  double unit() const { return unit_; }              // metres, a power of two
  // A support call is one point of the difference.
  int support_calls() const { return support_calls_; }

  Vec3d to_world(const Vec3<Scalar>& point) const {
    return origin_ + unit_ * point.template cast<double>();
  }

 private:
  Vec3d offset_;  // metres
  double unit_;
  TurnedShape<Scalar> a_, b_;
  Vec3<Scalar> centre_b_;
  Vec3d origin_;  // body a's centre in the world, metres
  bool is_polytope_;
  int support_calls_ = 0;
};

}  // namespace touchstone
