// A pair of polytopes and the axes that may separate them. Used by sat, sat-faces, closed-form and
// clipped-faces.
//
// The gap along a unit vector n is min n.b - max n.a. If positive it is a lower bound on the
// distance; if negative it is minus an upper bound on the penetration depth. Every axis gives a
// valid bound, so an extra axis does no harm, and the depth is exact if the axes include all facet
// normals of the Minkowski difference.
// Paper:   Gottschalk, Lin, Manocha, "OBBTree", SIGGRAPH 1996 (the axes of two boxes); Gregorius,
//          "The Separating Axis Test between Convex Polyhedra", GDC 2013 (the axes of two
//          polytopes).
// Steps:   1. Place both polytopes in a frame around the centre of a, in units of the larger body
//             (of the error, for two points).
//          2. If the offset exceeds the balls around both, report `separated` (`far_apart`).
//          3. For each face normal of a, the gap is b's least height along it minus the face's
//             offset. Stop at an axis whose gap exceeds the error bound (`face_axis`).
//          4. Do the same for the face normals of b.
//          5. The algorithm may add axes: the line of centres, or cross products of edges
//             (`axis_along`).
//          6. Report the greatest gap: beyond the error it decides; a depth gets bounds and witness
//             points (witness_points).
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "algorithms/core/outcome.h"
#include "algorithms/core/pose.h"
#include "algorithms/kernels/sat/polytope.h"

namespace touchstone {

// Body coordinates v, as stored, become scale * matrix * v + origin in the pair's frame: world
// axes, relative to the centre of body a, in units of the larger body (a power of two).
template <class Scalar>
struct PlacedPolytope {
  const Polytope<Scalar>* shape;
  Mat3<Scalar> matrix;
  // The cofactors of the matrix, times the sign of its determinant. They map outward normals of the
  // body to outward normals of its image, for any matrix.
  Mat3<Scalar> normals;
  Scalar determinant;  // its absolute value
  Scalar orientation;  // its sign
  Scalar scale;
  Vec3<Scalar> origin;

  Vec3<Scalar> operator()(const Vec3<Scalar>& v) const { return scale * (matrix * v) + origin; }
  // The greatest direction . y over the body, minus direction . origin.
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
  // Forward error bound of a gap.
  Scalar error() const { return error_; }
  // Length of one unit of the pair's frame in metres.
  double unit() const { return unit_; }
  // True if balls around the bodies are apart. No other test may be made then: the offset may be
  // too great for the scalar.
  bool far_apart() const { return far_apart_; }
  // True if the facet normals of the Minkowski difference are among the axes of faces and edges.
  bool complete() const { return complete_; }
  bool separates(const Axis<Scalar>& axis) const { return axis.gap > error_; }

  // The axis along the line of the centres; it has no gap if they coincide.
  Axis<Scalar> centre_axis() const;
  // The axis along a unit vector.
  Axis<Scalar> axis_along(const Vec3<Scalar>& normal) const;
  // Returns the best of the face normals of a, then b; stops at the first that separates. Adds the
  // number of axes to `tested`.
  Axis<Scalar> face_axis(int& tested) const;

  // Writes answer and status for the greatest gap of all axes. For a penetration query of bodies
  // that are not apart it also writes distance, bounds, normal and witness points. `exact`: the
  // axes included all facet normals, so the gap bounds the signed distance from both sides instead
  // of only from below.
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

// Makes polytopes of the shapes that are boxes or hulls; the others stay empty.
template <class Scalar>
std::vector<Polytope<Scalar>> make_polytopes(std::span<const Shape> shapes);

extern template std::vector<Polytope<float>> make_polytopes(std::span<const Shape>);
extern template std::vector<Polytope<double>> make_polytopes(std::span<const Shape>);

}  // namespace touchstone
