// A pair of polytopes and the axes that may separate them.
// Paper: Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the axes of two boxes); Gregorius,
// "The Separating Axis Test between Convex Polyhedra", GDC 2013 (of two polytopes).
//
// The gap along a unit vector n is min n.b - max n.a: where positive, a lower bound of the
// distance; where negative, minus an upper bound of the penetration depth. Every axis is a valid
// bound, so an axis too many does no harm, and the depth is exact as soon as the axes hold all
// facet normals of the Minkowski difference.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/kernels/sat/polytope.h"

namespace touchstone {

// Body coordinates v (as stored) become scale * matrix * v + origin in the pair's frame: world
// axes, seen from the centre of body a, in units of the greater of the two bodies (a power of two).
template <class Scalar>
struct PlacedPolytope {
  const Polytope<Scalar>* shape;
  Mat3<Scalar> matrix;
  // The cofactors of the matrix, times the sign of its determinant: they turn outward normals of
  // the body into outward normals of its image, whatever the matrix.
  Mat3<Scalar> normals;
  Scalar determinant;  // its absolute value
  Scalar orientation;  // its sign
  Scalar scale;
  Vec3<Scalar> origin;

  Vec3<Scalar> operator()(const Vec3<Scalar>& v) const { return scale * (matrix * v) + origin; }
  // The greatest direction . y over the body, less direction . origin.
  Scalar support(const Vec3<Scalar>& direction) const {
    return scale * shape->support(matrix.transpose() * direction);
  }
};

template <class Scalar>
struct Axis {
  Scalar gap = -std::numeric_limits<Scalar>::infinity();
  Vec3<Scalar> normal = Vec3<Scalar>::Zero();  // unit vector from a to b
};

template <class Scalar>
class PolytopePair {
 public:
  PolytopePair(const Polytope<Scalar>& a, const Pose& pose_a, const Polytope<Scalar>& b,
               const Pose& pose_b);

  const PlacedPolytope<Scalar>& a() const { return a_; }
  const PlacedPolytope<Scalar>& b() const { return b_; }
  // A forward bound on the error of a gap.
  Scalar error() const { return error_; }
  // Metres in a length of the pair's frame.
  double unit() const { return unit_; }
  // Apart by so much that the two balls around the bodies are. No other test may then be made: the
  // offset may be too great for the scalar.
  bool far_apart() const { return far_apart_; }
  // The facet normals of the Minkowski difference are among the axes of faces and edges.
  bool complete() const { return complete_; }
  bool separates(const Axis<Scalar>& axis) const { return axis.gap > error_; }

  // Along the line of the centres; no gap where they coincide.
  Axis<Scalar> centre_axis() const;
  // Along a unit vector.
  Axis<Scalar> axis_along(const Vec3<Scalar>& normal) const;
  // The best among the face normals of a, then b; ends at the first that separates. `tested` is
  // raised by the number of axes.
  Axis<Scalar> face_axis(int& tested) const;

  // Writes answer and status for the greatest gap of all axes, and for a penetration query of
  // bodies that are not apart, distance, bounds, normal and witness points. `exact`: the axes held
  // all facet normals, so that the gap bounds the signed distance from both sides, not just from
  // below.
  void report(const Axis<Scalar>& best, Task task, bool exact, Outcome& outcome) const;

 private:
  PlacedPolytope<Scalar> a_, b_;
  Scalar error_;
  bool far_apart_, complete_, too_large_;
  double unit_;   // metres
  Vec3d anchor_;  // the frame's origin in the world, metres
};

extern template class PolytopePair<float>;
extern template class PolytopePair<double>;

// The polytopes of those shapes that are boxes or hulls; the others are left empty.
template <class Scalar>
std::vector<Polytope<Scalar>> make_polytopes(std::span<const Shape> shapes);

extern template std::vector<Polytope<float>> make_polytopes(std::span<const Shape>);
extern template std::vector<Polytope<double>> make_polytopes(std::span<const Shape>);

}  // namespace touchstone
