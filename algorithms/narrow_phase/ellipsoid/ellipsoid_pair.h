// Two ellipsoids, or an ellipsoid and a ball, by the planes between them; and the climb to the best
// plane by Newton steps on the sphere of normals.
//
// The support function of {M r x : |x| <= 1} is |(M r)^T n|: smooth wherever it is not zero. So the
// signed distance, the greatest of n.c - |P^T n| - |Q^T n| - radius over unit vectors n (c from
// centre to centre), is the maximum of a smooth function on the sphere. Where the bodies are apart
// it has one local maximum that is positive, since the function is concave in n before n is made
// unit; where they overlap there may be several (ellipsoid_depth.h).
// Paper: the Hessian of a support function is the matrix of the radii of curvature: Schneider,
// "Convex Bodies: The Brunn-Minkowski Theory", 1993, sec. 2.5; Newton on the sphere: Absil, Mahony,
// Sepulchre, "Optimization Algorithms on Matrix Manifolds", 2008, ch. 6.
#pragma once

#include <limits>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// Relative to the centre of body a, world axes, lengths over `unit`, so that no number is above 2.
// Where one body is a sphere, it is body a's or b's `radius` and a zero matrix.
template <class Scalar>
struct EllipsoidPair {
  // What rounding does to a point of the difference stays below this.
  static constexpr Scalar rounding = 16 * std::numeric_limits<Scalar>::epsilon();

  // Sphere or ellipsoid, and ellipsoid.
  EllipsoidPair(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b);

  bool is_ball;         // a is one, about its centre
  Scalar radius;        // a's, where it is a ball
  double unit;          // metres, a power of two
  Mat3<Scalar> p, q;    // the unit ball to a and to b, about their centres; p = 0 for a ball
  Mat3<Scalar> pp, qq;  // p p^T, q q^T
  Vec3<Scalar> centre;  // of b
};

// The plane with a unit normal n that touches a from outside, and the one that touches b.
template <class Scalar>
struct EllipsoidPlane {
  EllipsoidPlane() = default;
  EllipsoidPlane(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& n);

  Vec3<Scalar> normal;
  Scalar reach_a, reach_b;          // |p^T n|, |q^T n|
  Scalar per_reach_a, per_reach_b;  // their inverses; 0 where they vanish
  Vec3<Scalar> a, b;                // support points of the cores, each from its own centre
  Scalar gap;                       // between the cores along n: no distance is smaller
  Vec3<Scalar> between;             // from a's point to b's
  Vec3<Scalar> slide;               // the part of that across n, the gap's gradient
  Scalar slide_squared;
};

enum class ClimbEnd : std::uint8_t {
  apart,       // the gap is above the radius by more than rounding
  inside,      // the points of the cores are nearer than the radius by more than rounding
  stationary,  // the slide is within the tolerance
  stuck,       // rounding, or the cap
};

struct ClimbGoal {
  bool only_apart = false;    // any plane that separates is enough
  bool only_verdict = false;  // points nearer than the radius are enough
  int most_iterations = 0;
};

template <class Scalar>
struct Climb {
  ClimbEnd end = ClimbEnd::stuck;
  EllipsoidPlane<Scalar> plane;
  int iterations = 0;
};

// From the plane of this normal on. `tolerance` is of the distance, in the pair's unit.
template <class Scalar>
Climb<Scalar> climb(const EllipsoidPair<Scalar>& pair, const Vec3<Scalar>& start,
                    const ClimbGoal& goal, Scalar tolerance);

}  // namespace touchstone
