// Part of ellipsoid: two ellipsoids, or an ellipsoid and a ball, the planes between them, and the
// ascent to the best plane by Newton steps on the sphere of normals. Includes core and kernels.
//
// The support function of {M r x : |x| <= 1} is |(M r)^T n|, which is smooth except at zero. So the
// signed distance, the greatest of n.c - |P^T n| - |Q^T n| - radius over unit vectors n (c is the
// vector between the centres), is the maximum of a smooth function on the sphere. If the bodies are
// apart, it has one positive local maximum, since the function is concave in n before n is
// normalised. If they overlap there may be several (ellipsoid_depth.h).
// Paper:   the Hessian of a support function is the matrix of the radii of curvature: Schneider,
//          "Convex Bodies: The Brunn-Minkowski Theory", 1993, sec. 2.5; Newton on the sphere:
//          Absil, Mahony, Sepulchre, "Optimization Algorithms on Matrix Manifolds", 2008, ch. 6.
#pragma once

#include <limits>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// World axes relative to the centre of body a; lengths are divided by `unit`, so that no number is
// above 2. A sphere is a `radius` and a zero matrix; it is always body a.
template <class Scalar>
struct EllipsoidPair {
  // Upper bound on the rounding error of a point of the difference.
  static constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

  // a is a sphere or an ellipsoid, b is an ellipsoid.
  EllipsoidPair(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

  bool is_ball;         // a is a ball around its centre
  Scalar radius;        // of a if it is a ball, else 0
  double unit;          // metres, a power of two
  Mat3<Scalar> p, q;    // maps of the unit ball to a and b around their centres; p = 0 for a ball
  Mat3<Scalar> pp, qq;  // p p^T, q q^T
  Vec3<Scalar> centre;  // centre of b
};

// The planes with a unit normal n that touch a from outside, and b.
template <class Scalar>
struct EllipsoidPlane {
  EllipsoidPlane() = default;
  EllipsoidPlane(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& n);

  Vec3<Scalar> normal;
  Scalar reach_a, reach_b;          // |p^T n|, |q^T n|
  Scalar per_reach_a, per_reach_b;  // their inverses, or 0 for a reach of zero
  Vec3<Scalar> a, b;                // support points of the cores, relative to their own centres
  Scalar gap;                       // between the cores along n: a lower bound on their distance
  Vec3<Scalar> between;             // from the point of a to that of b
  Vec3<Scalar> slide;               // the part of `between` across n, which is the gap's gradient
  Scalar slide_squared;
};

enum class ClimbEnd : std::uint8_t {
  apart,       // the gap is above the radius by more than rounding
  inside,      // the points of the cores are nearer than the radius by more than rounding
  stationary,  // the slide is within the tolerance
  stuck,       // because of rounding or the cap
};

struct ClimbGoal {
  bool only_apart = false;    // stop at any plane that separates
  bool only_verdict = false;  // stop at points nearer than the radius
  int most_iterations = 0;
  // Stop at a plane that separates the bodies by more than this, in the pair's unit.
  double margin = std::numeric_limits<double>::infinity();
};

template <class Scalar>
struct Climb {
  ClimbEnd end = ClimbEnd::stuck;
  EllipsoidPlane<Scalar> plane;
  int iterations = 0;
};

// Ascends from the plane with normal `start`. `tolerance` applies to the distance, in the pair's
// unit.
template <class Scalar>
Climb<Scalar> climb(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& start,
                    const ClimbGoal& goal, Scalar tolerance);

}  // namespace touchstone
