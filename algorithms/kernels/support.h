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

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/pose.h"
#include "algorithms/core/shape.h"

namespace touchstone {

// A shape made ready for one scalar type, once for each scene. The core is stored relative to
// `centre` and divided by the power of two `unit`, so that its coordinates are at most 1.
template <class Scalar>
struct SupportShape {
  enum class Core : std::uint8_t {
    point,
    segment,
    box,
    cylinder,
    cone,
    ellipsoid,
    hull,
    halfspace
  };

  explicit SupportShape(const Shape& shape);

  Core core = Core::point;
  double unit = 1;    // metres
  double size = 0;    // metres: no point of the core is further from the centre
  double radius = 0;  // metres: of the ball around the core
  Vec3d centre =
      Vec3d::Zero();  // body coordinates: inside the shape (relatively, where it is flat)
  // Box: half extents; ellipsoid: semi-axes; segment, cylinder, cone: radius, radius, half length.
  Vec3<Scalar> extents = Vec3<Scalar>::Zero();
  std::vector<Scalar> x, y, z;  // hull vertices, padded with copies of the first
  // Hull: neighbours of vertex i are neighbour[neighbours_begin[i]] up to neighbours_begin[i + 1].
  // Empty where the vertices are few, or the hull does not know them.
  std::vector<std::uint32_t> neighbours_begin, neighbour;
  std::uint32_t climb_from = 0;  // a vertex that has neighbours
  // Half-space: as in Shape.
  Vec3d normal = Vec3d::UnitZ();
  double offset = 0;

  // About how far the turned body reaches from its centre (metres): within a factor of two.
  double reach(const Mat3d& rotation) const {
    return size * rotation.cwiseAbs().maxCoeff() + radius;
  }
  bool is_polytope() const { return core <= Core::box || core == Core::hull; }
};

template <class Scalar>
std::vector<SupportShape<Scalar>> make_support_shapes(std::span<const Shape> shapes);

// A shape turned as its body is, about its centre, in the units of a query.
template <class Scalar>
class TurnedShape {
 public:
  // `unit` is the power of two, in metres, that the result is divided by.
  TurnedShape(const SupportShape<Scalar>& shape, const Mat3d& rotation, double unit);

  // The point of the core that lies furthest in the direction, relative to the centre. The
  // direction need not have unit length, but its square must neither overflow nor vanish.
  Vec3<Scalar> support(const Vec3<Scalar>& direction);

  Scalar radius() const { return radius_; }

 private:
  const SupportShape<Scalar>* shape_;
  Mat3<Scalar> matrix_;
  Scalar radius_;
  std::uint32_t vertex_;  // hull: where the last support was found
};

// From the centre of a to the centre of b (metres, world axes), good to its own rounding even far
// from the world's origin and from the shapes' own.
template <class Scalar>
Vec3d centre_offset(const SupportShape<Scalar>& a, const Pose& pose_a,
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
  DifferencePoint<Scalar> support(const Vec3<Scalar>& direction) {
    ++support_calls_;
    DifferencePoint<Scalar> point;
    point.a = a_.support(direction);
    point.b = b_.support(-direction) + centre_b_;
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

// The least power of two above a length, so that length / result is in [1/2, 1); 1 for zero. Held
// to where the result and its inverse are normal numbers.
double power_of_two_above(double length);

}  // namespace touchstone
